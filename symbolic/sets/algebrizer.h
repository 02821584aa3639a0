// From sines and cosines to polynomials: every angle θ becomes two variables c_θ, s_θ with c_θ² + s_θ² = 1, sums of angles
// and integer multiples are expanded, an angle's range becomes a linear condition on (c_θ, s_θ), and the way back is kept
// (System::angles). A length keeps its variable; its sines and cosines become terms of the equations or variables
// of their own, see length_functions.h. The result's coefficients are exact.
//
// A range: angle_range.h.
// A range of one value, α = β: in the equations the angle is the constant α. Its variables have the equations c_θ = cos α
// and s_θ = sin α in place of the circle, so that boxes hold them. Jacobians were made before and have the angle's column.
// Likewise of a dependent angle (DependentAngle): in the equations it is sign·b + quarters·π/2, and c_θ and s_θ are that
// angle's.
// A constant with a tolerance is a variable of its own, a parameter (core/system.h), behind the coordinates; constants that
// are defined through it follow it.
#pragma once

#include "corank/core/system.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// Compiles a system. Variables: for each coordinate in order a length's own variable or an angle's pair (c_θ, s_θ), then
/// the kernel unknowns, then auxiliary ones for lengths in sin and cos. Throws ModelError, naming the equation and the term,
/// for what is no polynomial: an angle outside sin and cos, tan of an unknown, a quotient of unknowns, sin of anything that
/// is not linear, a fractional multiple of an angle, a non-integer power of an unknown; also for an empty range and a
/// constant equation that is inconsistent.
System algebrize(const TrigonometricSystem& system);

/// Expressions in the coordinates, kernel unknowns and constants of a system as polynomials in the variables of
/// algebrize(system), such as the entries of a matrix whose rank is asked for over a cover's boxes. An angle's sine and
/// cosine are its variables, whatever they are in the equations: where it has one value, a constant. Throws ModelError as
/// algebrize() does, and for a sine or cosine of a length.
std::vector<Polynomial> polynomials(const TrigonometricSystem& system, const std::vector<Expression>& expressions);

}  // namespace corank::symbolic
