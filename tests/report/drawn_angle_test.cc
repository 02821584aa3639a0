// Angles in pictures are those of certify/, to the last bit.
#include "corank/report/pictures/picture.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "corank/certify/angle.h"

namespace corank::report {
namespace {

void expect_same(const Interval& c, const Interval& s, const Interval& range) {
  const Interval drawn = drawn_angle(c, s, range), proven = certify::angle_enclosure(c, s, range);
  ASSERT_EQ(std::bit_cast<std::uint64_t>(drawn.lo()), std::bit_cast<std::uint64_t>(proven.lo())) << c << s << range;
  ASSERT_EQ(std::bit_cast<std::uint64_t>(drawn.hi()), std::bit_cast<std::uint64_t>(proven.hi())) << c << s << range;
}

const Interval kCircle(-std::numbers::pi, std::numbers::pi);

TEST(DrawnAngle, IsThatOfCertifyOnRandomBoxes) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> turn(-4, 4), size(-9, 0.5), radius(0.9, 1.1);
  for (int i = 0; i < 30'000; ++i) {
    const double t = turn(random), r = radius(random), a = std::pow(10, size(random)), b = std::pow(10, size(random));
    const Interval c(r * std::cos(t), r * std::cos(t) + a), s(r * std::sin(t), r * std::sin(t) + b);
    expect_same(c, s, kCircle);
    expect_same(c, s, Interval(t - 1, t + 1));
    expect_same(c, s, Interval(t + 5, t + 12));
  }
}

TEST(DrawnAngle, IsThatOfCertifyOnAxesAndCorners) {
  const double values[] = {-1, -0.5, -5e-324, -0.0, 0.0, 5e-324, 1e-300, 0.5, std::sqrt(0.5), 1, 1e300};
  for (const double c0 : values)
    for (const double c1 : values)
      for (const double s0 : values)
        for (const double s1 : values)
          if (c0 <= c1 && s0 <= s1)
            for (const Interval& range : {kCircle, Interval(0, 6.5), Interval(-0.5, 0.5), Interval(-10, 20)})
              expect_same(Interval(c0, c1), Interval(s0, s1), range);
}

}  // namespace
}  // namespace corank::report
