// The checker's intervals: ends, signs and branches that a proof relies on.
#include "corank/check/enclosure.h"

#include <gtest/gtest.h>

#include "corank/tests/check/enclosed_rows.h"

namespace corank::check {
namespace {

Enclosure fraction(const char* text) { return Enclosure(ExactNumber::rational(text)); }

TEST(Enclosure, HoldsAConstantThatIsNoDouble) {
  EXPECT_TRUE(holds(Enclosure(3.0) * fraction("1/3"), 1));
  EXPECT_LT(fraction("1/3").width(), 1e-40);
}

TEST(Enclosure, RoundsItsEndsOutward) {
  for (const char* text : {"1/3", "-1/3"}) {
    const Enclosure x = fraction(text);
    EXPECT_TRUE(Enclosure(x.lo()).below(x)) << text;
    EXPECT_TRUE(x.below(Enclosure(x.hi()))) << text;
  }
}

TEST(Enclosure, HasNoSmallerWidthOrMagnitudeThanItsNumbers) {
  const Enclosure x = Enclosure::hull(fraction("1/3"), 1.0);
  EXPECT_FALSE(Enclosure(x.width()).below(x.upper_end() - x.lower_end()));
  EXPECT_EQ(Enclosure(-3, 1).mag(), 3);
  EXPECT_EQ(Enclosure(-1, 3).mag(), 3);
  EXPECT_EQ(Enclosure(-3, 1).mig(), 0);
  EXPECT_EQ(Enclosure(-3, -1).mig(), 1);
}

TEST(Enclosure, HasAnInteriorWithoutItsEnds) {
  EXPECT_FALSE(Enclosure(0, 1).strictly_inside(Enclosure(0, 2)));
  EXPECT_FALSE(Enclosure(1, 2).strictly_inside(Enclosure(0, 2)));
  EXPECT_TRUE(Enclosure(0.5, 1).strictly_inside(Enclosure(0, 2)));
}

TEST(Enclosure, IsInsideASideWithBothEnds) {
  EXPECT_FALSE(Enclosure(0, 3).inside(Interval(0, 2)));
  EXPECT_FALSE(Enclosure(-1, 1).inside(Interval(0, 2)));
  EXPECT_TRUE(Enclosure(0, 2).inside(Interval(0, 2)));
}

TEST(Enclosure, OverlapsWhatItTouches) {
  for (const Interval& x : {Interval(1, 2), Interval(-1, 0)}) {
    EXPECT_TRUE(Enclosure(0, 1).overlaps(x));
    EXPECT_TRUE(Enclosure(0, 1).overlaps(Enclosure(x)));
  }
}

TEST(Enclosure, ComparesAllOfItsNumbers) {
  EXPECT_FALSE(Enclosure(0, 2).at_most(Enclosure(1, 3)));
  EXPECT_TRUE(Enclosure(0, 1).at_most(Enclosure(1, 3)));
  EXPECT_FALSE(Enclosure(0, 1).below(Enclosure(1, 3)));
  EXPECT_FALSE(Enclosure(0, 1).is_positive());
}

TEST(Enclosure, HoldsItsPowers) {
  for (const double x : {0.0, 16.0}) EXPECT_TRUE(holds(power(Enclosure(-1, 2), 4), x));
  for (const double x : {-8.0, 1.0}) EXPECT_TRUE(holds(power(Enclosure(-2, 1), 3), x));
}

TEST(Enclosure, HoldsEverySineOfALargeArgument) {
  for (const double y : {-1.0, 1.0}) {
    EXPECT_TRUE(holds(sine(Enclosure(0, 1e16)), y));
    EXPECT_TRUE(holds(cosine(Enclosure(0, 1e16)), y));
  }
}

// {x ∈ within : d·x = n} holds x.
void expect_quotient(const Enclosure& n, const Enclosure& d, double x) {
  const auto result = divide(n, d, Enclosure(-10, 10));
  ASSERT_TRUE(result);
  EXPECT_TRUE(holds(*result, x)) << x;
}

TEST(Enclosure, DividesByAnIntervalWithZero) {
  for (const double x : {-10.0, 0.0, 10.0}) expect_quotient({-1, 2}, {0, 1}, x);
  for (const double x : {-5.0, 5.0}) expect_quotient(1.0, {-1, 1}, x);
  expect_quotient(-1.0, {0, 1}, -5);
  expect_quotient(-1.0, {-1, 0}, 5);
  EXPECT_FALSE(divide(1.0, {-0.01, 0.01}, {-10, 10}));
}

TEST(Enclosure, HoldsEveryRoot) {
  const auto squares = root(4.0, 2, {-9, 9});
  ASSERT_TRUE(squares);
  for (const double x : {-2.0, 2.0}) EXPECT_TRUE(holds(*squares, x));
  const auto cubes = root(-8.0, 3, {-9, 9});
  ASSERT_TRUE(cubes);
  EXPECT_TRUE(holds(*cubes, -2));
}

TEST(Enclosure, HoldsEveryArgumentOfASineAndACosine) {
  const auto zeros = inverse_cosine(0.0, {-20, 20});
  ASSERT_TRUE(zeros);
  for (const double x : {-17.27, 17.27}) EXPECT_TRUE(holds(*zeros, x)) << "5.5 pi is 17.28";
  const auto top = inverse_sine(1.0, {0, 3});
  ASSERT_TRUE(top);
  EXPECT_TRUE(top->overlaps(Enclosure(0.5) * Enclosure::pi()));
}

}  // namespace
}  // namespace corank::check
