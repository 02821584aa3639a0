// How the boxes of a cover hang together.
#pragma once

#include <vector>

#include "corank/core/ended.h"
#include "corank/result/values/result.h"

namespace corank::report {

/// The connected components of the union of the boxes, projected onto the configuration variables.
///
/// Where the cover is complete: solutions in different components belong to different pieces of the solution set, for a
/// connected piece lies in the union of the boxes, whose components are closed and disjoint. That the solutions in one
/// component are one piece is not proven, nor that a component without a proven solution holds any.
struct Components {
  bool counted = true;                   ///< false: the count was ended, and all below is empty
  std::vector<std::size_t> of_box = {};  ///< component of each box, from 0, by each component's first box
  std::size_t count = 0;
  std::size_t with_proven_solution = 0;  ///< those with a regular, isolated or exact box
};

/// Two boxes touch where they have a point in common; pending boxes count as any other.
Components components(const result::Result& result, const Ended& ended = {});
Components components(const std::vector<CoverBox>& boxes, std::size_t configuration_size, const Ended& ended = {});

}  // namespace corank::report
