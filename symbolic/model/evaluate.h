// The value of an expression in machine numbers: for what is shown, never for what is proven.
#pragma once

#include <map>
#include <string>

#include "corank/symbolic/model/expression.h"

namespace corank::symbolic {

/// Within rounding errors; NaN where a name has no value or a function none there.
double evaluate(const Expression& e, const std::map<std::string, double>& values);

/// One of the language's functions; NaN where it has no value.
long double function_value(const std::string& name, long double x);
double function_value(const std::string& name, double x);

}  // namespace corank::symbolic
