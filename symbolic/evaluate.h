// The value of an expression: in machine numbers, for what is shown and never for what is proven; exactly, of one in a
// mechanism's constants.
#pragma once

#include <map>
#include <string>

#include "corank/core/exact_number.h"
#include "corank/symbolic/mechanism.h"

namespace corank::symbolic {

/// Within rounding errors; NaN where a name has no value or a function none there.
double evaluate(const Expression& e, const std::map<std::string, double>& values);

/// One of the language's functions; NaN where it has no value.
long double function_value(const std::string& name, long double x);
double function_value(const std::string& name, double x);

/// Throws ModelError where the expression has anything but constants, or no real value. `what` is for messages: "theta1".
ExactNumber exact_value(const Mechanism& mechanism, const Expression& expression, const std::string& what);

}  // namespace corank::symbolic
