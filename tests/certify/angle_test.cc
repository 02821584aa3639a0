// angle_enclosure against atan2 at dense samples of the box.
#include "corank/certify/angle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <random>
#include <vector>

namespace corank::certify {
namespace {

constexpr double kPiBelow = 3.141592653589793;  // below the true pi
const Interval kCircle(-std::nextafter(kPiBelow, 4), std::nextafter(kPiBelow, 4));

// Is some θ + 2πk, |k| ≤ 3, in the interval? The sample's own rounding (long double) is far below the tolerance.
bool holds(const Interval& angles, long double theta) {
  for (int k = -3; k <= 3; ++k) {
    const long double shifted = theta + 2 * k * 3.14159265358979323846264338327950288L;
    if (angles.lo() <= shifted + 1e-18L && shifted - 1e-18L <= angles.hi()) return true;
  }
  return false;
}

std::vector<double> samples(const Interval& x) {
  std::vector<double> points;
  constexpr int kSteps = 24;
  for (int i = 0; i <= kSteps; ++i) {
    points.push_back(std::clamp(x.lo() + (x.hi() - x.lo()) * i / kSteps, x.lo(), x.hi()));
  }
  return points;
}

TEST(AngleEnclosure, IsTheHullAcrossTheNegativeAxis) {
  const Interval a = angle_enclosure({-1.0, -0.9}, {-0.1, 0.1}, kCircle);
  EXPECT_NEAR(a.lo(), std::atan2(0.1, -0.9), 1e-15);                  // 3.0309
  EXPECT_NEAR(a.hi(), 2 * kPiBelow + std::atan2(-0.1, -0.9), 1e-15);  // 3.2523
  EXPECT_TRUE(Interval(3.0309, 3.2523).contains(a));                  // the known hull, printed outward
  EXPECT_TRUE(a.contains(Interval(3.0310, 3.2522)));
}

TEST(AngleEnclosure, HoldsEverySampleOfRandomBoxes) {
  std::mt19937 random(20240);
  RecordProperty("seed", 20240);
  std::uniform_real_distribution<double> centre(-1, 1), exponent(-12, 0.3);
  int across = 0;
  for (int i = 0; i < 2000; ++i) {
    const double cx = centre(random), sx = centre(random), rc = std::pow(10, exponent(random)),
                 rs = std::pow(10, exponent(random));
    const Interval c(cx - rc, cx + rc), s(sx - rs, sx + rs);
    const Interval a = angle_enclosure(c, s, kCircle);
    across += a.hi() > kCircle.hi() || a.lo() < kCircle.lo();
    double lowest = 1e9, highest = -1e9;
    for (const double x : samples(c)) {
      for (const double y : samples(s)) {
        const long double theta = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        ASSERT_TRUE(holds(a, theta)) << "c = " << x << ", s = " << y << ", angle " << static_cast<double>(theta)
                                     << " not in [" << a.lo() << ", " << a.hi() << "]";
        const double turned = static_cast<double>(
            theta + 2 * kPiBelow * std::ceil((a.lo() - 1e-12 - static_cast<double>(theta)) / (2 * kPiBelow)));
        lowest = std::min(lowest, turned);
        highest = std::max(highest, turned);
      }
    }
    if (c.contains_zero() && s.contains_zero()) continue;
    // The corners are samples: no wider than the hull.
    EXPECT_NEAR(a.lo(), lowest, 1e-14);
    EXPECT_NEAR(a.hi(), highest, 1e-14);
  }
  EXPECT_GE(across, 25);  // the test is about something
}

TEST(AngleEnclosure, HoldsExactAnglesOfPointsTightly) {
  for (const double s : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    for (const double c : {-1.0, -0.25, 0.25, 1.0}) {
      const Interval a = angle_enclosure(c, s, kCircle);
      EXPECT_TRUE(holds(a, std::atan2(static_cast<long double>(s), static_cast<long double>(c))));
      EXPECT_LE(a.hi() - a.lo(), 5e-16);
    }
  }
  EXPECT_EQ(angle_enclosure(1.0, 0.0, kCircle), Interval(0.0));
}

TEST(AngleEnclosure, SaysNothingWhereTheBoxHoldsTheOrigin) {
  for (const Interval& c : {Interval(-0.5, 0.5), Interval(0.0, 1.0), Interval(-1.0, 0.0)}) {
    const Interval a = angle_enclosure(c, {-0.25, 0.0}, kCircle);
    EXPECT_EQ(a.lo(), -std::nextafter(kPiBelow, 4));
    EXPECT_EQ(a.hi(), std::nextafter(kPiBelow, 4));
  }
}

TEST(AngleEnclosure, TurnsIntoTheDeclaredRange) {
  const Interval c(-0.1, 0.1), s(-1.0, -0.9);  // about −π/2
  EXPECT_NEAR(angle_enclosure(c, s, {-4.0, 4.0}).mid(), -kPiBelow / 2, 1e-12);
  EXPECT_NEAR(angle_enclosure(c, s, {0.0, 6.4}).mid(), 1.5 * kPiBelow, 1e-12);
  EXPECT_NEAR(angle_enclosure(c, s, {30.0, 36.4}).mid(), -kPiBelow / 2 + 12 * kPiBelow, 1e-12);
  EXPECT_NEAR(angle_enclosure(c, s, {-36.4, -30.0}).mid(), -kPiBelow / 2 - 10 * kPiBelow, 1e-12);
  EXPECT_NEAR(angle_enclosure(c, s, Interval::whole()).mid(), -kPiBelow / 2, 1e-12);
}

TEST(AngleEnclosure, KeepsToTheSideOfTheCutThatItTouches) {
  const Interval above = angle_enclosure({-1.0, -0.9}, {0.0, 0.1}, kCircle);
  EXPECT_NEAR(above.lo(), std::atan2(0.1, -0.9), 1e-15);
  EXPECT_EQ(above.hi(), std::nextafter(kPiBelow, 4));
  const Interval below = angle_enclosure({-1.0, -0.9}, {-0.1, 0.0}, kCircle);
  EXPECT_EQ(below.lo(), -std::nextafter(kPiBelow, 4));
  EXPECT_NEAR(below.hi(), std::atan2(-0.1, -0.9), 1e-15);
  EXPECT_EQ(angle_enclosure({-1.0, -0.9}, {-0.0, -0.0}, kCircle), angle_enclosure({-1.0, -0.9}, {0.0, 0.0}, kCircle));
}

TEST(AngleEnclosure, DoesNotDependOnTheRoundingMode) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const double c1 = number(random), c2 = number(random), s1 = number(random), s2 = number(random);
    const Interval c(std::min(c1, c2), std::max(c1, c2)), s(std::min(s1, s2), std::max(s1, s2));
    const Interval expected = angle_enclosure(c, s, kCircle);
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      ASSERT_EQ(std::fesetround(mode), 0);
      const Interval a = angle_enclosure(c, s, kCircle);
      std::fesetround(FE_TONEAREST);
      EXPECT_EQ(a, expected) << "in rounding mode " << mode;
    }
  }
}

}  // namespace
}  // namespace corank::certify
