// Ways on a C-space of any dimension by sampling: OMPL's planners on the projected state space of a constraint (key
// Kingston2019). In doubles; nothing is proven by them. Without OMPL no way is sampled (path_sampling_missing.cc); CMake
// chooses.
#pragma once

#include <optional>

#include "corank/analyze/path_space.h"
#include "corank/analyze/tube_builder.h"
#include "corank/solve/control.h"

namespace corank::analyze {

/// A way whose margins (PathSpace::state) are at least `margin` and whose signs are those of its start; nothing where none
/// was found in so many seconds.
std::optional<TubeBuilder::Points> sampled_way(const PathSpace& space, const PathSpace::Point& from,
                                               const PathSpace::Point& to, double margin, double seconds,
                                               const solve::Control& control);

}  // namespace corank::analyze
