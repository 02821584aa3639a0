// Oracles: GMP rationals for rational numbers, MPFI at 700 bits for the others.
#include "corank/core/exact_number.h"
#include "corank/core/exact_number_node.h"

#include <gmpxx.h>
#include <gtest/gtest.h>
#include <mpfi.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <limits>
#include <random>

#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

constexpr unsigned kRationalSeed = 20170517;
constexpr std::array kModes = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

class Mode {
 public:
  explicit Mode(int mode) : former_(std::fegetround()) { std::fesetround(mode); }
  ~Mode() { std::fesetround(former_); }

 private:
  int former_;
};

ExactNumber apply(ConstantFunction f, const ExactNumber& x) { return ExactNumber::apply(f, x); }
ExactNumber root(const ExactNumber& x) { return apply(ConstantFunction::sqrt, x); }

mpq_class random_rational(std::mt19937_64& random) {
  const auto integer = [&] { return mpz_class((mpz_class(random()) * mpz_class(random())) >> (random() % 120)); };
  mpq_class q(integer(), integer() + 1);
  q.canonicalize();
  return random() % 2 ? q : mpq_class(-q);
}

TEST(ExactNumber, EnclosesARationalByTheNarrowestInterval) {
  for (const int mode : kModes) {
    std::mt19937_64 random(kRationalSeed);
    for (int i = 0; i < 2000; ++i) {
      const mpq_class q = random_rational(random);
      const Mode scope(mode);
      const Interval x = ExactNumber::rational(q.get_str()).enclose();
      ASSERT_TRUE(mpq_class(x.lo()) <= q) << q.get_str();
      ASSERT_TRUE(mpq_class(x.hi()) >= q) << q.get_str();
      const bool is_double = mpq_class(x.lo()) == q;
      ASSERT_EQ(x.hi(), is_double ? x.lo() : std::nextafter(x.lo(), INFINITY)) << q.get_str();
    }
  }
}

TEST(ExactNumber, EnclosesRationalsAtTheEndsOfTheRangeOfDoubles) {
  constexpr double kTiny = std::numeric_limits<double>::denorm_min(), kMax = std::numeric_limits<double>::max();
  EXPECT_EQ(ExactNumber::rational("1e-400").enclose(), Interval(0, kTiny));
  EXPECT_EQ(ExactNumber::rational("-1e-400").enclose(), Interval(-kTiny, 0));
  EXPECT_EQ(ExactNumber::rational("1e400").enclose(), Interval(kMax, INFINITY));
  EXPECT_EQ(ExactNumber::rational("5e-324").enclose(), Interval(kTiny, 2 * kTiny));
  EXPECT_EQ(ExactNumber::rational("0").enclose(), Interval(0));
  const Interval subnormal = ExactNumber::rational("1e-310").enclose();
  EXPECT_EQ(subnormal.hi(), subnormal.lo() + kTiny);
  EXPECT_TRUE(mpq_class(subnormal.lo()) <= mpq_class("1/1" + std::string(310, '0')));
}

TEST(ExactNumber, ReadsDecimalsExactly) {
  EXPECT_EQ(ExactNumber::rational("0.90").text(), "9/10");
  EXPECT_EQ(ExactNumber::rational("-3/4").text(), "-3/4");
  EXPECT_EQ(ExactNumber::rational("1e-6").text(), "1/1000000");
  EXPECT_EQ(ExactNumber::rational("2.5E3").text(), "2500");
  EXPECT_EQ(ExactNumber::rational("12").text(), "12");
  EXPECT_EQ(ExactNumber::rational("6/8").text(), "3/4");
  EXPECT_EQ(ExactNumber::rational("-0").text(), "0");
}

TEST(ExactNumber, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"", "-", ".", "abc", "1..2", "1e", "1e+", "0x10", "1/2/3", "1.5/2", "1/-2", "1 ", " 1", "nan", "1,5"})
    EXPECT_THROW(ExactNumber::rational(text), std::invalid_argument) << text;
  EXPECT_THROW(ExactNumber::rational("1/0"), std::domain_error);
}

