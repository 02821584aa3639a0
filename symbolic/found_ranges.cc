#include "corank/symbolic/found_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "corank/certify/unbounded.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/expression_words.h"

namespace corank::symbolic {
namespace {

constexpr int kDigits = 3;
constexpr int kLargestExponent = 290;  // of ten: beyond it doubles end

// units · 10^exponent.
Expression decimal(double units, int exponent) {
  const std::string digits = fmt::format("{:.0f}", std::abs(units));
  const std::string text =
      exponent >= 0 ? digits + std::string(static_cast<std::size_t>(exponent), '0')
                    : fmt::format("{:0>{}}", digits, static_cast<std::size_t>(1 - exponent));  // a digit before the point
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

void find_ranges(TrigonometricSystem& system) {
  const auto lacks_range = [](const Coordinate& c) { return !c.has_range; };
  if (std::none_of(system.coordinates.begin(), system.coordinates.end(), lacks_range)) return;
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
                       "a range, " + shortened(c.name) + " : [lower, upper]");
    widen(side(c), c);
  }
}

}  // namespace corank::symbolic
