// Angles of exact points: multiples of pi by their names, others by their sine and cosine.
#include "corank/result/values/words.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace corank::result {
namespace {

const Angle kAngle{"t", 0, 1, Interval(-3.2, 3.2)};

/// cos = a + b √root, sin = c + d √root.
ExactPoint point(int root, const char* a, const char* b, const char* c, const char* d) {
  const auto r = [](const char* text) { return ExactNumber::rational(text); };
  return {{-root, 0, 1}, 0, root, {{r(a), r(b)}, {r(c), r(d)}}, -1, 0};
}

Interval around(double angle) { return {angle - 1e-9, angle + 1e-9}; }

TEST(ExactAngle, NamesTheMultiplesOfPi) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(exact_angle(point(3, "1/2", "0", "0", "1/2"), kAngle, around(kPi / 3)), "pi/3");
  EXPECT_EQ(exact_angle(point(3, "0", "-1/2", "-1/2", "0"), kAngle, around(-5 * kPi / 6)), "-5*pi/6");
  EXPECT_EQ(exact_angle(point(2, "0", "-1/2", "0", "1/2"), kAngle, around(3 * kPi / 4)), "3*pi/4");
  EXPECT_EQ(exact_angle(point(2, "0", "0", "-1", "0"), kAngle, around(-kPi / 2)), "-pi/2");
  EXPECT_EQ(exact_angle(point(2, "1", "0", "0", "0"), kAngle, around(0)), "0");
}

TEST(ExactAngle, TakesTheTurnFromTheEnclosure) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(exact_angle(point(2, "-1", "0", "0", "0"), kAngle, around(kPi)), "pi");
  EXPECT_EQ(exact_angle(point(2, "-1", "0", "0", "0"), kAngle, around(-kPi)), "-pi");
  EXPECT_EQ(exact_angle(point(2, "0", "0", "-1", "0"), kAngle, around(1.5 * kPi)), "3*pi/2");
  EXPECT_EQ(exact_angle(point(2, "3/5", "0", "-4/5", "0"), kAngle, around(std::atan2(-0.8, 0.6) + 2 * kPi)),
            "atan2(-4/5, 3/5) + 2*pi");
}

TEST(ExactAngle, GivesSineAndCosineOfOthers) {
  const ExactPoint p = point(2, "3/5", "0", "4/5", "0");
  EXPECT_EQ(exact_angle(p, kAngle, around(std::atan2(0.8, 0.6))), "atan2(4/5, 3/5)");
  EXPECT_FALSE(multiple_of_pi(p, kAngle, around(std::atan2(0.8, 0.6))));
}

TEST(ExactAngle, SaysNothingWhereNothingIsKnown) {
  ExactPoint p = point(2, "3/5", "0", "4/5", "0");
  p.coordinates[1].clear();
  EXPECT_FALSE(exact_angle(p, kAngle, around(1)));
}

TEST(ExactAngle, IsNoMultipleOfPiForHalfACosine) {
  EXPECT_EQ(exact_angle(point(15, "1/4", "0", "0", "1/4"), kAngle, around(std::acos(0.25))), "atan2(1/4*sqrt(15), 1/4)");
}

}  // namespace
}  // namespace corank::result
