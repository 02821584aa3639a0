#include "corank/symbolic/model/model_validator.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/model/expression_words.h"

namespace corank::symbolic {
namespace {

using Kind = Expression::Kind;

/// Rough: it only decides whether an exponent is absurd.
long double rough_number(const std::string& decimal) {
  long double value = 0;
  const auto parsed = std::from_chars(decimal.data(), decimal.data() + decimal.size(), value);
  if (parsed.ec == std::errc()) return value;
  return decimal.find("e-") == std::string::npos ? std::numeric_limits<long double>::infinity() : 0;
}

}  // namespace

ModelValidator::ModelValidator(const Mechanism& mechanism) {
  for (const Constant& c : mechanism.constants()) declared_.emplace(c.name, &c);
  for (const Coordinate& c : mechanism.coordinates()) coordinates_.emplace(c.name, &c);
  for (const Composite& c : mechanism.composites()) composites_.emplace(c.name, &c);
  for (const Rate& r : mechanism.rates()) rates_.emplace(r.name, &r);
}

void ModelValidator::add_constant(const Constant& constant) {
  const Context context{"the constant " + in_quotes(constant.name), true, constant.where};
  if (constant.tolerance) {
    check(constant.tolerance->lower, context);
    check(constant.tolerance->upper, context);
  }
  constants_.emplace(constant.name, check(constant.value, context));
}

void ModelValidator::check_value(const Expression& value, const std::string& owner, const SourceLocation& where) const {
  check(value, {owner, true, where});
}

void ModelValidator::check_range(const Coordinate& coordinate) const {
  const Context context{"the range of " + in_quotes(coordinate.name), true, coordinate.where};
  check(coordinate.lower, context);
  check(coordinate.upper, context);
}

void ModelValidator::check_constraint(const Constraint& constraint) const {
  const Context context{"an equation", false, constraint.where};
  check(constraint.relation.lhs, context);
  check(constraint.relation.rhs, context);
}

void ModelValidator::check_point(const DrawingPoint& point) const {
  const Context context{"the point " + in_quotes(point.name), false, point.where};
  for (const Expression& coordinate : point.coordinates) {
    check(coordinate, context);
    require_angles_inside_functions(coordinate, context);
  }
  if (point.velocity.empty()) return;
  const Context velocity{"the velocity of the point " + in_quotes(point.name), false, point.where, true};
  if (rates_.empty()) throw ModelError(point.where, velocity.owner + " is given, but the model has no rates", "[RATES]");
  for (const Expression& component : point.velocity) {
    check(component, velocity);
    require_angles_inside_functions(component, velocity);
    require_linear_in_rates(component, velocity);
  }
}

void ModelValidator::check_velocity_equation(const Constraint& equation) const {
  const Context context{"a velocity equation", false, equation.where, true};
  bool any = false;
  for (const Expression& side : {equation.relation.lhs, equation.relation.rhs}) {
    check(side, context);
    any = any || std::ranges::any_of(rates_, [&](const auto& rate) { return side.mentions(rate.first); });
  }
  if (!any)
    throw ModelError(equation.where, "the velocity equation `" + equation.relation.text() + "` holds no rate",
                     "an equation that is linear in the rates");
  require_linear_in_rates(equation.relation.lhs, context);
  require_linear_in_rates(equation.relation.rhs, context);
}

void ModelValidator::require_linear_in_rates(const Expression& e, const Context& context) const {
  if (e.kind() == Expression::Kind::sum || e.kind() == Expression::Kind::negation) {
    for (const Expression& operand : e.operands()) require_linear_in_rates(operand, context);
    return;
  }
  const std::optional<int> degree = rate_degree(e, 1);
  if (degree == 1) return;
  throw ModelError(e.where_or(context.where),
                   "the term " + in_quotes(e.text()) + " in " + context.owner +
                       (degree == 0 ? " holds no rate" : " is not linear and homogeneous in the rates"),
                   "a rate times an expression in coordinates and constants");
}

std::optional<int> ModelValidator::rate_degree(const Expression& e, int wanted) const {
  const auto of = [&](std::size_t i, int degree) { return rate_degree(e.operands()[i], degree); };
  switch (e.kind()) {
    case Kind::number: return same_tree(e, Expression(0)) ? wanted : 0;
    case Kind::symbol: return rates_.contains(e.name()) ? 1 : 0;
    case Kind::negation: return of(0, wanted);
    case Kind::sum: {
      const std::optional<int> first = of(0, wanted);
      for (std::size_t i = 1; i < e.operands().size() && first; ++i)
        if (of(i, wanted) != first) return std::nullopt;
      return first;
    }
    case Kind::product: {
      int sum = 0;
      for (std::size_t i = 0; i < e.operands().size(); ++i) {
        const std::optional<int> degree = of(i, 0);
        if (!degree) return std::nullopt;
        sum += *degree;
      }
      return sum;
    }
    case Kind::quotient: return of(1, 0) == 0 ? of(0, wanted) : std::nullopt;
    case Kind::power: return of(0, 0) == 0 && of(1, 0) == 0 ? std::optional(0) : std::nullopt;
    case Kind::function: return of(0, 0) == 0 ? std::optional(0) : std::nullopt;
  }
  return std::nullopt;
}

void ModelValidator::check_part(const DrawingPart& part) const {
  if (!part.has_radius()) return;
  const std::string owner = std::string("the radius of the ") + to_string(part.kind);
  const Size size = check(part.radius, {owner, true, part.where});
  if (size.value >= 0 && std::isfinite(size.value)) return;
  throw ModelError(part.radius.where_or(part.where), owner + " is " + in_quotes(part.radius.text()),
                   "a length of 0 or more");
}

// Angles that differ by a whole turn are the same, and so must be what is drawn.
void ModelValidator::require_angles_inside_functions(const Expression& e, const Context& context) const {
  const bool is_function = e.kind() == Expression::Kind::function;
  if (is_function && (e.name() == "sin" || e.name() == "cos" || e.name() == "tan")) return;
  if (e.kind() == Expression::Kind::symbol) {
    const auto coordinate = coordinates_.find(e.name());
    if (coordinate == coordinates_.end() || coordinate->second->kind != CoordinateKind::angle) return;
    throw ModelError(e.where_or(context.where),
                     "the angle " + in_quotes(e.name()) + " in " + context.owner + " is outside sin, cos and tan",
                     "cos(" + shortened(e.name()) + ") or the like");
  }
  for (const Expression& operand : e.operands()) require_angles_inside_functions(operand, context);
}

ModelValidator::Size ModelValidator::check(const Expression& e, const Context& context) const {
  if (e.kind() == Kind::number) return {1, true, rough_number(e.name())};
  if (e.kind() == Kind::symbol) return check_symbol(e, context);
  if (e.kind() == Kind::power) return check_power(e, context);
  const bool multiplies = e.kind() == Kind::product || e.kind() == Kind::quotient;
  Size size{multiplies ? 0.0 : 1.0, true, e.kind() == Kind::product ? 1.0L : 0.0L};
  bool first = true;
  for (const Expression& operand : e.operands()) {
    const Size part = check(operand, context);
    size.degree = multiplies ? size.degree + part.degree : std::max(size.degree, part.degree);
    size.constant = size.constant && part.constant;
    switch (e.kind()) {
      case Kind::product: size.value *= part.value; break;
      case Kind::quotient: size.value = first ? part.value : size.value / part.value; break;
      case Kind::negation: size.value = -part.value; break;
      case Kind::function: size.value = function_value(e.name(), part.value); break;
      default: size.value += part.value;
    }
    first = false;
  }
  if (e.kind() == Kind::function) size.degree = 1;  // stays symbolic
  if (size.degree > kMaxDegree)
    throw ModelError(e.where_or(context.where), "the powers in " + context.owner + " are too large",
                     "a degree of at most 100000");
  return size;
}

ModelValidator::Size ModelValidator::check_symbol(const Expression& e, const Context& context) const {
  const std::string& name = e.name();
  if (name == "pi") return {1, true, std::numbers::pi_v<long double>};
  if (const auto known = constants_.find(name); known != constants_.end()) return known->second;
  const auto where = [&] { return e.where_or(context.where); };  // made for a fault only: points have thousands of names
  const auto what = [&] { return in_quotes(name) + " in " + context.owner; };
  const auto constant = declared_.find(name);
  if (constant != declared_.end()) {
    const int line = constant->second->where.line;
    throw ModelError(
        where(),
        "the constant " + what() + " is used before its declaration" + (line > 0 ? " in line " + std::to_string(line) : ""),
        "constants declared before");
  }
  if (rates_.contains(name)) {
    if (context.rates) return {1, false, 0};
    throw ModelError(where(), "the rate " + what() + " is not allowed here",
                     context.constants_only ? "numbers and constants" : "numbers, constants and variables");
  }
  const bool is_coordinate = coordinates_.contains(name);
  if (is_coordinate && !context.constants_only) return {1, false, 0};
  if (is_coordinate) throw ModelError(where(), "the variable " + what() + " is not allowed here", "numbers and constants");
  if (const auto composite = composites_.find(name); composite != composites_.end()) {
    const Composite& c = *composite->second;
    const bool unit = c.kind == Composite::Kind::unit;
    throw ModelError(where(), std::string(unit ? "the unit vector " : "the rotation matrix ") + what() + " is not a number",
                     "one of its components " + c.components.front() + " … " + c.components.back());
  }
  throw ModelError(where(), "the name " + what() + " is not declared",
                   context.constants_only ? "a declared constant"
                   : context.rates        ? "a declared constant, variable or rate"
                                          : "a declared constant or variable");
}

ModelValidator::Size ModelValidator::check_power(const Expression& e, const Context& context) const {
  const Size base = check(e.operands()[0], context), exponent = check(e.operands()[1], context);
  const long double magnitude = std::abs(exponent.value);
  if (exponent.constant && !(magnitude <= kMaxExponent)) {  // also where it is no number at all
    throw ModelError(e.operands()[1].where_or(context.where),
                     "the exponent " + in_quotes(e.operands()[1].text()) + " in " + context.owner + " is too large",
                     "at most 1000 in absolute value");
  }
  // An unknown in the exponent is for the algebrizer to refuse.
  const double degree = base.degree * (exponent.constant ? std::max(1.0, static_cast<double>(magnitude)) : 1.0);
  if (degree > kMaxDegree)
    throw ModelError(e.where_or(context.where), "the powers in " + context.owner + " are too large",
                     "a degree of at most 100000");
  return {degree, base.constant && exponent.constant, std::pow(base.value, exponent.value)};
}

}  // namespace corank::symbolic
