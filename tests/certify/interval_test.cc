// Containment of every interval operation, against MPFR at a precision where sums and products of doubles are exact.
#include "corank/core/interval.h"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <cstring>
#include <random>
#include <vector>

#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kMax = std::numeric_limits<double>::max();
constexpr double kTiny = std::numeric_limits<double>::denorm_min();
constexpr int kSamples = 200000;
constexpr std::uint64_t kIntervalSeed = 20261121;

// An exact real number: every double, and sums and products of a few, fit in these bits.
class Real {
 public:
  Real() { mpfr_init2(value_, 16384); }
  explicit Real(double x) : Real() { mpfr_set_d(value_, x, MPFR_RNDN); }
  Real(const Real& other) : Real() { mpfr_set(value_, other.value_, MPFR_RNDN); }
  Real& operator=(const Real&) = delete;
  ~Real() { mpfr_clear(value_); }
  friend Real operator+(const Real& a, const Real& b) {
    Real r;
    EXPECT_EQ(mpfr_add(r.value_, a.value_, b.value_, MPFR_RNDN), 0) << "the oracle must be exact";
    return r;
  }
  friend Real operator*(const Real& a, const Real& b) {
    Real r;
    EXPECT_EQ(mpfr_mul(r.value_, a.value_, b.value_, MPFR_RNDN), 0) << "the oracle must be exact";
    return r;
  }
  double down() const { return mpfr_get_d(value_, MPFR_RNDD); }
  double up() const { return mpfr_get_d(value_, MPFR_RNDU); }
  bool in(const Interval& x) const { return mpfr_cmp_d(value_, x.lo()) >= 0 && mpfr_cmp_d(value_, x.hi()) <= 0; }

 private:
  mpfr_t value_;
};

// Doubles by bit pattern: subnormal, huge and tiny ones as likely as any, small integers mixed in; never NaN or infinite.
class Doubles {
 public:
  double next() {
    switch (engine_() % 8) {
      case 0: return special();
      case 1: return static_cast<double>(static_cast<int>(engine_() % 9)) - 4;
      case 2: return static_cast<double>(engine_() % 2001) / 1000.0 - 1;
      default: {
        const std::uint64_t bits = engine_();
        double x;
        std::memcpy(&x, &bits, sizeof x);
        return std::isfinite(x) ? x : special();
      }
    }
  }
  Interval interval() {
    const double a = next(), b = engine_() % 4 == 0 ? std::nextafter(a, kMax) : next();
    return std::isfinite(b) ? Interval(std::min(a, b), std::max(a, b)) : Interval(a);
  }
  double in(const Interval& x) {
    switch (engine_() % 3) {
      case 0: return x.lo();
      case 1: return x.hi();
      default: return x.mid();
    }
  }
  std::mt19937_64& engine() { return engine_; }

 private:
  double special() {
    constexpr double kSpecial[] = {0.0, -0.0, kTiny, -kTiny, kMax, -kMax, 1.0, -1.0, 2.2250738585072014e-308, 0.1, -0.9};
    return kSpecial[engine_() % std::size(kSpecial)];
  }
  std::mt19937_64 engine_{kIntervalSeed};
};

class IntervalTest : public testing::Test {
 protected:
  UpwardRounding rounding_;
  Doubles doubles_;
};

TEST_F(IntervalTest, SumsAndDifferencesContainTheExactValue) {
  for (int k = 0; k < kSamples; ++k) {
    const Interval x = doubles_.interval(), y = doubles_.interval();
    const double a = doubles_.in(x), b = doubles_.in(y);
    ASSERT_TRUE((Real(a) + Real(b)).in(x + y)) << x << " + " << y;
    ASSERT_TRUE((Real(a) + Real(-b)).in(x - y)) << x << " - " << y;
  }
}

TEST_F(IntervalTest, ProductsContainTheExactValue) {
  for (int k = 0; k < kSamples; ++k) {
    const Interval x = doubles_.interval(), y = doubles_.interval();
    const double a = doubles_.in(x), b = doubles_.in(y);
    ASSERT_TRUE((Real(a) * Real(b)).in(x * y)) << x << " * " << y;
    ASSERT_TRUE((Real(a) * Real(b)).in(scale(a, y))) << a << " * " << y;
    ASSERT_TRUE((Real(a) * Real(a)).in(square(x))) << x << "^2";
  }
}

TEST_F(IntervalTest, ProductsAreTight) {
  for (int k = 0; k < kSamples; ++k) {
    const double a = doubles_.next(), b = doubles_.next();
    const Real exact = Real(a) * Real(b);
    const Interval product = Interval(a) * Interval(b);
    ASSERT_EQ(product.lo(), exact.down());
    ASSERT_EQ(product.hi(), exact.up());
  }
}

