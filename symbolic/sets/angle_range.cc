#include "corank/symbolic/sets/angle_range.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace corank::symbolic {
namespace {

// Does [α, β] contain offset + 2πk for some integer k? True where that cannot be decided: the hull may be too wide, never
// too narrow.
bool may_contain(const ConstantRange& range, const ConstantValue& offset) {
  const double lower = range.lower.exact().enclose().lo(), first = offset.exact().enclose().lo();
  const double turns = std::floor((lower - first) / (2 * std::acos(-1.0)));
  if (!(std::abs(turns) < 1e6)) throw std::domain_error("an angle of more than a million turns");
  // The first candidate ≥ α is among these, whatever the double arithmetic above lost.
  for (int k = -1; k <= 2; ++k) {
    const ConstantValue candidate =
        offset + ConstantValue(2) * ConstantValue(static_cast<int>(turns) + k) * ConstantValue::pi();
    if ((candidate - range.lower).sign().value_or(0) >= 0 && (range.upper - candidate).sign().value_or(0) >= 0) return true;
  }
  return false;
}

// Hull of f over the range, for f = cos (or sin) with a maximum at `top` and a minimum at `bottom`, both mod 2π.
ConstantRange hull(const ConstantRange& range, const std::string& f, const ConstantValue& top, const ConstantValue& bottom) {
  const ConstantValue at_lower = ConstantValue::function(f, range.lower), at_upper = ConstantValue::function(f, range.upper);
  const std::optional<int> order = (at_upper - at_lower).sign();
  ConstantRange result{-1, 1};
  if (order && !may_contain(range, bottom)) result.lower = *order >= 0 ? at_lower : at_upper;
  if (order && !may_contain(range, top)) result.upper = *order >= 0 ? at_upper : at_lower;
  return result;
}

}  // namespace

AngleRange angle_range(const ConstantRange& range) {
  const ConstantValue width = range.upper - range.lower, pi = ConstantValue::pi();
  const std::optional<int> below_circle = (ConstantValue(2) * pi - width).sign();
  // Undecided: the range is the whole circle but for 10^-1000 of it. No condition is the safe reading.
  AngleRange result{{-1, 1}, {-1, 1}, std::nullopt, std::nullopt};
  if (below_circle.value_or(0) <= 0) return result;
  if (width.sign() == 0) {
    result.value = {ConstantValue::function("cos", range.lower), ConstantValue::function("sin", range.lower)};
    return result;
  }
  const ConstantValue half_pi = pi / 2;
  result.cosine = hull(range, "cos", 0, pi);
  result.sine = hull(range, "sin", half_pi, -half_pi);
  const ConstantValue m = (range.lower + range.upper) / 2, h = width / 2;
  result.chord = {ConstantValue::function("cos", m), ConstantValue::function("sin", m), ConstantValue::function("cos", h)};
  return result;
}

}  // namespace corank::symbolic
