#include "corank/symbolic/sets/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "corank/certify/unbounded.h"
#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/algebra/polynomial_expander.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/sets/algebrizer.h"

namespace corank::symbolic {
namespace {

// Knows the constants that the ends of limits and the ranges of their coordinates need. Others may take long.
PolynomialExpander values_for_limits(const Mechanism& mechanism) {
  std::vector<Expression> asked;
  for (const Limit& limit : mechanism.limits()) {
    const Coordinate& c = mechanism.coordinates()[mechanism.find_coordinate(limit.coordinate)];
    asked.insert(asked.end(), {limit.lower, limit.upper, c.lower, c.upper});
  }
  const std::vector<Constant>& constants = mechanism.constants();
  std::vector<bool> needed(constants.size());
  for (std::size_t k = constants.size(); k-- > 0;) {  // each needs only those before it
    needed[k] = std::ranges::any_of(asked, [&](const Expression& e) { return e.mentions(constants[k].name); });
    if (needed[k]) asked.push_back(constants[k].value);
  }
  PolynomialExpander values;
  for (std::size_t k = 0; k < constants.size(); ++k) {
    if (!needed[k]) continue;
    if (constants[k].tolerance)
      throw ModelError(mechanism.limits()[0].where,
                       "limits depend on " + in_quotes(constants[k].name) + ", which is known within a tolerance only",
                       "numbers and constants without a tolerance");
    values.define(constants[k]);
  }
  return values;
}

// Is it one? Throws where it is faulty.
bool is_effective(const Limit& limit, const Coordinate& coordinate, PolynomialExpander& values) {
  const std::string what = "the limit of " + in_quotes(limit.coordinate), text = what + ", " + limit.text() + ",";
  const ConstantValue lower = values.constant(limit.lower, what, limit.where),
                      upper = values.constant(limit.upper, what, limit.where);
  const ConstantValue turn = ConstantValue(2) * ConstantValue::pi();
  const std::optional<int> width = (upper - lower).sign();
  if (width == -1) throw ModelError(limit.where, text + " is empty", "a lower end that is below the upper one");
  if (width.value_or(0) == 0)
    throw ModelError(limit.where, text + " is one value",
                     "a lower end that is below the upper one, or a range of one value");
  if (!lower.exact().enclose().is_bounded() || !upper.exact().enclose().is_bounded())
    throw ModelError(limit.where, text + " is unbounded", "ends within double precision's range");
  const bool angle = coordinate.kind == CoordinateKind::angle;
  if (angle && (turn - (upper - lower)).sign().value_or(0) <= 0) return false;
  if (!coordinate.has_range) return true;
  const std::string range = "the range of " + in_quotes(limit.coordinate);
  const ConstantValue from = values.constant(coordinate.lower, range, coordinate.where),
                      to = values.constant(coordinate.upper, range, coordinate.where);
  if (angle && (turn - (to - from)).sign().value_or(0) <= 0) return true;
  if ((lower - from).sign().value_or(-1) < 0 || (to - upper).sign().value_or(-1) < 0)
    throw ModelError(limit.where, text + " reaches beyond the declared range, " + coordinate.range_text(),
                     "a range that holds the limit");
  return true;
}

constexpr int kDigits = 3;
constexpr int kLargestExponent = 290;  // of ten: beyond it doubles end

// units · 10^exponent.
Expression decimal(double units, int exponent) {
  const std::string digits = fmt::format("{:.0f}", std::abs(units));
  const std::string text = exponent >= 0 ? digits + std::string(exponent, '0')
                                         : fmt::format("{:0>{}}", digits, 1 - exponent);  // a digit before the point
  const auto point = static_cast<std::ptrdiff_t>(text.size()) + std::min(exponent, 0);
  std::string number = text.substr(0, point);
  if (exponent < 0) number += "." + text.substr(point);
  return units < 0 ? -Expression::number(number) : Expression::number(number);
}

// Ends beyond those of x, with few digits; how far beyond depends on the longer one.
void widen(const Interval& x, Coordinate& coordinate) {
  const int exponent = x.mag() > 0 ? static_cast<int>(std::floor(std::log10(x.mag()))) - (kDigits - 1) : -kDigits;
  const double unit = std::pow(10.0, exponent);
  // A hundredth of a unit is far more than what these divisions lose.
  coordinate.lower = decimal(std::floor(x.lo() / unit - 0.01), exponent);
  coordinate.upper = decimal(std::ceil(x.hi() / unit + 0.01), exponent);
}

bool is_plausible(const Interval& x) {
  return x.is_bounded() && x.mag() < std::pow(10.0, kLargestExponent) &&
         (x.mag() == 0 || x.mag() > std::pow(10.0, -kLargestExponent));
}

}  // namespace

std::vector<Limit> effective_limits(const Mechanism& mechanism) {
  if (mechanism.limits().empty()) return {};
  const GinacLock lock;
  PolynomialExpander values = values_for_limits(mechanism);
  std::vector<Limit> result;
  for (const Limit& limit : mechanism.limits()) {
    try {
      const int index = mechanism.find_coordinate(limit.coordinate);
      if (is_effective(limit, mechanism.coordinates()[index], values)) result.push_back(limit);
    } catch (const std::domain_error& error) {
      throw ModelError(limit.where, "the limit of " + in_quotes(limit.coordinate) + " has no real ends: " + error.what(),
                       "real numbers");
    }
  }
  return result;
}

Mechanism limits_as_ranges(Mechanism mechanism) {
  for (const Limit& limit : effective_limits(mechanism)) mechanism.set_range(limit.coordinate, limit.lower, limit.upper);
  mechanism.clear_limits();
  return mechanism;
}

void keep_limits(const Mechanism& mechanism, std::vector<Coordinate>& coordinates) {
  for (const Limit& limit : effective_limits(mechanism)) {
    Coordinate& c = coordinates[mechanism.find_coordinate(limit.coordinate)];
    c.lower = limit.lower;
    c.upper = limit.upper;
    c.has_range = true;
  }
}

void find_ranges(TrigonometricSystem& system) {
  const auto lacks_range = [](const Coordinate& c) { return !c.has_range; };
  if (std::ranges::none_of(system.coordinates, lacks_range)) return;
  for (Coordinate& c : system.coordinates)
    if (!c.has_range) c.lower = -1, c.upper = 1;  // nobody looks at them before they are found
  const System polynomials = algebrize(system);

  std::vector<Interval> x;
  for (const Variable& v : polynomials.variables)
    x.push_back(v.kind == VariableKind::auxiliary ? Interval::whole() : v.domain);
  const auto side = [&](const Coordinate& c) -> Interval& { return x[polynomials.find(c.name)]; };
  for (const Coordinate& c : system.coordinates)
    if (!c.has_range) side(c) = Interval::whole();
  if (!certify::contract_unbounded(polynomials, x)) return;  // no solution anywhere
  for (Coordinate& c : system.coordinates) {
    if (c.has_range) continue;
    if (!is_plausible(side(c)))
      throw ModelError(c.where, "corank finds no bounds in the equations for " + in_quotes(c.name) + ", which has no range",
                       "a range [lower, upper] where it is declared");
    widen(side(c), c);
  }
}

}  // namespace corank::symbolic
