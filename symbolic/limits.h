// What the limits of a mechanism mean: which coordinates have one, as exact numbers, and how a system keeps to them.
#pragma once

#include <vector>

#include "corank/symbolic/mechanism.h"

namespace corank::symbolic {

/// The limits that are some: an angle's of a whole turn or more is none. Throws ModelError, with the limit's line, for one
/// that is empty, of one value (that is a range: a part of the motion to look at), unbounded, or beyond the declared range,
/// which would cut off a part of what the limit allows.
std::vector<Limit> effective_limits(const Mechanism& mechanism);

/// The mechanism with its limits as ranges, and without limits: the same configurations, of which no end is asked for, and
/// whose ranges may be narrowed further.
Mechanism limits_as_ranges(Mechanism mechanism);

/// Narrows the ranges of the coordinates, those of a mechanism, to its limits.
void keep_limits(const Mechanism& mechanism, std::vector<Coordinate>& coordinates);

}  // namespace corank::symbolic
