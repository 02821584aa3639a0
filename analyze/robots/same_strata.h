// Do all robots within their tolerances have the same set, divided by the same functions, but for a homeomorphism? Then
// whatever is counted on it for one robot holds for each.
//
// Example: C-space of a five-bar, divided by the factors of det L_y and det L_z. If no robot's zeros of a factor have a
// node, and where two factors are 0 they cross, then all robots have as many aspects as the one that was drawn.
//
// Theorem (Thom 1969; Mather, "Notes on Topological Stability", 1970, § 11; doc/theory.md, "One shape for all robots").
// P: the box of tolerances; M = {(p, q): F = 0, e ≥ 0} in the search domain, p ∈ P, with e the functions of the limits that
// it comes to. Let it be so for every set A of functions and limits:
//   {F = 0, f_j = 0 for j ∈ A} has, at each of its points in M, full rank in q alone, or has no point there.
// Then (M_p; f_1, …, f_r) of all robots p ∈ P are homeomorphic, zeros and signs of each f_j and e_j included.
//   Full rank in q: a complete cover by `regular`, `boundary` or `isolated` boxes, whose parameters are all free, and whose
//   numbers of free variables are that of variables less that of equations.
//   M is compact: what it comes to that is no limit of all robots would have no point.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corank/analyze/sets/limits.h"
#include "corank/solve/step/control.h"

namespace corank::analyze {

struct SameStrataOptions {
  int threads = 1;
  int parts = 1;                   ///< of the tolerances, at most: of robots in each the hypothesis is proven by itself
  std::uint64_t most = 1'000'000;  ///< boxes processed in one search
};

/// Empty: the hypothesis is proven. Else the condition that is not. `own_ends`: names of limits that are not the same for
/// all robots; the set may not come to them. Polynomial::source names a function.
std::string obstacle_to_same_strata(const System& system, const std::vector<Polynomial>& functions,
                                    const std::vector<std::string>& own_ends, const SameStrataOptions& options,
                                    solve::Control& control);

}  // namespace corank::analyze
