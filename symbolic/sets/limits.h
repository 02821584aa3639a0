// What the limits of a mechanism mean: which coordinates have one, as exact numbers, and how a system keeps to them; and
// which ranges lengths have whose model gives them none.
#pragma once

#include <vector>

#include "corank/symbolic/sets/singularity_system.h"

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

/// The ranges of lengths that a model declares without one, found from the equations, with proof (certify/unbounded.h):
/// gives every coordinate without a range (Coordinate::has_range) the ends that the system's equations and inequalities
/// imply, rounded outward to three digits and by a little more, so that no solution lies on an end. Where nothing solves
/// them, [−1, 1]. Throws ModelError, with name and line, where no bounds are found: they may exist all the same.
void find_ranges(TrigonometricSystem& system);

}  // namespace corank::symbolic
