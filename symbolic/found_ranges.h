// The ranges of lengths that a model declares without one: found from the equations, with proof (certify/unbounded.h).
#pragma once

#include "corank/symbolic/singularity_system.h"

namespace corank::symbolic {

/// Gives every coordinate without a range (Coordinate::has_range) the ends that the system's equations and inequalities
/// imply, rounded outward to three digits and by a little more, so that no solution lies on an end. Where nothing solves
/// them, [−1, 1].
/// Throws ModelError, with name and line, where no bounds are found: they may exist all the same.
void find_ranges(TrigonometricSystem& system);

}  // namespace corank::symbolic
