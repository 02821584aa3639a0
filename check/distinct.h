// No two boxes hold the same point: boxes are disjoint.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "corank/core/cover.h"

namespace corank::check {

/// Pairs of boxes that have a point in common and are not told apart otherwise, each once; at most `limit`. Sweep along the
/// side that spreads the boxes most.
std::vector<std::pair<std::size_t, std::size_t>> meeting_pairs(const std::vector<const Box*>& boxes,
                                                               const std::function<bool(std::size_t, std::size_t)>& apart,
                                                               std::size_t limit);

}  // namespace corank::check
