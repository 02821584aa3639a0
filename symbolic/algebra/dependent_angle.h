// An angle that is another one, turned or mirrored.
#pragma once

#include <string>

#include "corank/symbolic/model/expression.h"

namespace corank::symbolic {

/// a = sign·b + quarters·π/2 (mod 2π), between angles a and b of which a stands behind b.
struct DependentAngle {
  std::string angle, other;
  int sign = 1, quarters = 0;

  Relation relation() const;
  /// "phi = theta", "phi = -theta + pi", "phi = theta - pi/2".
  std::string text() const { return relation().text(); }
};

}  // namespace corank::symbolic
