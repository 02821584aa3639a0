// A part of a set in which two links are in line and turn freely together: a leg folded upon itself, whose two links are
// equally long, holds its end at its base, whatever the angle of its crank.
//
// Theorem: with the dependent angle put in, a = ± b + k π/2, let no equation and no inequality of Φ be about b, and let a
// and b turn fully. Then the part is the product of b's circle and of what Φ leaves in the other coordinates. ∎
#pragma once

#include <optional>

#include "corank/symbolic/algebra/dependent_angle.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// Φ(q) = 0 in the other coordinates; nothing where the theorem does not apply.
std::optional<TrigonometricSystem> without_free_fold(const Mechanism& mechanism, const DependentAngle& angle);

}  // namespace corank::symbolic
