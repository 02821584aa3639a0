// Is the shape of a solution set (core/shape.h) what is claimed? Everything is found anew from the system; trusted is
// nothing but where to look.
//
//   the cover    check/checker.h, with its proof of completeness; every box is `regular`
//   at_most      the classes into which links that are confirmed join the sheets (check/linking.h): every solution lies in
//                one. Where the set is closed, also the number of minima of a height: each component has one
//   at_least     the groups of boxes that hang together: those of one class, and those that touch, unless a search of the
//                checker's own shows that they have no solution in common. The groups' parts of the set are closed and
//                disjoint, and each holds a solution
//   closed       no solution is on an end of the domain or an inequality, but for those that the equations imply: so the set
//                is a compact manifold without boundary
//   χ            Σ (−1)^index over the critical points of a height (Morse): their cover is complete, each of its boxes
//                stands for a point, each point is one simple solution, in the interior of the multipliers' half-space, and
//                its index is found by check/inertia.h
//   genus        1 − χ/2 of a closed connected surface, the regular level set of functions, so orientable; of one of several
//                with the critical points that lie on its sheets
//   refused      where at_least is above at_most, or heights of a closed set give different χ, or one of odd dimension
//                another than 0: boxes or critical points are missing
#pragma once

#include <vector>

#include "corank/check/checker.h"
#include "corank/core/shape.h"

namespace corank::check {

/// The critical points of a height as a model gives them, over the variables of the system: the second derivative of μh +
/// λᵀΦ, the equations' Jacobian, μ.
struct CriticalSystem {
  System system;
  PolynomialMatrix hessian, jacobian;
  Polynomial multiplier;
};

struct ShapeReport : Findings {
  Report space;
  std::vector<Report> heights;
  std::size_t sheets = 0, links = 0;  ///< that are confirmed
  std::size_t apart = 0;              ///< pairs of boxes that touch and are shown to have no solution in common
  int at_least = 0, at_most = 0;      ///< components, as the boxes in the file show
  bool closed = false;
  std::vector<std::vector<int>> by_index;  ///< of each height

  /// Nothing claimed is wrong or could not be shown, as far as the boxes go that the file has.
  bool verified() const;
  /// verified(), and these are proven to be all.
  bool complete() const;
};

/// `heights`: one for each of the shape's. Never throws for what a shape says.
ShapeReport check_shape(const System& system, const Shape& shape, const std::vector<CriticalSystem>& heights,
                        const Options& options = {});

}  // namespace corank::check
