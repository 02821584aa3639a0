// Systems with sines and cosines of lengths, against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/cover_lookup.h"

namespace corank {
namespace {

System system_of(const std::string& model) {
  return symbolic::algebrize(symbolic::plain_system(symbolic::parse_model(model, "m.cuik")));
}

Cover solve_with(const System& system, double sigma) {
  solve::Options options;
  options.sigma = sigma;
  return solve::solve(system, options);
}

// The line y = 0 with t = x²/4, and the circles x² + y² = 4t at t = π and 2π, crossed by it at x² = 4π, 8π.
TEST(LengthFunctions, CoverCurvesThatCross) {
  const Cover cover = solve_with(system_of("[SYSTEM VARS]\nq : [-1, 1]\nx : [-6, 6]\ny : [-6, 6]\nt : [1, 8]\n"
                                           "[SYSTEM EQS]\nq = cos(t)/2;\nt = (x^2 + y^2)/4;\ny*sin(t) = 0;\n"),
                                 0.05);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_LE(test::widest_edge(cover, 4), 0.05);
  const test::CoverLookup lookup(cover);
  for (int i = 0; i <= 500; ++i) {
    const double x = std::sqrt(4.0) + (std::sqrt(32.0) - std::sqrt(4.0)) * i / 500, t = x * x / 4;
    for (const double sign : {-1.0, 1.0})
      EXPECT_TRUE(lookup.holds(std::array{std::cos(t) / 2, sign * x, 0.0, t}, 1e-12)) << sign * x;
  }
  for (const int k : {1, 2})
    for (int i = 0; i < 500; ++i) {
      const double r = std::sqrt(4 * k * std::numbers::pi), a = 2 * std::numbers::pi * i / 500;
      EXPECT_TRUE(
          lookup.holds(std::array{k == 1 ? -0.5 : 0.5, r * std::cos(a), r * std::sin(a), k * std::numbers::pi}, 1e-12))
          << k << ' ' << a;
    }
  for (const auto& b : cover.boxes) {
    if (b.verdict != Verdict::undecided) continue;
    const double x = std::fabs(b.box[1].mid());
    EXPECT_NEAR(std::min(std::fabs(x - std::sqrt(4 * std::numbers::pi)), std::fabs(x - std::sqrt(8 * std::numbers::pi))), 0,
                0.1);
    EXPECT_NEAR(b.box[2].mid(), 0, 0.1);
  }
  EXPECT_GE(cover.count(Verdict::undecided), 4u);
  EXPECT_LE(cover.count(Verdict::undecided), 40u);
  EXPECT_GT(cover.count(Verdict::regular), 1000u);
}

// E − e sin E = M with e = 9/10, M = 1: E = 1.8620866869...
TEST(LengthFunctions, IsolateTheSolutionOfKeplersEquation) {
  const Cover cover = solve_with(system_of("[SYSTEM VARS]\nE : [-50, 50]\n[SYSTEM EQS]\nE - 0.9*sin(E) = 1;\n"), 1e-6);
  ASSERT_EQ(cover.boxes.size(), 1u);
  EXPECT_EQ(cover.boxes[0].verdict, Verdict::isolated);
  double exact = 2;
  for (int k = 0; k < 50; ++k) exact -= (exact - 0.9 * std::sin(exact) - 1) / (1 - 0.9 * std::cos(exact));
  EXPECT_NEAR(cover.boxes[0].box[0].mid(), exact, 1e-14);
  EXPECT_LE(cover.boxes[0].box[0].width(), 1e-14);
}

TEST(LengthFunctions, FindEveryZeroOfASineOfASum) {
  // sin(2x + y) = 0 and y = x²: 2x + x² = kπ, so x = −1 ± √(1 + kπ).
  const Cover cover =
      solve_with(system_of("[SYSTEM VARS]\nx : [-4, 4]\ny : [0, 16]\n[SYSTEM EQS]\nsin(2*x + y) = 0;\ny = x^2;\n"), 1e-6);
  EXPECT_TRUE(cover.complete());
  std::size_t expected = 0;
  const test::CoverLookup lookup(cover);
  for (int k = 0; k <= 7; ++k)
    for (const double sign : {-1.0, 1.0}) {
      const double x = -1 + sign * std::sqrt(1 + k * std::numbers::pi);
      if (std::fabs(x) > 4) continue;
      ++expected;
      EXPECT_TRUE(lookup.holds(std::array{x, x * x}, 1e-12)) << x;
    }
  EXPECT_EQ(cover.points.size(), expected);
  EXPECT_EQ(cover.count(Verdict::isolated), expected);
}

// A helicoid: a surface, with one turn above the other.
TEST(LengthFunctions, CoverASurface) {
  const Cover cover = solve_with(system_of("[SYSTEM VARS]\nx : [-1, 1]\ny : [-1, 1]\nr : [1/4, 3/4]\nt : [0, 10]\n"
                                           "[SYSTEM EQS]\nx = r*cos(t);\ny = r*sin(t);\n"),
                                 0.2);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 2);
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
  const test::CoverLookup lookup(cover);
  for (int i = 0; i <= 200; ++i)
    for (int j = 0; j <= 10; ++j) {
      const double t = 10.0 * i / 200, r = 0.25 + 0.05 * j;
      EXPECT_TRUE(lookup.holds(std::array{r * std::cos(t), r * std::sin(t), r, t}, 1e-12)) << t << ' ' << r;
    }
}

// A screw: turning by t lifts its nut by t/10 and moves a pin to x = cos t. With x as input it is shaky where sin t = 0.
TEST(LengthFunctions, FindTheSingularitiesOfAScrew) {
  const auto screw = symbolic::parse_model(
      "[SYSTEM VARS]\nt : [-1, 20]\nx : [-2, 2]\nz : [-1, 2]\n[SYSTEM EQS]\nx = cos(t);\nz = t/10;\n[INPUTS] x\n[OUTPUTS] "
      "z\n",
      "screw.cuik");
  const Cover forward =
      solve::solve(symbolic::algebrize(symbolic::singularity_system(screw, symbolic::SingularitySet::forward)));
  EXPECT_TRUE(forward.complete());
  ASSERT_EQ(forward.points.size(), 7u);
  for (int k = 0; k < 7; ++k) {
    const auto& point = forward.points[static_cast<std::size_t>(k)];
    EXPECT_EQ(point.verdict, Verdict::isolated);
    EXPECT_NEAR(point.box[0].mid(), k * std::numbers::pi, 1e-12);
    EXPECT_NEAR(point.box[1].mid(), k % 2 == 0 ? 1 : -1, 1e-12);
  }
  const Cover inverse =
      solve::solve(symbolic::algebrize(symbolic::singularity_system(screw, symbolic::SingularitySet::inverse)));
  EXPECT_TRUE(inverse.boxes.empty());
}

}  // namespace
}  // namespace corank
