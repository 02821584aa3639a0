// The least value of a variable among the solutions of a system, found by Ipopt (key WaechterBiegler2006). Heuristic: a
// start for a proof.
#pragma once

#include <optional>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/core/cover.h"
#include "corank/core/ended.h"

namespace corank::solve {

/// A local minimum of x_variable among the solutions in the box, from a start in it. Nothing where Ipopt finds no solution,
/// or `ended` is true before.
std::optional<std::vector<double>> local_minimum(const certify::CompiledSystem& system, int variable, const Box& box,
                                                 const std::vector<double>& start, const Ended& ended = {});

}  // namespace corank::solve