TEST_F(IntervalTest, ProductsOfUnboundedIntervalsEncloseAndAreNeverNaN) {
  const std::vector<double> ends{-kInf, -2, -1, 0, 1, 3, kInf};
  std::vector<Interval> all;
  for (double lo : ends)
    for (double hi : ends)
      if (lo <= hi && lo < kInf && hi > -kInf) all.emplace_back(lo, hi);
  for (const Interval& x : all)
    for (const Interval& y : all) {
      const Interval product = x * y;
      ASSERT_LE(product.lo(), product.hi()) << x << " * " << y;
      for (double a : {-1e9, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 3.0, 1e9})
        for (double b : {-1e9, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 3.0, 1e9}) {
          if (!x.contains(a) || !y.contains(b)) continue;
          ASSERT_TRUE(product.contains(a * b)) << x << " * " << y << " at " << a << ", " << b;
          ASSERT_TRUE(scale(a, y).contains(a * b)) << a << " * " << y;
        }
    }
  EXPECT_EQ(Interval(0, kInf) * Interval(-1), Interval(-kInf, 0));
  EXPECT_EQ(Interval(1, kInf) * Interval(2, 3), Interval(2, kInf));
}

TEST_F(IntervalTest, PowersContainTheExactValue) {
  for (int k = 0; k < kSamples / 10; ++k) {
    const Interval x = doubles_.interval();
    const double a = doubles_.in(x);
    if (std::fabs(a) > 1e100 || (a != 0 && std::fabs(a) < 1e-100)) continue;  // keep the oracle exact
    std::vector<Real> powers{Real(1.0)};
    for (int p = 0; p <= 7; ++p) {
      ASSERT_TRUE(powers.back().in(power(x, p))) << x << "^" << p;
      powers.push_back(powers.back() * Real(a));
    }
  }
}

TEST_F(IntervalTest, DivisionKeepsEveryQuotient) {
  for (int k = 0; k < kSamples; ++k) {
    const Interval den = doubles_.interval(), within = doubles_.interval();
    const double d = doubles_.in(den), x = doubles_.in(within);
    const Real n = Real(d) * Real(x);  // d·x = n, so x must survive for any numerator that holds n
    const Interval num(n.down(), n.up());
    const auto quotient = divide(num, den, within);
    ASSERT_TRUE(quotient && quotient->contains(x)) << num << " / " << den << " within " << within << " lost " << x;
  }
}

TEST_F(IntervalTest, DivisionFindsTheGapOfAnExtendedQuotient) {
  const auto positive = divide(Interval(1, 2), Interval(-1, 1), Interval(0, 10));
  ASSERT_TRUE(positive);
  EXPECT_EQ(*positive, Interval(1, 10));
  EXPECT_FALSE(divide(Interval(1, 2), Interval(-1, 1), Interval(-0.5, 0.5)));
  EXPECT_FALSE(divide(Interval(1, 2), Interval(0, 0), Interval(-5, 5)));
  EXPECT_EQ(*divide(Interval(-1, 2), Interval(-1, 1), Interval(-5, 5)), Interval(-5, 5));
}

TEST_F(IntervalTest, RootsKeepEveryRoot) {
  for (int k = 0; k < kSamples / 10; ++k) {
    const Interval within = doubles_.interval();
    const double x = doubles_.in(within);
    for (int p = 2; p <= 5; ++p) {
      const auto kept = root(power(Interval(x), p), p, within);
      ASSERT_TRUE(kept && kept->contains(x)) << "root " << p << " lost " << x << " within " << within;
    }
    if (x >= 0) {
      const auto s = square_root(square(Interval(x)));
      ASSERT_TRUE(s && s->contains(x));
    }
  }
}

TEST_F(IntervalTest, SquareRootOfAPerfectSquareIsAPoint) {
  EXPECT_EQ(*square_root(Interval(1)), Interval(1));
  EXPECT_EQ(*root(Interval(9), 2, Interval(0, 10)), Interval(3));
  EXPECT_EQ(*root(Interval(9), 2, Interval(-10, 10)), Interval(-3, 3));
  EXPECT_FALSE(root(Interval(9), 2, Interval(-2, 2)));
  EXPECT_FALSE(square_root(Interval(-2, -1)));
}

TEST_F(IntervalTest, IntersectionLeavesTheIntervalAloneWhereItIsEmpty) {
  Interval x(0, 1);
  EXPECT_FALSE(x.intersect(Interval(2, 3)));
  EXPECT_EQ(x, Interval(0, 1));
  EXPECT_TRUE(x.intersect(Interval(1, 3)));
  EXPECT_EQ(x, Interval(1));
}

TEST_F(IntervalTest, TheInteriorHoldsNeitherEnd) {
  const Interval x(0, 1);
  EXPECT_TRUE(x.strictly_contains(Interval(0.25, 0.75)));
  EXPECT_FALSE(x.strictly_contains(Interval(0, 0.75)));
  EXPECT_FALSE(x.strictly_contains(Interval(0.25, 1)));
}

TEST_F(IntervalTest, TheMiddleLiesInside) {
  for (int k = 0; k < kSamples; ++k) {
    const Interval x = doubles_.interval();
    ASSERT_TRUE(x.contains(x.mid())) << x;
  }
}

TEST(UpwardRounding, IsRestoredAtTheEndOfTheScope) {
  ASSERT_EQ(std::fegetround(), FE_TONEAREST);
  {
    const UpwardRounding guard;
    EXPECT_TRUE(UpwardRounding::active());
  }
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

}  // namespace
}  // namespace corank::certify
