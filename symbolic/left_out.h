// An equation that a robot has and its mechanism has not: it follows from equations of the mechanism by an exact identity.
#pragma once

#include <string>
#include <vector>

#include "corank/symbolic/expression.h"

namespace corank::symbolic {

struct LeftOut {
  Expression value;  ///< value = 0
  std::string note;
  SourceLocation where;
  /// What it follows from, beside sin² + cos² = 1: equations of Φ(q) = 0 and rows of L, as derive() numbers them, from 1.
  std::vector<std::size_t> equations{}, rows{};

  std::string relation() const { return (value == Expression(0)).text(); }
  /// "robot.cuik:17 (loop)".
  std::string source() const;
  /// "follows from (1), (3) of Φ(q) = 0 and (2) of L".
  std::string reason() const;
};

}  // namespace corank::symbolic
