// A path on a solution set that is proven from end to end: one lift over each piece, and no singularity about it.
#pragma once

#include <optional>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/distance_bound.h"
#include "corank/certify/domain.h"
#include "corank/certify/kernel_bound.h"
#include "corank/certify/newton.h"
#include "corank/core/singularity_types.h"
#include "corank/core/tube.h"

namespace corank::certify {

/// F and (1 − t)(T·x − c) + t (T'·x − c'), t the last variable, in [0, 1]; without inequalities.
System piece_system(System system, const TubeNode& a, const TubeNode& b);

/// For a system F of m equations in n variables, and matrices that are to keep their full rank.
///
/// Theorem: let F(x) = 0, (1 − t)(T·x − c) + t (T'·x − c') = 0 have for every t ∈ [0, 1] exactly one solution x(t) in the
/// box P, by newton_prove with the free variable t: the Jacobian in x is regular there, so x(t) is continuous (implicit
/// function theorem). Where the box N of a node lies in the boxes P, P' of both its pieces and holds a solution of F = 0,
/// T·x = c, that is P's at t = 1 and P''s at t = 0, since each has one only: the pieces are one path.
/// Parameters are free as t is, over their whole domains, so that this holds for every robot: it has a path x(t) of its own.
/// Every x with F(x) = 0 in P inflated by r, but for parameters, has matrices of full rank, is in the domain, and keeps the
/// distances, where is_free(P, r, sizes).
class TubeProver {
 public:
  /// ranks: of each matrix, the one that it is to have.
  TubeProver(const System& system, const std::vector<PolynomialMatrix>& matrices, std::vector<int> ranks,
             const KeptDistances& distances = {});

  /// The node's box about the point, nothing where none is proven. Each of these requires UpwardRounding::active().
  std::optional<Box> node(const std::vector<double>& rows, const std::vector<double>& values,
                          const std::vector<double>& near);
  /// The box of the piece between two nodes; it holds theirs.
  std::optional<Box> piece(const TubeNode& a, const TubeNode& b);
  /// Over the whole box with r times the variable's size added to each side: every matrix has its rank, the domain and the
  /// inequalities hold, bodies keep their distances. `sizes`: Tube::sizes.
  bool is_free(const Box& piece, double r, const std::vector<double>& sizes) const;
  /// The same over a box as it is, of robots within its own sides.
  bool is_free(const Box& box) const;
  /// A connected piece of the solution set that holds a solution in each of the boxes, and lies in `within`: the graph over
  /// a box of n − m variables, for every value of which it has exactly one solution.
  bool joins(const Box& a, const Box& b, const Box& within);

 private:
  Sheet prove(const TubeNode& a, const TubeNode& b, std::vector<Interval> x);

  System bare_;  // without inequalities and further rows
  CompiledSystem compiled_;
  DomainTest domain_;
  std::vector<KernelBound> bounds_;
  DistanceBound distances_;
  std::vector<int> most_;  // of each matrix, the largest kernel that it may have
  NewtonWorkspace workspace_;
};

}  // namespace corank::certify
