// The point of a box that comes nearest to solving a system, found by Ipopt (key WaechterBiegler2006). Heuristic: a start
// for what certify/refinement.h does with many digits.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/cover.h"
#include "corank/core/ended.h"

namespace corank::solve {

/// A local minimum of ½‖F(x)‖² over the box, each side widened by half its width, from its midpoint. Nothing where Ipopt
/// fails. Ends with the point that it has once `ended` is true.
std::optional<std::vector<double>> polish(const System& system, const Box& box, const Ended& ended = {});

}  // namespace corank::solve
