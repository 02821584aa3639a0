// The value of an expression in machine numbers: for what is shown, never for what is proven.
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

/// Within rounding errors; NaN where a name has no value or a function none there.
double evaluate(const Expression& e, const std::map<std::string, double>& values);

/// Of the constants' own values.
std::map<std::string, double> constant_values(const Mechanism& mechanism);

/// One of the language's functions, of a number (NaN where it has no value) or of what has such functions in its own
/// namespace: of that, throws std::domain_error for another name.
template <typename X>
X function_value(const std::string& name, const X& x) {
  using std::sin, std::cos, std::tan, std::asin, std::acos, std::atan, std::sqrt, std::exp, std::log, std::abs;
  if (name == "sin") return sin(x);
  if (name == "cos") return cos(x);
  if (name == "tan") return tan(x);
  if (name == "asin") return asin(x);
  if (name == "acos") return acos(x);
  if (name == "atan") return atan(x);
  if (name == "sqrt") return sqrt(x);
  if (name == "exp") return exp(x);
  if (name == "log") return log(x);
  if (name == "abs") return abs(x);
  if constexpr (std::is_floating_point_v<X>) return std::numeric_limits<X>::quiet_NaN();
  throw std::domain_error("the function " + name + " is not known");
}

}  // namespace corank::symbolic
