#include "corank/symbolic/model/evaluate.h"

#include <cstdlib>
#include <numbers>

namespace corank::symbolic {

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

std::map<std::string, double> constant_values(const Mechanism& mechanism) {
  std::map<std::string, double> values;
  for (const Constant& c : mechanism.constants()) values[c.name] = evaluate(c.value, values);
  return values;
}

}  // namespace corank::symbolic
