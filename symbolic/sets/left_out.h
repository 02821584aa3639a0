// An equation that a robot has and its mechanism has not: it follows from equations of the mechanism by an exact identity.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/symbolic/model/expression.h"

namespace corank::symbolic {

struct LeftOut {
  std::optional<Expression> value;  ///< value = 0; nothing where it is too long to be read
  std::string note;
  SourceLocation where;
  /// What it follows from, beside sin² + cos² = 1: equations of Φ(q) = 0 and rows of L, as derive() numbers them, from 1.
  std::vector<std::size_t> equations{}, rows{};

  std::string relation() const { return value ? (*value == Expression(0)).text() : "an equation too long to be read"; }
  /// "robot.cuik:17 (loop)".
  std::string source() const;
  /// "follows from (1), (3) of Φ(q) = 0 and (2) of L".
  std::string reason() const;
};

}  // namespace corank::symbolic
