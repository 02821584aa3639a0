#include "corank/core/interval.h"

#include <ostream>

#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Quotient for a denominator that does not hold 0; requires den.lo() > 0. (−lo, hi) of the result are upward quotients.
Interval divide_by_positive(const Interval& num, const Interval& den) {
  const double dl = den.lo(), dh = den.hi();
  const double nh = num.hi(), nn = num.neg_lo();
  const double hi = nh >= 0 ? (dl == 0 && nh == 0 ? 0.0 : nh / dl) : nh / dh;
  const double neg_lo = nn >= 0 ? nn / dl : nn / dh;
  return Interval::from_register(_mm_set_pd(std::isnan(hi) ? kInf : hi, std::isnan(neg_lo) ? kInf : neg_lo));
}

// Largest double that is certainly ≤ √x, for x ≥ 0, under upward rounding.
double sqrt_down(double x) {
  const double s = std::sqrt(x);
  if (!std::isfinite(s)) return std::numeric_limits<double>::max();
  if (s * s == x && -((-s) * s) == x) return s;  // both directed products equal x: s is exact
  return std::max(0.0, std::nextafter(s, -kInf));
}

// Bounds of the p-th root of x ≥ 0: an estimate, moved until interval powers prove it.
double root_up(double x, int p) {
  if (x == 0 || !std::isfinite(x)) return x;
  double r = std::pow(x, 1.0 / p);
  while (power(Interval(r), p).lo() < x) r = std::nextafter(r, kInf);
  return r;
}
double root_down(double x, int p) {
  if (x == 0) return 0;
  if (!std::isfinite(x)) return 0;
  double r = std::pow(x, 1.0 / p);
  while (r > 0 && power(Interval(r), p).hi() > x) r = std::nextafter(r, 0.0);
  return r;
}

std::optional<Interval> common(Interval x, const Interval& y) { return x.intersect(y) ? std::optional(x) : std::nullopt; }

// The hull of what is there of two branches.
std::optional<Interval> hull_of(const std::optional<Interval>& positive, const std::optional<Interval>& negative) {
  return positive && negative ? Interval::hull(*positive, *negative) : positive ? positive : negative;
}

}  // namespace

Interval power(const Interval& x, int p) {
  CORANK_CHECK(p >= 0);
  if (p == 0) return 1.0;
  if (p == 1) return x;
  if (p == 2) return square(x);
  // Repeated squaring of the magnitudes; every factor is nonnegative, so −((−a)·b) bounds a·b from below.
  const auto up = [p](double base) {
    double result = 1;
    for (int e = p;; base = base * base) {
      if (e & 1) result = result * base;
      if ((e >>= 1) == 0) return result;
    }
  };
  const auto down = [p](double base) {
    double result = 1;
    for (int e = p;; base = -((-base) * base)) {
      if (e & 1) result = -((-result) * base);
      if ((e >>= 1) == 0) return result;
    }
  };
  if (p % 2 == 0) return {down(x.mig()), up(x.mag())};
  const auto odd_up = [&](double a) { return a >= 0 ? up(a) : -down(-a); };
  const auto odd_down = [&](double a) { return a >= 0 ? down(a) : -up(-a); };
  return {odd_down(x.lo()), odd_up(x.hi())};
}

std::optional<Interval> square_root(const Interval& x) {
  if (x.hi() < 0) return std::nullopt;
  return Interval(x.lo() > 0 ? sqrt_down(x.lo()) : 0.0, std::sqrt(x.hi()));
}

std::optional<Interval> root(const Interval& x, int p, const Interval& within) {
  CORANK_CHECK(p >= 1);
  if (p == 1) return common(within, x);
  if (p % 2 == 1) {
    const auto odd_up = [p](double a) { return a >= 0 ? root_up(a, p) : -root_down(-a, p); };
    const auto odd_down = [p](double a) { return a >= 0 ? root_down(a, p) : -root_up(-a, p); };
    const double lo = std::isfinite(x.lo()) ? odd_down(x.lo()) : x.lo();
    const double hi = std::isfinite(x.hi()) ? odd_up(x.hi()) : x.hi();
    return common(within, Interval(lo, hi));
  }
  if (x.hi() < 0) return std::nullopt;
  const double large = p == 2 ? std::sqrt(x.hi()) : root_up(x.hi(), p);
  const double small = x.lo() <= 0 ? 0.0 : p == 2 ? sqrt_down(x.lo()) : root_down(x.lo(), p);
  // ±[small, large] ∩ within: the hull of what is left of the two branches.
  return hull_of(common(within, Interval(small, large)), common(within, Interval(-large, -small)));
}

std::optional<Interval> divide(const Interval& num, const Interval& den, const Interval& within) {
  if (den.lo() > 0) return common(within, divide_by_positive(num, den));
  if (den.hi() < 0) return common(within, divide_by_positive(-num, -den));
  if (num.contains_zero()) return within;  // 0·x = 0 holds for every x
  if (num.hi() < 0) return divide(-num, -den, within);
  // num > 0, den = [dl, dh] ∋ 0: x ≥ num.lo/dh or x ≤ num.lo/dl.
  const double dl = den.lo(), dh = den.hi(), nl = num.lo();
  return hull_of(dh > 0 ? common(within, Interval(-((-nl) / dh), kInf)) : std::nullopt,
                 dl < 0 ? common(within, Interval(-kInf, nl / dl)) : std::nullopt);
}

std::ostream& operator<<(std::ostream& out, const Interval& x) {
  const auto precision = out.precision(17);
  out << '[' << x.lo() << ", " << x.hi() << ']';
  out.precision(precision);
  return out;
}

}  // namespace corank
