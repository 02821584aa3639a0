// A zero of a system in many digits, by Newton's method in multiprecision arithmetic. Nothing is proven by it.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/ended.h"
#include "corank/core/system.h"

namespace corank::solve {

/// A point near `start` where the equations vanish to about bits/2 bits, found by Gauss–Newton steps (least
/// squares, least norm) in MPFR arithmetic; also at a multiple solution, where each step gains a bit only. Coordinates are
/// dyadic rationals. Nothing where the steps do not end there, or `ended` is true before.
std::optional<std::vector<ExactNumber>> approximate_zero(const System& system, const std::vector<ExactNumber>& start,
                                                         int bits, const Ended& ended = {});

}  // namespace corank::solve
