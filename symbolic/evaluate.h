// The value of an expression in double precision, for what is shown and never for what is proven.
#pragma once

#include <map>
#include <string>

#include "corank/symbolic/expression.h"

namespace corank::symbolic {

/// Within rounding errors; NaN where a name has no value or a function none there.
double evaluate(const Expression& e, const std::map<std::string, double>& values);

}  // namespace corank::symbolic
