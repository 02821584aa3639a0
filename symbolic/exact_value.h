// An expression in a mechanism's constants as the exact number that it is.
#pragma once

#include "corank/core/exact_number.h"
#include "corank/symbolic/mechanism.h"

namespace corank::symbolic {

/// Throws ModelError where the expression has anything but constants, or no real value. `what` is for messages: "theta1".
ExactNumber exact_value(const Mechanism& mechanism, const Expression& expression, const std::string& what);

}  // namespace corank::symbolic
