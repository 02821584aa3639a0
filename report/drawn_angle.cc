#include "corank/report/drawn_angle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "corank/certify/angle.h"

namespace corank::report {
namespace {

double rounded_down(long double x) {
  const auto nearest = static_cast<double>(x);
  return static_cast<long double>(nearest) > x ? std::nextafter(nearest, -HUGE_VAL) : nearest;
}

// The double below all that x may be.
std::optional<double> below(long double x) {
  const long double error = std::fabs(x) * 0x1p-60L;
  const double least = rounded_down(x - error);
  if (least != rounded_down(x + error)) return std::nullopt;
  return least;
}

}  // namespace

Interval drawn_angle(const Interval& c, const Interval& s, const Interval& range) {
  // Without the origin and the cut between −π and π the least and the greatest angle are at corners.
  const bool simple = c.lo() > 0 || s.lo() > 0 || s.hi() < 0;
  if (simple && std::numeric_limits<long double>::digits >= 64) {
    const auto at = [](double x, double y) {
      return std::atan2(y == 0 ? 0.0L : static_cast<long double>(y), static_cast<long double>(x));  // of −0 it would be −0
    };
    const auto [low, high] = std::minmax({at(c.lo(), s.lo()), at(c.lo(), s.hi()), at(c.hi(), s.lo()), at(c.hi(), s.hi())});
    const std::optional<double> lower = below(low), upper = below(-high);
    if (lower && upper && range.contains(Interval(*lower, -*upper))) return {*lower, -*upper};
  }
  return certify::angle_enclosure(c, s, range);
}

}  // namespace corank::report
