// Coefficients within a tolerance, and over-determined systems.
#include "corank/tests/solve/cover_questions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace corank::solve {
namespace {

// Rounded decimals make x = √3/2, y = 1/2, x² + y² = 1 inconsistent: 0.866025² + 0.25 = 0.99999930….
TEST(Solve, ProvesARoundedOverDeterminedPointPartially) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 1}}}, {"-0.866025", {}}}).equation({{"1", {{y, 1}}}, {"-0.5", {}}});
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
  EXPECT_TRUE(solve_with(b.system(), 0.01).boxes.empty()) << "exactly, there is no solution";
  System rounded = b.system();
  rounded.coefficient_tolerance = 1e-6;
  const Cover cover = solve_with(rounded, 0.01);
  ASSERT_EQ(cover.points.size(), 1u);
  EXPECT_EQ(cover.points[0].verdict, Verdict::partial);
  EXPECT_EQ(cover.count(Verdict::partial), 1u);
  EXPECT_TRUE(covers(cover, {std::sqrt(0.75), 0.5}));
}

TEST(Solve, ProvesARedundantCurvePartiallyAndNeverAContradiction) {
  // The unit circle, (x² + y²)² = 1 in rounded decimals, z = x + y twice; then radius⁴ 1.001 instead, which no point of the
  // circle has.
  for (const char* radius : {"-0.333333", "-0.333666"}) {
    SystemBuilder b;
    const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-3", "3");
    b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
    b.equation({{"0.333333", {{x, 4}}}, {"0.666666", {{x, 2}, {y, 2}}}, {"0.333333", {{y, 4}}}, {radius, {}}});
    b.equation({{"1", {{z, 1}}}, {"-1", {{x, 1}}}, {"-1", {{y, 1}}}});
    b.equation({{"2", {{z, 1}}}, {"-2", {{x, 1}}}, {"-2", {{y, 1}}}});
    System system = b.system();
    system.coefficient_tolerance = 1e-6;
    const Cover cover = solve_with(system, 0.05);
    if (std::string(radius) == "-0.333333") {
      EXPECT_EQ(cover.dimension, 1);
      EXPECT_GT(cover.count(Verdict::partial), 100u);
      EXPECT_EQ(cover.count(Verdict::partial), cover.boxes.size());
    } else {
      EXPECT_EQ(cover.count(Verdict::partial), 0u);
    }
    EXPECT_EQ(cover.count(Verdict::regular), 0u);
  }
}

// a·x² + b·y² = c; with x = y/2, x² = c/(a + 4b).
SystemBuilder ellipse(const char* a, const char* b, const char* c) {
  SystemBuilder system;
  const int x = system.variable("x", "-2", "2"), y = system.variable("y", "-2", "2");
  return system.equation({{a, {{x, 2}}}, {b, {{y, 2}}}, {std::string("-") + c, {}}});
}

TEST(Solve, ATolerancedSystemIsProvenForEveryChoiceOfItsCoefficients) {
  System curve = ellipse("3/2", "1/4", "1/2").system();
  curve.coefficient_tolerance = 1e-3;
  System points = ellipse("3/2", "1/4", "1/2").equation({{"1", {{0, 1}}}, {"-1/2", {{1, 1}}}}).system();
  points.coefficient_tolerance = 1e-3;
  const Cover one = solve_with(curve, 0.05), zero = solve(points);
  EXPECT_GT(one.count(Verdict::regular), 50u);
  EXPECT_EQ(one.count(Verdict::regular), one.boxes.size());
  EXPECT_EQ(one.tolerance, 1e-3 * kPartialTolerance);
  EXPECT_EQ(zero.count(Verdict::isolated), 2u);
  ASSERT_EQ(zero.points.size(), 2u);
  EXPECT_GT(zero.sigma.length, std::sqrt(1e-3)) << "so far apart may two solutions be that merge for some choice";
  for (const auto& [a, b, c] : {std::tuple(1.4986, 0.24976, 0.50049), {1.5014, 0.25024, 0.49951}, {1.4986, 0.25024, 0.5}}) {
    for (int degree = 0; degree < 360; ++degree) {
      const double t = degree * M_PI / 180;
      EXPECT_TRUE(covers(one, {std::sqrt(c / a) * std::cos(t), std::sqrt(c / b) * std::sin(t)})) << degree;
    }
    const double x = std::sqrt(c / (a + 4 * b));
    EXPECT_TRUE(covers(zero, {x, 2 * x}) && covers(zero, {-x, -2 * x}));
  }
  EXPECT_FALSE(covers(zero, {0.449, 0.898})) << "beyond the tolerance";
}

// A circle and a hyperbola that cross at a small angle, at the end of the range of x, and their sum: whether the point is in
// the range depends on the coefficients.
TEST(Solve, LeavesNoBoxOfAnOverDeterminedSystemUndecidedWithoutAReason) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "0.50702107"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-0.5", {}}}).equation({{"1", {{x, 1}, {y, 1}}}, {"-0.2499", {}}});
  b.equation({{"1", {{x, 2}}}, {"1", {{x, 1}, {y, 1}}}, {"1", {{y, 2}}}, {"-0.7499", {}}});
  System system = b.system();
  system.coefficient_tolerance = 1e-6;
  const Cover cover = solve_with(system, 0.01);
  EXPECT_GT(cover.count(Verdict::undecided), 0u);
  for (const CoverBox& box : cover.boxes) {
    if (box.verdict == Verdict::undecided) {
      EXPECT_EQ(box.reason, Reason::tolerance);
    }
  }
}

TEST(Solve, RefusesANonsensicalTolerance) {
  System system = circle_and_diagonal().system();
  for (double tolerance : {-1e-9, 0.1, std::nan(""), HUGE_VAL}) {
    system.coefficient_tolerance = tolerance;
    EXPECT_THROW(solve(system), std::invalid_argument) << tolerance;
  }
}

TEST(Solve, TakesOnlyPrintedSystemsWithTooManyEquationsWithinATolerance) {
  EXPECT_EQ(printed_tolerance(circle_and_diagonal().system()), 0);
  EXPECT_EQ(printed_tolerance(torus().system()), 0);
  SystemBuilder b = circle_and_diagonal();
  EXPECT_EQ(printed_tolerance(b.equation({{"2", {{0, 1}}}, {"-2", {{1, 1}}}}).system()), 1e-6);
}

// The unit circle twice is a curve, as the reduced system shows: a share of its size, which no range changes.
TEST(Solve, TakesItsDefaultSigmaFromTheDimensionAndTheSizeOfTheSetFound) {
  for (const char* end : {"2", "200"}) {
    SystemBuilder b;
    const int x = b.variable("x", std::string("-") + end, end), y = b.variable("y", std::string("-") + end, end);
    for (const char* factor : {"1", "2"}) {
      const std::string minus = std::string("-") + factor;
      b.equation({{factor, {{x, 2}}}, {factor, {{y, 2}}}, {minus, {}}});
    }
    EXPECT_DOUBLE_EQ(solve(b.system()).sigma.length, 0.01) << end;
  }
  EXPECT_LT(solve(circle_and_diagonal().system()).sigma.length, 1e-5);
}

}  // namespace
}  // namespace corank::solve
