#include "corank/symbolic/algebra/dependent_angle.h"

#include <array>

namespace corank::symbolic {

Relation DependentAngle::relation() const {
  static constexpr std::array<const char*, 4> kOffsets = {"", " + pi/2", " + pi", " - pi/2"};
  return Expression::symbol(angle) == Expression((sign < 0 ? "-" : "") + other + kOffsets[quarters]);
}

}  // namespace corank::symbolic
