// Shrinking a box by one equation or inequality.
//
// Theorem (hull consistency by decomposition, "HC4"; Benhamou, Goualard, Granvilliers, Puget 1999, key Benhamou1999): let
// f(x) = Σ t_k(x) and X a box. If x ∈ X and f(x) = 0, then t_k(x) ∈ −Σ_{j≠k} T_j, T_j an enclosure of t_j over X, and each
// variable of t_k lies in the inverse image of that set. So replacing X by the intersection with those inverse images, or
// deleting X where one is empty, loses no solution. For f(x) ≥ 0, [0, ∞] stands for 0.
//
// An inequality's value also lies in f(c) + s·(X − c), s its slopes over X about the midpoint c (CompiledSystem::slopes; key
// Neumaier1990, § 2.3), and each x_j is solved for there in the same way: (a − b)² ≥ 1/4 is written as a² − 2ab + b², which
// says nothing over a box where a and b are wide, and this does. Equations have such rows from Newton's step.
#pragma once

#include <cstdint>
#include <span>

#include "corank/certify/compiled_system.h"

namespace corank::certify {

/// Shrinks x, whose sides may be infinite, in place. Returns false where no point of x satisfies the row: the box may be
/// deleted. For every variable that loses more than `share` of its width, changed[variable] is set to 1.
/// Proves: every point of the old box that satisfies the row is in the new one. Says nothing about existence.
bool project(const CompiledSystem& system, int row, std::span<Interval> x, double share, std::uint8_t* changed);

}  // namespace corank::certify
