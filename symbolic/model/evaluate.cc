#include "corank/symbolic/model/evaluate.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

namespace corank::symbolic {
namespace {

template <typename Real>
Real value_of(const std::string& name, Real x) {
  if (name == "sin") return std::sin(x);
  if (name == "cos") return std::cos(x);
  if (name == "tan") return std::tan(x);
  if (name == "asin") return std::asin(x);
  if (name == "acos") return std::acos(x);
  if (name == "atan") return std::atan(x);
  if (name == "sqrt") return std::sqrt(x);
  if (name == "exp") return std::exp(x);
  if (name == "log") return std::log(x);
  if (name == "abs") return std::fabs(x);
  return std::numeric_limits<Real>::quiet_NaN();
}

}  // namespace

long double function_value(const std::string& name, long double x) { return value_of(name, x); }
double function_value(const std::string& name, double x) { return value_of(name, x); }

double evaluate(const Expression& e, const std::map<std::string, double>& values) {
  const auto operand = [&](std::size_t i) { return evaluate(e.operands()[i], values); };
  switch (e.kind()) {
    case Expression::Kind::number: return std::strtod(e.name().c_str(), nullptr);
    case Expression::Kind::symbol: {
      if (e.name() == "pi") return std::numbers::pi;
      const auto known = values.find(e.name());
      return known == values.end() ? std::numeric_limits<double>::quiet_NaN() : known->second;
    }
    case Expression::Kind::negation: return -operand(0);
    case Expression::Kind::sum: {
      double sum = 0;
      for (const Expression& term : e.operands()) sum += evaluate(term, values);
      return sum;
    }
    case Expression::Kind::product: {
      double product = 1;
      for (const Expression& factor : e.operands()) product *= evaluate(factor, values);
      return product;
    }
    case Expression::Kind::quotient: return operand(0) / operand(1);
    case Expression::Kind::power: return std::pow(operand(0), operand(1));
    case Expression::Kind::function: return function_value(e.name(), operand(0));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace corank::symbolic
