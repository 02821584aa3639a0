// Sines and cosines of intervals, their slopes and inverse images, against MPFR at high precision.
#include "corank/certify/trigonometric.h"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "corank/core/rounding.h"
#include "corank/tests/seeds.h"

namespace corank::certify {
namespace {

constexpr double kPi = std::numbers::pi, kSubnormal = std::numeric_limits<double>::denorm_min();
constexpr std::uint64_t kAngleSeed = 20261122;

// A real number to enough bits for 1 − cos of any subnormal double, where that matters, and for the sine of any other
// double.
class LongReal {
 public:
  explicit LongReal(double x) : LongReal(mpfr_prec_t{x != 0 && std::fabs(x) < 0x1p-300 ? 4800 : 1400}) {
    mpfr_set_d(value_, x, MPFR_RNDN);
  }
  LongReal(const LongReal& other) : LongReal(mpfr_get_prec(other.value_)) { mpfr_set(value_, other.value_, MPFR_RNDN); }
  LongReal& operator=(const LongReal&) = delete;
  ~LongReal() { mpfr_clear(value_); }
  friend LongReal sin(const LongReal& x) {
    LongReal r(mpfr_get_prec(x.value_));
    mpfr_sin(r.value_, x.value_, MPFR_RNDN);
    return r;
  }
  friend LongReal cos(const LongReal& x) {
    LongReal r(mpfr_get_prec(x.value_));
    mpfr_cos(r.value_, x.value_, MPFR_RNDN);
    return r;
  }
  friend LongReal operator-(const LongReal& a, const LongReal& b) {
    LongReal r(std::max(mpfr_get_prec(a.value_), mpfr_get_prec(b.value_)));
    mpfr_sub(r.value_, a.value_, b.value_, MPFR_RNDN);
    return r;
  }
  friend LongReal operator/(const LongReal& a, const LongReal& b) {
    LongReal r(std::max(mpfr_get_prec(a.value_), mpfr_get_prec(b.value_)));
    mpfr_div(r.value_, a.value_, b.value_, MPFR_RNDN);
    return r;
  }
  double nearest() const { return mpfr_get_d(value_, MPFR_RNDN); }
  double down() const { return mpfr_get_d(value_, MPFR_RNDD); }
  double up() const { return mpfr_get_d(value_, MPFR_RNDU); }
  bool in(const Interval& x) const { return mpfr_cmp_d(value_, x.lo()) >= 0 && mpfr_cmp_d(value_, x.hi()) <= 0; }

