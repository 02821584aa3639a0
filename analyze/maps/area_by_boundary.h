// The area of a workspace in the plane of two outputs, in proven bounds: from a cover of its boundary, or by dividing the
// plane.
//
// W = { (x, y) : a configuration within the limits has these outputs } is compact where its coordinates have ranges.
// Theorem: let B hold the outputs of all generalized singularities (symbolic/sets/boundary.h), and let no configuration be
// at an end of a range that is no limit. Then ∂W ⊂ B. For let q be a configuration over a point of ∂W: if it were none of
// those, the outputs could move from q in every direction, coordinates at their limits kept there or moving inward
// (doc/theory.md, "Workspace boundaries"), and a neighbourhood of the point would be in W. So every connected set of the
// plane that does not meet B lies in W or has no point of it: one point tells which. What is outside of the smallest
// rectangle about B is not in W, since W is compact and the points of W furthest out are in ∂W.
#pragma once

#include <functional>
#include <optional>

#include "corank/core/system.h"
#include "corank/solve/step/control.h"
#include "corank/study/question.h"

namespace corank::analyze {

struct AreaBounds {
  double lo = 0, hi = 0;  ///< the area is in [lo, hi]
  std::size_t cells = 0;  ///< examined
};

struct BoundaryAreaOptions {
  double fineness = 1.0 / 1500;  ///< σ of the boundary's boxes, in shares of the workspace's larger side
  int threads = 1;
  int most_components = 200;  ///< of the plane without B that are tested, the largest first; the others stay open
};

/// For `question` about the set boundary, with two lengths as outputs. Nothing where the theorem does not apply: outputs
/// that are angles or no two, a range that is no limit and may be reached, an inequality that is_no_end(), sines of
/// lengths, a cover that a limit has ended.
std::optional<AreaBounds> area_by_boundary(const study::Question& question, const BoundaryAreaOptions& options,
                                           solve::Control& control);

struct AreaOptions {
  double share = 0.02;             ///< the bounds may differ by so much of the upper one
  std::size_t max_cells = 20'000;  ///< that are examined
  std::function<bool()> stop{};    ///< ends the work, with what is proven so far
};

/// Is every point of the cell an output (1), none (−1)? 0: that is not known after `tries` tries.
int membership(const System& configurations, int x, int y, const Interval& cell_x, const Interval& cell_y, int tries);

/// Bounds of the area for any mechanism. The plane is divided into cells, the largest undecided one first. A cell is
///   in    where newton_prove (certify/newton.h), with the outputs free in the cell and the coordinates that are left over
///         fixed at values, shows one configuration for every output in it, and DomainTest that all of these are inside;
///   out   where projections, Newton steps and bisection leave nothing of the configurations over it.
/// So Σ in ≤ area(W) ≤ Σ in + Σ undecided; sums are rounded outward, and cells meet in edges, which have no area.
/// Of a system of configurations (symbolic::configurations) with exact coefficients; x and y are variables of it.
AreaBounds workspace_area(const System& configurations, int x, int y, const AreaOptions& options = {});

/// Are these two lengths of the model?
bool is_plane_of_lengths(const symbolic::Mechanism& model, const std::vector<std::string>& names);

/// Bounds of the same area; where its boundary does not give them, with `anyway` by dividing the plane, which may take long.
std::optional<Interval> area(const study::Question& question, int threads, bool anyway, solve::Control& control);

}  // namespace corank::analyze
