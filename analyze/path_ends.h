// Configurations by the values of some of their coordinates: the rest is solved for.
#pragma once

#include <vector>

#include "corank/analyze/path_space.h"
#include "corank/solve/control.h"

namespace corank::analyze {

/// As PathFinder::ends(), of its space.
std::vector<Box> find_ends(const PathSpace& space, const std::vector<NamedValue>& values, solve::Control& control);

}  // namespace corank::analyze
