#include "corank/check/enclosure.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>

#include "corank/core/check.h"

namespace corank::check {

Enclosure::Enclosure(double lo, double hi) {
  CORANK_CHECK(lo <= hi);
  mpfi_interv_d(x_, lo, hi);
}

Enclosure::Enclosure(const ExactNumber& x) {
  const auto [lower, upper] = x.bounds(kBits + 16);
  CORANK_CHECK(lower.is_rational() && upper.is_rational());
  mpq_class from(lower.text(), 10), to(upper.text(), 10);
  mpfi_interv_q(x_, from.get_mpq_t(), to.get_mpq_t());
}

Enclosure Enclosure::pi() {
  Enclosure x;
  mpfi_const_pi(x.x_);
  return x;
}

void Enclosure::add_product(const Enclosure& a, const Enclosure& x) {
  thread_local Enclosure product;
  mpfi_mul(product.x_, a.x_, x.x_);
  mpfi_add(x_, x_, product.x_);
}

void Enclosure::add_product(double a, const Enclosure& x) {
  thread_local Enclosure product;
  mpfi_mul_d(product.x_, x.x_, a);
  mpfi_add(x_, x_, product.x_);
}

double Enclosure::mid() const {
  // Halves first: the sum of two large doubles may overflow.
  const double m = 0.5 * mpfr_get_d(x_.lower(), MPFR_RNDN) + 0.5 * mpfr_get_d(x_.upper(), MPFR_RNDN);
  return std::isfinite(m) ? m : 0;
}

double Enclosure::mag() const { return std::max(std::fabs(lo()), std::fabs(hi())); }
double Enclosure::mig() const { return has_zero() ? 0 : std::min(std::fabs(lo()), std::fabs(hi())); }

bool Enclosure::strictly_inside(const Enclosure& x) const {
  return mpfr_less_p(x.x_.lower(), x_.lower()) != 0 && mpfr_less_p(x_.upper(), x.x_.upper()) != 0;
}
bool Enclosure::inside(const Interval& x) const {
  return mpfr_cmp_d(x_.lower(), x.lo()) >= 0 && mpfr_cmp_d(x_.upper(), x.hi()) <= 0;
}
bool Enclosure::overlaps(const Enclosure& x) const {
  return mpfr_lessequal_p(x_.lower(), x.x_.upper()) != 0 && mpfr_lessequal_p(x.x_.lower(), x_.upper()) != 0;
}
bool Enclosure::overlaps(const Interval& x) const {
  return mpfr_cmp_d(x_.lower(), x.hi()) <= 0 && mpfr_cmp_d(x_.upper(), x.lo()) >= 0;
}

bool Enclosure::intersect(const Enclosure& x) {
  if (!overlaps(x)) return false;
  mpfi_intersect(x_, x_, x.x_);
  return true;
}

Enclosure Enclosure::lower_end() const {
  Enclosure end;
  mpfi_set_fr(end.x_, x_.lower());
  return end;
}
Enclosure Enclosure::upper_end() const {
  Enclosure end;
  mpfi_set_fr(end.x_, x_.upper());
  return end;
}

Enclosure power(const Enclosure& x, int p) {
  CORANK_CHECK(p >= 0);
  if (p == 1) return x;
  if (p == 2) return Enclosure::made(mpfi_sqr, x);
  // Of an even power the range is that of the square's power, of an odd one that of the ends: monotone.
  if (p % 2 == 0) {
    const Enclosure square = power(x, 2);
    Enclosure product(1.0);
    for (int k = 0; k < p / 2; ++k) product *= square;
    return product;
  }
  const auto at = [p](const Enclosure& end) {
    Enclosure product(1.0);
    for (int k = 0; k < p; ++k) product *= end;
    return product;
  };
  return Enclosure::hull(at(x.lower_end()), at(x.upper_end()));
}

namespace {

// Beyond this a sine needs very many digits of pi; [−1, 1] is true as well.
constexpr double kLargestArgument = 1e15;

std::optional<Enclosure> common(Enclosure x, const Enclosure& y) { return x.intersect(y) ? std::optional(x) : std::nullopt; }

// The hull of what is there of two branches.
std::optional<Enclosure> hull_of(const std::optional<Enclosure>& a, const std::optional<Enclosure>& b) {
  return a && b ? Enclosure::hull(*a, *b) : a ? a : b;
}

}  // namespace

Enclosure sine(const Enclosure& x) {
  if (!(x.mag() <= kLargestArgument)) return {-1, 1};
  return Enclosure::made(mpfi_sin, x);
}
Enclosure cosine(const Enclosure& x) {
  if (!(x.mag() <= kLargestArgument)) return {-1, 1};
  return Enclosure::made(mpfi_cos, x);
}

Enclosure quotient(const Enclosure& x, const Enclosure& y) {
  CORANK_CHECK(!y.has_zero());
  return Enclosure::made(mpfi_div, x, y);
}

Enclosure square_root(const Enclosure& x) {
  CORANK_CHECK(x.may_be_nonnegative());
  Enclosure part = x;
  part.intersect(Enclosure(0, kInfinity));
  return Enclosure::made(mpfi_sqrt, part);
}

Enclosure arc_cosine(const Enclosure& x) {
  CORANK_CHECK(x.inside(Enclosure(-1, 1)));
  return Enclosure::made(mpfi_acos, x);
}

std::optional<Enclosure> divide(const Enclosure& num, const Enclosure& den, const Enclosure& within) {
  if (!den.has_zero()) return common(within, quotient(num, den));
  if (num.has_zero()) return within;  // 0·x = 0 holds for every x
  if (num.is_negative()) return divide(-num, -den, within);
  // num > 0, den ∋ 0: x ≥ num.lower/den.upper or x ≤ num.lower/den.lower.
  const Enclosure least = num.lower_end(), from = den.lower_end(), to = den.upper_end();
  std::optional<Enclosure> positive, negative;
  if (to.is_positive()) positive = common(within, Enclosure::hull(quotient(least, to), Enclosure(kInfinity)));
  if (from.is_negative()) negative = common(within, Enclosure::hull(quotient(least, from), Enclosure(-kInfinity)));
  return hull_of(positive, negative);
}

std::optional<Enclosure> root(const Enclosure& y, int p, const Enclosure& within) {
  CORANK_CHECK(p >= 1);
  if (p == 1) return common(within, y);
  if (p != 2) return within;  // rare: no information
  if (!y.may_be_nonnegative()) return std::nullopt;
  const Enclosure size = square_root(y);
  return hull_of(common(within, size), common(within, -size));
}

std::optional<Enclosure> inverse_cosine(const Enclosure& y, const Enclosure& within) {
  constexpr double kMostTurns = 32;
  Enclosure cosines(-1, 1);
  if (!cosines.intersect(y)) return std::nullopt;
  const double turn = 6.28;  // a little less: more branches than needed
  if (!(within.mag() <= kMostTurns * turn)) return within;
  const Enclosure arc = arc_cosine(cosines), two_pi = Enclosure(2.0) * Enclosure::pi();
  std::optional<Enclosure> hull;
  for (double k = std::floor(within.lo() / turn) - 1; k <= std::ceil(within.hi() / turn) + 1; ++k)
    for (const Enclosure& branch : {two_pi * Enclosure(k) - arc, two_pi * Enclosure(k) + arc}) {
      hull = hull_of(hull, common(within, branch));
    }
  return hull;
}

std::optional<Enclosure> inverse_sine(const Enclosure& y, const Enclosure& within) {
  const Enclosure quarter = Enclosure(0.5) * Enclosure::pi();  // sin x = cos(x − π/2)
  const auto shifted = inverse_cosine(y, within - quarter);
  return shifted ? common(within, *shifted + quarter) : std::nullopt;
}

}  // namespace corank::check
