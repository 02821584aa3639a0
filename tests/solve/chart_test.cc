// The choice of free variables, and the pieces that proven sheets are cut into.
#include "corank/solve/step/preconditioner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "corank/solve/search/solve.h"
#include "corank/tests/system_builder.h"

namespace corank::solve {
namespace {
using test::SystemBuilder;

double largest(const Chart& chart) {
  double most = 0;
  for (double t : chart.tangent) most = std::max(most, std::fabs(t));
  return most;
}

TEST(Chart, LeavesTheFastestVariableOfACurveFree) {
  Chart chart{{1, 3, -0.5, 2}, {0}};
  improve(chart);
  EXPECT_EQ(chart.free, std::vector<int>{1});
  EXPECT_EQ(largest(chart), 1);
  EXPECT_NEAR(chart.tangent[3], 2.0 / 3, 1e-15);
}

TEST(Chart, BoundsTheSlopesOfRandomTangentSpaces) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 4 + static_cast<int>(random() % 8), k = 1 + static_cast<int>(random() % 3);
    Chart chart;
    chart.tangent.resize(static_cast<std::size_t>(n * k));
    for (int f = 0; f < k; ++f) chart.free.push_back(f);
    for (int a = 0; a < n; ++a)
      for (int f = 0; f < k; ++f) chart.tangent[static_cast<std::size_t>(a * k + f)] = a < k ? a == f : 3 * normal(random);
    improve(chart);
    EXPECT_LT(largest(chart), 1.2) << trial;
    for (int f = 0; f < k; ++f)
      for (int g = 0; g < k; ++g)
        EXPECT_NEAR(chart.tangent[static_cast<std::size_t>(chart.free[static_cast<std::size_t>(f)] * k + g)], f == g, 1e-9);
  }
}

// x² + y² + z² = 1 in few boxes: of those with edges up to σ, a sphere of area 4π needs at least 4π/(√2 σ)² or so.
TEST(Slicer, CoversASphereWithFewBoxes) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"1", {{z, 2}}}, {"-1", {}}});
  for (const double sigma : {0.1, 0.05}) {
    Options options;
    options.sigma = sigma;
    const Cover cover = solve(b.system(), options);
    EXPECT_TRUE(cover.complete());
    EXPECT_EQ(cover.count(Verdict::regular), cover.boxes.size());
    EXPECT_EQ(cover.wider_than_sigma, 0u);
    EXPECT_LT(static_cast<double>(cover.boxes.size()), 4 * 4 * std::acos(-1.0) / (2 * sigma * sigma)) << sigma;
    for (int i = 0; i < 2000; ++i) {  // a spiral over the sphere
      const double height = -1 + (2.0 * i + 1) / 2000, angle = 2.4 * i, radius = std::sqrt(1 - height * height);
      const double point[3] = {radius * std::cos(angle), radius * std::sin(angle), height};
      const bool covered = std::any_of(cover.boxes.begin(), cover.boxes.end(), [&](const CoverBox& box) {
        for (std::size_t j = 0; j < 3; ++j)
          if (point[j] < box.box[j].lo() - 1e-12 || point[j] > box.box[j].hi() + 1e-12) return false;
        return true;
      });
      ASSERT_TRUE(covered) << i;
    }
  }
}

// Pieces of a circle meet end to end; fragments at the search's cuts are merged, so that few are much shorter than σ.
TEST(Merging, LeavesFewFragmentsOfACurve) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
  Options options;
  options.sigma = 0.25;
  const Cover cover = solve(b.system(), options);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.count(Verdict::regular), cover.boxes.size());
  EXPECT_EQ(cover.wider_than_sigma, 0u);
  // By arcs of slope at most 1, 8·(1/√2)/0.25 = 22.6.
  EXPECT_LE(cover.boxes.size(), 32u);
  for (int i = 0; i < 5000; ++i) {
    const double point[2] = {std::cos(0.0012566 * i), std::sin(0.0012566 * i)};
    EXPECT_TRUE(std::any_of(cover.boxes.begin(), cover.boxes.end(), [&](const CoverBox& box) {
      return point[0] > box.box[0].lo() - 1e-12 && point[0] < box.box[0].hi() + 1e-12 &&
             point[1] > box.box[1].lo() - 1e-12 && point[1] < box.box[1].hi() + 1e-12;
    }));
  }
}

}  // namespace
}  // namespace corank::solve
