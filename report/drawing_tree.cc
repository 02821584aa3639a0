#include "corank/report/drawing_tree.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "corank/symbolic/evaluate.h"

namespace corank::report {
namespace {

using Json = nlohmann::ordered_json;
using symbolic::Expression;
using Kind = Expression::Kind;

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

// What has a value without coordinates is a number.
Json tree(const Expression& e, const ConstantValues& constants) {
  if (const double x = evaluate(e, constants); !std::isnan(x)) return x;
  if (e.kind() == Kind::symbol) return e.name();
  Json node = {operation(e)};
  for (const Expression& operand : e.operands()) node.push_back(tree(operand, constants));
  return node;
}

}  // namespace

ConstantValues constant_values(const symbolic::Mechanism& mechanism) {
  ConstantValues values;
  for (const symbolic::Constant& c : mechanism.constants()) values[c.name] = evaluate(c.value, values);
  return values;
}

std::string drawing_tree(const Expression& e, const ConstantValues& constants) { return tree(e, constants).dump(); }

}  // namespace corank::report
