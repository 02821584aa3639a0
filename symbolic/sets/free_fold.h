// A part of a set in which two links are in line and turn freely together: a leg folded upon itself, whose two links are
// equally long, holds its end at its base, whatever the angle of its crank.
//
// Theorem 1: with the dependent angle put in, a = ± b + k π/2, let no equation and no inequality of Φ be about b, and let a
// and b turn fully. Then the part is the product of b's circle and of what Φ leaves in the other coordinates. ∎
// Theorem 2: let an angle t that turns fully be in one equation of Φ alone, u cos t + v sin t = 0, and in no inequality, and
// let the part's condition be k (u sin t − v cos t) = 0 with a number k ≠ 0; u and v are not about t. Then the part is the
// product of t's circle and of what the others leave with u = v = 0: the squares of both sums add up to u² + v² (k = 1). ∎
// Example: a leg of an Agile Eye whose outer axis is on its motor's.
#pragma once

#include <optional>
#include <string>

#include "corank/symbolic/algebra/dependent_angle.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// Φ(q) = 0 in the other coordinates; nothing where theorem 1 does not apply.
std::optional<TrigonometricSystem> without_free_fold(const Mechanism& mechanism, const DependentAngle& angle);

/// What turns freely, and the part's equations, the condition's included, in the other coordinates.
struct FreeTurn {
  std::string angle;
  TrigonometricSystem system;
};
/// Of the condition = 0; nothing where theorem 2 does not apply.
std::optional<FreeTurn> without_free_turn(const Mechanism& mechanism, const Expression& condition);

}  // namespace corank::symbolic