TEST(ExactNumber, FoldsRationalArithmetic) {
  const ExactNumber x = ExactNumber::rational("0.90"), y = ExactNumber::rational("4/5");
  EXPECT_EQ((x + y).text(), "17/10");
  EXPECT_EQ((x - x), ExactNumber(0));
  EXPECT_TRUE((x - x).is_zero());
  EXPECT_EQ((x * y).text(), "18/25");
  EXPECT_EQ((x / y).text(), "9/8");
  EXPECT_EQ(pow(y, -2).text(), "25/16");
  EXPECT_EQ(pow(ExactNumber(-1), 3).text(), "-1");
  EXPECT_EQ(root(ExactNumber::rational("16/25")).text(), "4/5");
  EXPECT_TRUE((ExactNumber(0) * ExactNumber::pi()).is_zero());
  EXPECT_THROW(x / ExactNumber(0), std::domain_error);
  EXPECT_THROW(pow(ExactNumber(0), -1), std::domain_error);
}

TEST(ExactNumber, FoldsMultiplesOfOneExpression) {
  const ExactNumber third = ExactNumber::rational("1/3"), e = root(3) * ExactNumber::pi();
  EXPECT_EQ((third * e + e).text(), (ExactNumber::rational("4/3") * e).text());
  EXPECT_EQ((1 + root(2) + 2 * root(2)).text(), "1 + 3*sqrt(2)");
  EXPECT_TRUE((3 * e - e - 2 * e).is_zero());
  EXPECT_EQ((root(2) + root(3) - root(2)).text(), "sqrt(3)");
  EXPECT_EQ((5 + root(2) - root(2)), ExactNumber(5));
  EXPECT_FALSE((root(2) - root(3)).is_zero());
  EXPECT_THROW((root(-1) - root(-1)).enclose(), std::domain_error) << "what is no number does not cancel";
  ExactNumber many = 0;  // longer sums stay as they are, and keep their value
  for (int i = 1; i <= 100; ++i) many = many + root(ExactNumber(4 * i * i + 1));
  EXPECT_TRUE((many - many).enclose().contains(0));
}

TEST(ExactNumber, MultipliesOutWhatIsRational) {
  EXPECT_EQ(root(3) * root(3), ExactNumber(3));
  EXPECT_EQ(pow(root(3), 4), ExactNumber(9));
  EXPECT_EQ(pow(root(3), 3).text(), "3*sqrt(3)");
  EXPECT_EQ((root(2) * ExactNumber::pi() * root(2)).text(), "2*pi");
  // Sums of multiples of sums stay flat.
  ExactNumber sum = 1 + root(2);
  for (int k = 0; k < 20; ++k) sum = ExactNumber::dyadic(0.5) * sum + root(3);
  EXPECT_EQ(sum.node().operands.size(), 2u);
}

TEST(ExactNumber, PrintsInTheModelLanguage) {
  const ExactNumber pi = ExactNumber::pi(), two = 2;
  EXPECT_EQ((two * apply(ConstantFunction::cos, pi / 5)).text(), "2*cos(1/5*pi)");
  EXPECT_EQ((1 + root(2)).text(), "1 + sqrt(2)");
  EXPECT_EQ((root(3) - 1).text(), "-1 + sqrt(3)");
  EXPECT_EQ((-(1 + root(2))).text(), "-1 - sqrt(2)");
  EXPECT_EQ((pi - root(2)).text(), "pi - sqrt(2)");
  EXPECT_EQ((two / root(3)).text(), "2/sqrt(3)");
  EXPECT_EQ(pow(pi, -2).text(), "1/pi^2");
  EXPECT_EQ(pow(1 + pi, 3).text(), "(1 + pi)^3");
  EXPECT_EQ((pi / (1 + pi)).text(), "pi/(1 + pi)");
  EXPECT_EQ(pow(1 / pi, 2).text(), "(1/pi)^2");
}

