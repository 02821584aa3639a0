#include "corank/certify/trigonometric.h"

#include <array>

#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

// π/2 in three parts of 26 bits, so that their products with integers below 2²⁷ are exact, and an interval for the rest.
constexpr double kHalfPi1 = 0x1.921fb5p+0, kHalfPi2 = 0x1.110b46p-26, kHalfPi3 = 0x1.1a6263p-54;
const Interval kHalfPi4(0x1.8a2e03707344ap-81, 0x1.8a2e03707344bp-81);
const Interval kHalfPi(0x1.921fb54442d18p+0, 0x1.921fb54442d19p+0), kPi(0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1),
    kInversePi(0x1.45f306dc9c882p-2, 0x1.45f306dc9c883p-2);
const Interval kRange(-1, 1);

// The coefficients of sin(r)/r and cos(r) as series in r²; the last ones are [0, 1] times the next term's, for the
// remainder.
struct Series {
  static constexpr int kTerms = 10;
  std::array<Interval, kTerms> sine, cosine;

  Series() {
    CORANK_CHECK(UpwardRounding::active());
    double factorial = 1;  // exact: the odd part of 20! has 44 bits
    for (int j = 0; j < kTerms; ++j) {
      const auto term = [&] {
        const Interval inverse(j + 1 < kTerms ? -(-1 / factorial) : 0.0, 1 / factorial);
        return j % 2 == 0 ? inverse : -inverse;
      };
      cosine[j] = term();
      factorial *= 2 * j + 1;
      sine[j] = term();
      factorial *= 2 * j + 2;
    }
  }
};

Interval sum_of(const std::array<Interval, Series::kTerms>& series, const Interval& y) {
  Interval sum = series.back();
  for (int j = Series::kTerms - 2; j >= 0; --j) sum = series[j] + y * sum;
  return sum;
}

// cos(x − pπ/2) at a point |x| ≤ kMaxArgument.
Interval wave_at(double x, int p) {
  static const Series series;
  const double k = std::floor(x * kInversePi.hi() * 2 + 0.5);
  const Interval r = Interval(x) - scale(k, kHalfPi1) - scale(k, kHalfPi2) - scale(k, kHalfPi3) - scale(k, kHalfPi4);
  CORANK_CHECK(r.mag() < 1);
  const int quarter = (static_cast<int>(k) - p) & 3;  // cos(r + quarter·π/2) = cos r, −sin r, −cos r, sin r
  const Interval y = square(r);
  Interval value = quarter % 2 == 0 ? sum_of(series.cosine, y) : r * sum_of(series.sine, y);
  if (quarter == 1 || quarter == 2) value = -value;
  CORANK_CHECK(value.intersect(kRange));
  return value;
}

// {cos(x − pπ/2) : x ∈ X}.
Interval wave(const Interval& x, int p) {
  if (!(x.mag() <= kMaxArgument)) return kRange;
  const Interval at_lower = wave_at(x.lo(), p);
  if (x.is_point()) return at_lower;
  Interval value = Interval::hull(at_lower, wave_at(x.hi(), p));
  const Interval turns = x * kInversePi - Interval(0.5 * p);  // x = (j + p/2) π
  const double j = std::ceil(turns.lo());
  const double extreme = std::fmod(j, 2) == 0 ? 1 : -1;
  if (j <= turns.hi()) value = Interval::hull(value, extreme);
  if (j + 1 <= turns.hi()) value = Interval::hull(value, -extreme);
  return value;
}

// The bounds of acos h, h ∈ [−1, 1]: an estimate, moved until the cosine, which decreases on [0, π], proves it.
double acos_down(double h) {
  double a = std::min(std::acos(h), kPi.lo());
  for (double step = 0x1p-52; a > 0 && wave_at(a, 0).lo() < h; step *= 2) a -= step;
  return std::max(a, 0.0);
}
double acos_up(double h) {
  double a = std::max(std::acos(h), 0.0);
  for (double step = 0x1p-52; a <= kPi.lo() && wave_at(a, 0).hi() > h; step *= 2) a += step;
  return a <= kPi.lo() ? a : kPi.hi();
}

// hull{x ∈ within : cos(x − pπ/2) ∈ Y}.
std::optional<Interval> inverse_wave(const Interval& y, const Interval& within, int p) {
  Interval cosines = kRange;
  if (!cosines.intersect(y)) return std::nullopt;
  if (cosines == kRange || !(within.mag() <= kMaxArgument)) return within;
  const Interval arc(acos_down(cosines.hi()), acos_up(cosines.lo()));
  // The branches in ascending order: number 2k is 2πk + pπ/2 − A, number 2k + 1 is 2πk + pπ/2 + A. The first one that is not
  // below `within` bounds its successors from below, the last one that is not above bounds its predecessors from above.
  const auto branch = [&](double number) {
    const double k = std::floor(number / 2);
    return scale(4 * k + p, kHalfPi) + (number == 2 * k ? -arc : arc);
  };
  const double turn = 2 * kPi.hi();
  double number = 2 * std::floor(within.lo() / turn) - 2;
  while (branch(number).hi() < within.lo()) ++number;
  if (branch(number).lo() > within.hi()) return std::nullopt;
  const double lower = std::max(within.lo(), branch(number).lo());
  number = 2 * std::ceil(within.hi() / turn) + 3;
  while (branch(number).lo() > within.hi()) --number;
  const double upper = std::min(within.hi(), branch(number).hi());
  return Interval(lower, std::max(lower, upper));  // out of order by rounding only
}

// sin(h)/h ∈ [1 − h²/6, 1] for every |h| ≤ r/2.
Interval damping(double r) { return {-(r * r / 24 - 1), 1.0}; }

constexpr double kWide = 2;

}  // namespace

Interval sine(const Interval& x) { return wave(x, 1); }
Interval cosine(const Interval& x) { return wave(x, 0); }

Interval sine_slope(const Interval& x, double c) {
  const double r = (x - Interval(c)).mag();
  if (r > kWide) return cosine(Interval::hull(x, c));
  return cosine(scale(0.5, x + Interval(c))) * damping(r);
}

Interval cosine_slope(const Interval& x, double c) {
  const double r = (x - Interval(c)).mag();
  if (r > kWide) return -sine(Interval::hull(x, c));
  return -sine(scale(0.5, x + Interval(c))) * damping(r);
}

std::optional<Interval> inverse_sine(const Interval& y, const Interval& within) { return inverse_wave(y, within, 1); }
std::optional<Interval> inverse_cosine(const Interval& y, const Interval& within) { return inverse_wave(y, within, 0); }

}  // namespace corank::certify
