// Without OMPL no way is sampled.
#include "corank/analyze/paths/tube_builder.h"

namespace corank::analyze {

std::optional<TubeBuilder::Points> sampled_way(const PathSpace&, const PathSpace::Point&, const PathSpace::Point&, double,
                                               double, const solve::Control&) {
  return std::nullopt;
}

}  // namespace corank::analyze