TEST(ExactNumber, GivesADecimalOnlyWhereItIsExact) {
  const auto decimal = [](const char* text) { return ExactNumber::rational(text).decimal().value_or("none"); };
  EXPECT_EQ(decimal("9/10"), "0.9");
  EXPECT_EQ(decimal("-12"), "-12");
  EXPECT_EQ(decimal("1200"), "1200");
  EXPECT_EQ(decimal("-1/8"), "-0.125");
  EXPECT_EQ(decimal("1/1000"), "0.001");
  EXPECT_EQ(decimal("123456789/1000"), "123456.789");
  EXPECT_EQ(decimal("1e30"), "1e30");
  EXPECT_EQ(decimal("0"), "0");
  EXPECT_EQ(decimal("1/3"), "none");
  EXPECT_EQ(decimal("1.23456789012345678"), "none");  // 18 digits
  EXPECT_EQ(decimal("1.2345678901234567"), "1.2345678901234567");
  EXPECT_FALSE(ExactNumber::pi().decimal());
  for (const char* text : {"7/8", "-0.00012", "1e-19", "3e-25", "12345678901234567", "5e200"})
    EXPECT_EQ(ExactNumber::rational(decimal(text)), ExactNumber::rational(text)) << text;
}

TEST(ExactNumber, KnowsSigns) {
  EXPECT_EQ(ExactNumber::rational("-1/3").sign(), -1);
  EXPECT_EQ(ExactNumber(0).sign(), 0);
  EXPECT_EQ((root(2) - ExactNumber::rational("1.4142135623730950488016887242096980785")).sign(), 1);
  EXPECT_EQ((root(2) - ExactNumber::rational("1.4142135623730950488016887242096980786")).sign(), -1);
  // 0, which enclosures can never prove.
  EXPECT_EQ((root(2) * root(3) - root(6)).sign(), std::nullopt);
  EXPECT_EQ(apply(ConstantFunction::sin, ExactNumber::pi()).sign(), std::nullopt);
  // exp(pi·sqrt(163)) is an integer but for 7.5·10^-13.
  const ExactNumber ramanujan = apply(ConstantFunction::exp, ExactNumber::pi() * root(163));
  EXPECT_EQ((ramanujan - ExactNumber::rational("262537412640768744")).sign(), -1);
  EXPECT_THROW(apply(ConstantFunction::log, -1).sign(), std::domain_error);
}

TEST(ExactNumber, EnclosesZeroHiddenInAnExpression) {
  const Interval x = (root(2) * root(3) - root(6)).enclose();
  EXPECT_TRUE(x.contains(0));
  EXPECT_LE(x.hi(), std::numeric_limits<double>::min());
}

TEST(ExactNumber, RefusesWhatIsNoRealNumber) {
  const ExactNumber hidden_zero = root(2) * root(2) - 2;
  EXPECT_THROW(root(-1).enclose(), std::domain_error);
  EXPECT_THROW(apply(ConstantFunction::log, 0).enclose(), std::domain_error);
  EXPECT_THROW(apply(ConstantFunction::log, -2).enclose(), std::domain_error);
  EXPECT_THROW(apply(ConstantFunction::asin, 2).enclose(), std::domain_error);
  EXPECT_THROW(apply(ConstantFunction::acos, ExactNumber::rational("-1.001")).enclose(), std::domain_error);
  EXPECT_THROW(apply(ConstantFunction::tan, ExactNumber::pi() / 2).enclose(), std::domain_error);
  EXPECT_THROW((1 / hidden_zero).enclose(), std::domain_error);
  EXPECT_THROW(root(root(-1) * 2).enclose(), std::domain_error);
}

TEST(ExactNumber, TellsExpressionsApartByTheirExponentsAndFunctions) {
  const ExactNumber pi = ExactNumber::pi(), two = 2;
  EXPECT_FALSE(pow(pi, 2) == pow(pi, 3));
  EXPECT_FALSE((pow(pi, 2) - pow(pi, 3)).is_zero());
  EXPECT_FALSE(apply(ConstantFunction::sin, two) == apply(ConstantFunction::cos, two));
}

