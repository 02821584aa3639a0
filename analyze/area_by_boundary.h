// The area of a workspace in the plane of two outputs, from a cover of its boundary.
//
// W = { (x, y) : a configuration within the limits has these outputs } is compact where its coordinates have ranges.
// Theorem: let B hold the outputs of all generalized singularities (symbolic/boundary.h), and let no configuration be at
// an end of a range that is no limit. Then ∂W ⊂ B. For let q be a configuration over a point of ∂W: if it were none of
// those, the outputs could move from q in every direction, coordinates at their limits kept there or moving inward
// (doc/theory.md, "Workspace boundaries"), and a neighbourhood of the point would be in W. So every connected set of the
// plane that does not meet B lies in W or has no point of it: one point tells which. What is outside of the smallest
// rectangle about B is not in W, since W is compact and the points of W furthest out are in ∂W.
#pragma once

#include <optional>

#include "corank/analyze/workspace_area.h"
#include "corank/solve/control.h"
#include "corank/study/question.h"

namespace corank::analyze {

struct BoundaryAreaOptions {
  double fineness = 1.0 / 1500;  ///< σ of the boundary's boxes, in shares of the workspace's larger side
  int threads = 1;
  int most_components = 200;  ///< of the plane without B that are tested, the largest first; the others stay open
};

/// For `question` about the set boundary, with two lengths as outputs. Nothing where the theorem does not apply: outputs
/// that are angles or no two, a range that is no limit and may be reached, an inequality of the model, sines of lengths, a
/// cover that a limit has ended.
std::optional<AreaBounds> area_by_boundary(const study::Question& question, const BoundaryAreaOptions& options,
                                           solve::Control& control);

/// Are the model's outputs two lengths?
bool has_plane_of_lengths(const symbolic::Mechanism& model);

/// Bounds of the same area; where its boundary does not give them, with `anyway` by dividing the plane, which may take long.
std::optional<Interval> area(const study::Question& question, int threads, bool anyway, solve::Control& control);

}  // namespace corank::analyze
