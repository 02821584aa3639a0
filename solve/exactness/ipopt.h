// Points that Ipopt finds (key WaechterBiegler2006), in doubles. Heuristic: starts for what certify/ proves.
#pragma once

#include <optional>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/core/cover.h"
#include "corank/core/ended.h"

namespace corank::solve {

/// The point of a box that comes nearest to solving a system: a local minimum of ½‖F(x)‖² over the box, each side widened by
/// half its width, from its midpoint. Nothing where Ipopt fails. Ends with the point that it has once `ended` is true.
std::optional<std::vector<double>> polish(const System& system, const Box& box, const Ended& ended = {});

/// A local minimum of x_variable among the solutions in the box, from a start in it. Nothing where Ipopt finds no solution,
/// or `ended` is true before.
std::optional<std::vector<double>> local_minimum(const certify::CompiledSystem& system, int variable, const Box& box,
                                                 const std::vector<double>& start, const Ended& ended = {});

}  // namespace corank::solve
