// The exact value of an expression in a mechanism's constants.
#pragma once

#include <string>

#include "corank/core/exact_number.h"
#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

/// Throws ModelError where the expression has anything but constants, or no real value. `what` is for messages: "theta1".
ExactNumber exact_value(const Mechanism& mechanism, const Expression& expression, const std::string& what);

}  // namespace corank::symbolic
