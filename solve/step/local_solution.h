// Where a small box that resists proof lies close to the set, and of which rank the Jacobian is there. Heuristic throughout:
// it decides what is tried next and what is said about boxes that stay undecided, never what is proven.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "corank/solve/step/preconditioner.h"
#include "corank/solve/step/problem.h"

namespace corank::solve {

struct LocalSolution {
  std::vector<double> x;  ///< n, nearly a solution
  int rank = 0;  ///< of the scaled Jacobian there: columns times the variables' scales, rows divided by their typical sizes
};

/// Gauss–Newton steps of minimal norm (in the scales) from a start, in doubles. Pivots of the scaled Jacobian below
/// `tolerance` of the largest count as 0; of a set that has surfaces, all of them where no entry is larger than `tolerance`.
/// Nothing where the steps do not converge, or go farther than `reach` of some variable's scale from the start.
std::optional<LocalSolution> local_solution(const Problem& problem, std::vector<double> start, double tolerance,
                                            double reach = HUGE_VAL);

/// A small box about a solution in x, as Newton's method in doubles leads to it; nothing where it leads out of x. By the
/// last preconditioner, which is that at x's midpoint.
std::optional<Box> box_about_solution(const certify::CompiledSystem& system, const PreconditionerFactory& preconditioners,
                                      std::span<const Interval> x);

/// Does an inequality fail at x and, to first order, wherever no variable moves by more than 2·share of its scale? Then what
/// equations have there, such as the diagonal that the distance of two configurations keeps out, says nothing of the set.
bool breaks_inequality(const Problem& problem, const std::vector<double>& x, double share);

/// An orthonormal basis, in scaled variables, of the kernel of the Jacobian at x: n × (n − rank), row-major.
std::vector<double> kernel_basis(const Problem& problem, const LocalSolution& at, double tolerance);

}  // namespace corank::solve
