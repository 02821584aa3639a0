#include "corank/report/drawing_tree.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

namespace corank::report {
namespace {

using Json = nlohmann::ordered_json;
using symbolic::Expression;
using Kind = Expression::Kind;

double function(const std::string& name, double x) {
  static const std::map<std::string, double (*)(double)> functions = {
      {"sin", std::sin},   {"cos", std::cos},   {"tan", std::tan}, {"asin", std::asin}, {"acos", std::acos},
      {"atan", std::atan}, {"sqrt", std::sqrt}, {"exp", std::exp}, {"log", std::log},   {"abs", std::fabs}};
  return functions.at(name)(x);
}

double value(const Expression& e, const std::vector<double>& x) {
  switch (e.kind()) {
    case Kind::sum: {
      double sum = 0;
      for (const double term : x) sum += term;
      return sum;
    }
    case Kind::product: {
      double product = 1;
      for (const double factor : x) product *= factor;
      return product;
    }
    case Kind::quotient: return x[0] / x[1];
    case Kind::power: return std::pow(x[0], x[1]);
    case Kind::negation: return -x[0];
    case Kind::function: return function(e.name(), x[0]);
    case Kind::number:
    case Kind::symbol: break;
  }
  throw std::logic_error("no operation");
}

std::string operation(const Expression& e) {
  switch (e.kind()) {
    case Kind::sum: return "+";
    case Kind::product: return "*";
    case Kind::quotient: return "/";
    case Kind::power: return "^";
    case Kind::negation: return "-";
    default: return e.name();
  }
}

Json tree(const Expression& e, const ConstantValues& constants) {
  if (e.kind() == Kind::number) return std::stod(e.name());
  if (e.kind() == Kind::symbol) {
    if (e.name() == "pi") return std::numbers::pi;
    const auto constant = constants.find(e.name());
    return constant == constants.end() ? Json(e.name()) : Json(constant->second);
  }
  Json node = {operation(e)};
  std::vector<double> numbers;
  for (const Expression& operand : e.operands()) {
    node.push_back(tree(operand, constants));
    if (node.back().is_number()) numbers.push_back(node.back().get<double>());
  }
  return numbers.size() == e.operands().size() ? Json(value(e, numbers)) : node;
}

}  // namespace

ConstantValues constant_values(const symbolic::Mechanism& mechanism) {
  ConstantValues values;
  for (const symbolic::Constant& c : mechanism.constants()) values[c.name] = tree(c.value, values).get<double>();
  return values;
}

std::string drawing_tree(const Expression& e, const ConstantValues& constants) { return tree(e, constants).dump(); }

}  // namespace corank::report