TEST(ExactNumber, TakesRootsOfSquaresOfFractionsOnly) {
  EXPECT_FALSE(root(ExactNumber::rational("4/3")).is_rational());
  EXPECT_FALSE(root(ExactNumber::rational("3/4")).is_rational());
  EXPECT_EQ(root(ExactNumber::rational("4/9")), ExactNumber::rational("2/3"));
}

TEST(ExactNumber, BoundsItsValueFromBothSides) {
  const auto [lower, upper] = root(2).bounds(53);
  EXPECT_EQ((lower * lower - 2).sign(), -1);
  EXPECT_EQ((upper * upper - 2).sign(), 1);
}

// √2·√3/√6 is no fraction of integers for corank: asin of it cannot be told from asin of a little more than 1.
TEST(ExactNumber, RefusesAnArgumentThatMayLieOutsideTheFunctionsDomain) {
  const ExactNumber one = root(2) * root(3) / root(6);
  EXPECT_THROW(apply(ConstantFunction::asin, one).enclose(), std::domain_error);
  EXPECT_THROW(apply(ConstantFunction::acos, -one).enclose(), std::domain_error);
  EXPECT_THROW(pow(root(2) * root(3) - root(6), -2).enclose(), std::domain_error);
}

TEST(ExactNumber, RefusesAbsurdlyLongNumbers) {
  EXPECT_THROW(pow(ExactNumber(2), 1'000'000), std::domain_error);
  EXPECT_THROW(pow(ExactNumber::rational("3/7"), -1'000'000'000), std::domain_error);
  EXPECT_THROW(pow(ExactNumber(2), std::numeric_limits<int>::min()), std::domain_error);
  EXPECT_THROW(ExactNumber::rational("1e1000000000000"), std::domain_error);
  EXPECT_EQ(pow(ExactNumber(1), 1'000'000'000), ExactNumber(1));
  EXPECT_EQ(pow(ExactNumber(-1), std::numeric_limits<int>::min()), ExactNumber(1));
  ExactNumber tower = 10;
  for (int i = 0; i < 4; ++i) tower = apply(ConstantFunction::exp, tower);
  EXPECT_THROW(apply(ConstantFunction::sin, tower).enclose(), std::domain_error);
}

// ---- random expressions
// -----------------------------------------------------------------------------------------------------------

// An expression and its value in MPFI, computed apart from ExactNumber.
struct Sample {
  explicit Sample(ExactNumber n) : number(std::move(n)) { mpfi_init2(value, 700); }
  Sample(const Sample& other) : number(other.number) {
    mpfi_init2(value, 700);
    mpfi_set(value, const_cast<mpfi_ptr>(other.value));
  }
  Sample& operator=(const Sample&) = delete;
  ~Sample() { mpfi_clear(value); }
  ExactNumber number;
  mpfi_t value;
};

class Generator {
 public:
  explicit Generator(unsigned seed) : random_(seed) {}

  Sample expression(int depth) {
    if (depth == 0) return leaf();
    switch (random_() % 6) {
      case 0:
        return binary(
            depth, [](auto& a, auto& b) { return a + b; }, mpfi_add);
      case 1:
        return binary(
            depth, [](auto& a, auto& b) { return a - b; }, mpfi_sub);
      case 2:
        return binary(
            depth, [](auto& a, auto& b) { return a * b; }, mpfi_mul);
      case 3: {
        const Sample a = expression(depth - 1), b = expression(depth - 1);
        if (mpfi_has_zero(const_cast<mpfi_ptr>(b.value))) return a;
        Sample result(a.number / b.number);
        mpfi_div(result.value, const_cast<mpfi_ptr>(a.value), const_cast<mpfi_ptr>(b.value));
        return result;
      }
      case 4: {
        const Sample a = expression(depth - 1);
        const int n = static_cast<int>(random_() % 4);
        Sample result(pow(a.number, n));
        mpfi_set_si(result.value, 1);
        for (int i = 0; i < n; ++i) mpfi_mul(result.value, result.value, const_cast<mpfi_ptr>(a.value));
        return result;
      }
      default: return function(depth);
    }
  }

 private:
  Sample leaf() {
    if (random_() % 4 == 0) {
      Sample result(ExactNumber::pi());
      mpfi_const_pi(result.value);
      return result;
    }
    mpq_class q(static_cast<long>(random_() % 2001) - 1000, static_cast<long>(random_() % 100) + 1);
    q.canonicalize();
    Sample result(ExactNumber::rational(q.get_str()));
    mpfi_set_q(result.value, q.get_mpq_t());
    return result;
  }

  template <typename Op, typename MpfiOp>
  Sample binary(int depth, Op op, MpfiOp mpfi_op) {
    const Sample a = expression(depth - 1), b = expression(depth - 1);
    Sample result(op(a.number, b.number));
    mpfi_op(result.value, const_cast<mpfi_ptr>(a.value), const_cast<mpfi_ptr>(b.value));
    return result;
  }

  Sample function(int depth) {
    const Sample a = expression(depth - 1);
    const mpfi_ptr x = const_cast<mpfi_ptr>(a.value);
    if (mpfi_cmp_si(x, 10'000) > 0 || mpfi_cmp_si(x, -10'000) < 0) return a;
    const auto made = [&](ConstantFunction f, auto mpfi_function) {
      Sample result(apply(f, a.number));
      mpfi_function(result.value, x);
      return result;
    };
    switch (random_() % 7) {
      case 0: return made(ConstantFunction::sin, mpfi_sin);
      case 1: return made(ConstantFunction::cos, mpfi_cos);
      case 2: return made(ConstantFunction::atan, mpfi_atan);
      case 3: return mpfi_is_strictly_pos(x) > 0 ? made(ConstantFunction::sqrt, mpfi_sqrt) : a;
      case 4: return mpfi_is_strictly_pos(x) > 0 ? made(ConstantFunction::log, mpfi_log) : a;
      case 5: return made(ConstantFunction::abs, mpfi_abs);
      default: return mpfi_cmp_si(x, 20) < 0 ? made(ConstantFunction::exp, mpfi_exp) : a;
    }
  }

  std::mt19937_64 random_;
};

TEST(ExactNumber, EnclosesRandomExpressionsWithinTwoUlp) {
  Generator generator(kRationalSeed);
  int irrational = 0;
  for (int i = 0; i < 3000; ++i) {
    const Sample sample = generator.expression(1 + i % 5);
    const Mode scope(kModes[static_cast<std::size_t>(i) % kModes.size()]);
    const Interval x = sample.number.enclose();
    // The number lies in both, and the oracle is some 10^-200 wide (not a point: it does not fold 3·(1/3)).
    ASSERT_GE(mpfr_cmp_d(&sample.value->right, x.lo()), 0) << sample.number;
    ASSERT_LE(mpfr_cmp_d(&sample.value->left, x.hi()), 0) << sample.number;
    irrational += !sample.number.is_rational();
    if (x.contains_zero() || x.mag() < 1e-300) continue;
    ASSERT_LE(x.hi(), std::nextafter(std::nextafter(x.lo(), INFINITY), INFINITY)) << sample.number;
    ASSERT_EQ(sample.number.sign(), x.lo() > 0 ? 1 : -1) << sample.number;
  }
  EXPECT_GT(irrational, 1000);
}

TEST(ExactNumber, EnclosesTheSameInEveryRoundingMode) {
  Generator generator(kRationalSeed + 1);
  for (int i = 0; i < 300; ++i) {
    const ExactNumber number = generator.expression(4).number;
    const Interval nearest = number.enclose();
    for (const int mode : kModes) {
      const Mode scope(mode);
      ASSERT_EQ(number.enclose(), nearest) << number;
      ASSERT_EQ(std::fegetround(), mode);
    }
  }
}

TEST(ExactNumber, ComparesByStructure) {
  EXPECT_EQ(root(2) + 1, root(2) + 1);
  EXPECT_FALSE(root(2) + 1 == root(3) + 1);
  EXPECT_FALSE(apply(ConstantFunction::sin, 1) == apply(ConstantFunction::cos, 1));
  EXPECT_EQ(ExactNumber::rational("0.5"), ExactNumber::rational("2/4"));
}

}  // namespace
}  // namespace corank::certify