 private:
  explicit LongReal(mpfr_prec_t bits) { mpfr_init2(value_, bits); }
  mpfr_t value_;
};

// The double next to kπ/2: the cosine or the sine is tiny there.
double near_quarter(int k) {
  mpfr_t x;
  mpfr_init2(x, 200);
  mpfr_const_pi(x, MPFR_RNDN);
  mpfr_mul_si(x, x, k, MPFR_RNDN);
  const double result = mpfr_get_d(x, MPFR_RNDN) / 2;
  mpfr_clear(x);
  return result;
}

// Arguments as they come, and those that are hard: next to multiples of π/2, subnormal, at the end of the range, beyond it.
class Arguments {
 public:
  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  double next() {
    const double sign = engine_() % 2 == 0 ? 1 : -1;
    switch (engine_() % 8) {
      case 0: return sign * near_quarter(static_cast<int>(engine_() % 40));
      case 1: return std::nextafter(near_quarter(static_cast<int>(engine_() % 80'000'000)), sign * HUGE_VAL);
      case 2: return sign * static_cast<double>(engine_() % 5) * kSubnormal;
      case 3: return sign * std::ldexp(uniform(1, 2), -static_cast<int>(engine_() % 1074));
      case 4: return sign * uniform(0, kMaxArgument);
      case 5: {
        const std::uint64_t bits = engine_();
        double x;
        std::memcpy(&x, &bits, sizeof x);
        return std::isfinite(x) ? x : kMaxArgument;
      }
      default: return uniform(-20, 20);
    }
  }
  Interval interval() {
    const double a = next();
    double b = a;
    switch (engine_() % 4) {
      case 0: b = std::nextafter(a, engine_() % 2 == 0 ? HUGE_VAL : -HUGE_VAL); break;
      case 1: b = a + uniform(-8, 8); break;
      case 2: b = a + std::ldexp(uniform(-2, 2), -static_cast<int>(engine_() % 60)); break;
      default: b = next();
    }
    return std::isfinite(b) ? Interval(std::min(a, b), std::max(a, b)) : Interval(a);
  }
  double in(const Interval& x) {
    switch (engine_() % 5) {
      case 0: return x.lo();
      case 1: return x.hi();
      case 2: {  // next to an extreme or a zero
        const double k = std::ceil(x.lo() / (kPi / 2));
        return std::fabs(k) < 1e8 ? std::clamp(near_quarter(static_cast<int>(k)), x.lo(), x.hi()) : x.mid();
      }
      default: return std::clamp(uniform(0, 1) * (x.hi() / 2 - x.lo() / 2) * 2 + x.lo(), x.lo(), x.hi());
    }
  }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_{kAngleSeed};
};

class Trigonometric : public testing::Test {
 protected:
  static int trials(int usual) { return test::long_run() ? 10'000 : usual; }

  UpwardRounding rounding_;
  Arguments arguments_;
};

TEST_F(Trigonometric, SinesAndCosinesContainTheExactValues) {
  for (int trial = 0; trial < trials(1'500); ++trial) {
    const Interval x = arguments_.interval(), s = sine(x), c = cosine(x);
    ASSERT_TRUE(Interval(-1, 1).contains(s) && Interval(-1, 1).contains(c)) << x;
    for (const double a : {x.lo(), x.hi(), arguments_.in(x), arguments_.in(x)}) {
      ASSERT_TRUE(sin(LongReal(a)).in(s)) << "sin of " << a << " in " << x << " is not in " << s;
      ASSERT_TRUE(cos(LongReal(a)).in(c)) << "cos of " << a << " in " << x << " is not in " << c;
    }
  }
}

TEST_F(Trigonometric, TheValueAtAPointIsGoodToAFewUnitsInTheLastPlace) {
  for (int trial = 0; trial < trials(4'000); ++trial) {
    const double x = arguments_.next();
    if (std::fabs(x) > kMaxArgument) continue;
    for (const auto& [enclosure, exact] : {std::pair{sine(x), sin(LongReal(x))}, std::pair{cosine(x), cos(LongReal(x))}}) {
      const double unit = std::nextafter(std::fabs(exact.nearest()), 2) - std::fabs(exact.nearest());
      ASSERT_LE(enclosure.width(), 8 * unit) << x;
    }
  }
  EXPECT_EQ(sine(0), Interval(0));
  EXPECT_EQ(cosine(0), Interval(1));
}

TEST_F(Trigonometric, AnIntervalReachesItsExtremesAndNoMore) {
  EXPECT_EQ(cosine({-0.1, 0.2}).hi(), 1);
  EXPECT_NEAR(cosine({-0.1, 0.2}).lo(), std::cos(0.2), 1e-15);
  EXPECT_EQ(cosine({3, 3.5}).lo(), -1);
  EXPECT_NEAR(cosine({3, 3.5}).hi(), std::cos(3.5), 1e-15);
  EXPECT_EQ(cosine({3, 7}), Interval(-1, 1));
  EXPECT_EQ(sine({1, 2}).hi(), 1);
  EXPECT_EQ(sine({-2, -1}).lo(), -1);
  EXPECT_EQ(sine({1, 5}), Interval(-1, 1));
  EXPECT_LT(sine({2, 4}).hi(), 0.91);
  EXPECT_GT(sine({2, 4}).lo(), -0.76);
  EXPECT_LT(cosine({0.01, 6.27}).hi(), 1);
  EXPECT_EQ(cosine({0, 6.4}), Interval(-1, 1));
  EXPECT_EQ(sine({1e6, 1e6 + 7}), Interval(-1, 1));
  EXPECT_EQ(sine(Interval::whole()), Interval(-1, 1));
  EXPECT_EQ(cosine({1e300, HUGE_VAL}), Interval(-1, 1));
}

TEST_F(Trigonometric, SlopesContainEveryQuotientOfDifferences) {
  for (int trial = 0; trial < trials(4'000); ++trial) {
    const Interval x = arguments_.interval();
    const double a = arguments_.in(x);
    const double c = trial % 3 == 0 ? a : trial % 3 == 1 ? x.mid() : a + arguments_.uniform(-3, 3);
    const Interval s = sine_slope(x, c), t = cosine_slope(x, c);
    const LongReal ra(a), rc(c);
    const LongReal sine_quotient = a == c ? cos(ra) : (sin(ra) - sin(rc)) / (ra - rc);
    const LongReal cosine_quotient = a == c ? LongReal(0.0) - sin(ra) : (cos(ra) - cos(rc)) / (ra - rc);
    ASSERT_TRUE(sine_quotient.in(s)) << x << " at " << a << " about " << c << ": " << s;
    ASSERT_TRUE(cosine_quotient.in(t)) << x << " at " << a << " about " << c << ": " << t;
  }
}

TEST_F(Trigonometric, SlopesAreHalfAsWideAsDerivatives) {
  const Interval x(0.3, 0.302);
  EXPECT_LT(sine_slope(x, x.mid()).width(), 0.51 * cosine(x).width());
  EXPECT_LT(cosine_slope(x, x.mid()).width(), 0.51 * sine(x).width());
}

TEST_F(Trigonometric, InverseImagesKeepEveryPoint) {
  for (int trial = 0; trial < trials(4'000); ++trial) {
    const Interval within = arguments_.interval();
    const double a = arguments_.in(within);
    const LongReal s = sin(LongReal(a)), c = cos(LongReal(a));
    const double slack = trial % 2 == 0 ? 0 : std::ldexp(1.0, -static_cast<int>(arguments_.engine()() % 60));
    const auto sines = inverse_sine({s.down() - slack, s.up() + slack}, within);
    ASSERT_TRUE(sines && sines->contains(a) && within.contains(*sines)) << a << " in " << within;
    const auto cosines = inverse_cosine({c.down() - slack, c.up() + slack}, within);
    ASSERT_TRUE(cosines && cosines->contains(a) && within.contains(*cosines)) << a << " in " << within;
  }
}

void expect_near(const std::optional<Interval>& x, double lo, double hi) {
  ASSERT_TRUE(x);
  EXPECT_NEAR(x->lo(), lo, 1e-12);
  EXPECT_NEAR(x->hi(), hi, 1e-12);
}

TEST_F(Trigonometric, InverseImagesAreTheHullOfTheBranchesInside) {
  expect_near(inverse_cosine({0.5, 1}, {0, 3}), 0, kPi / 3);
  expect_near(inverse_cosine({0.5, 1}, {-3, 3}), -kPi / 3, kPi / 3);
  expect_near(inverse_cosine({0.5, 1}, {1.5, 10}), 2 * kPi - kPi / 3, 2 * kPi + kPi / 3);
  expect_near(inverse_cosine({-1, -0.5}, {-3, 3}), -3, 3);
  expect_near(inverse_cosine({0, 0}, {1, 9}), kPi / 2, 5 * kPi / 2);
  expect_near(inverse_cosine({0, 0}, {2, 4.8}), 3 * kPi / 2, 3 * kPi / 2);
  expect_near(inverse_cosine({1, 1}, {-1, 20}), 0, 6 * kPi);
  expect_near(inverse_cosine({-7, -1}, {-4, 20}), -kPi, 5 * kPi);
  expect_near(inverse_sine({0, 0}, {0.5, 4}), kPi, kPi);
  expect_near(inverse_sine({0.5, 7}, {-1, 2}), kPi / 6, 2);
  expect_near(inverse_sine({-0.5, 0.5}, {2, 20}), 5 * kPi / 6, 6 * kPi + kPi / 6);
  expect_near(inverse_sine({1, 1}, {1000, 1010}), 318 * kPi + kPi / 2, 320 * kPi + kPi / 2);
}

TEST_F(Trigonometric, InverseImagesAreEmptyWhereNoBranchComesNear) {
  EXPECT_FALSE(inverse_cosine({1.0001, 2}, {-10, 10}));
  EXPECT_FALSE(inverse_sine({-3, -1.0001}, {-10, 10}));
  EXPECT_FALSE(inverse_cosine({0.9, 1}, {1, 5}));
  EXPECT_FALSE(inverse_cosine({-0.1, 0.1}, {2, 4}));
  EXPECT_FALSE(inverse_sine({0, 0}, {0.1, 3.1}));
  EXPECT_FALSE(inverse_sine({-1, 0.5}, {-5e4, -5e4 + 1}));
}

TEST_F(Trigonometric, BeyondTheLargestArgumentNothingIsLost) {
  const Interval far(1e9, 1e9 + 1);
  EXPECT_EQ(sine(far), Interval(-1, 1));
  EXPECT_EQ(*inverse_sine({0.3, 0.4}, far), far);
  EXPECT_EQ(*inverse_cosine({0.3, 0.4}, Interval::whole()), Interval::whole());
}

}  // namespace
}  // namespace corank::certify
