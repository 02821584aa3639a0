// Derivatives along sheets, and what they say of a limit on level lines: against planted functions whose derivatives
// are known.
#include "corank/certify/second_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "corank/certify/sign_cell.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

ExactNumber tenth(int n) { return ExactNumber::rational(std::to_string(n) + "/10"); }

// z = k/10·x y over x and y.
System graph(int k) {
  System s;
  for (const char* name : {"x", "y", "z"}) s.variables.emplace_back(name, VariableKind::length, -9, 9);
  Polynomial f{{Monomial(1, {Factor{2}})}, "graph"};
  if (k != 0) f.monomials.emplace_back(tenth(-k), std::vector<Factor>{{0}, {1}});
  s.equations.push_back(f);
  return s;
}

// A box about a point of the graph, with all of the graph's points over it.
Box about(int k, double x, double y, double radius) {
  const double side = std::fabs(k) / 10.0 * radius * (std::fabs(x) + std::fabs(y) + radius) + 1e-12;
  const double z = k / 10.0 * x * y;
  return {Interval(x - radius, x + radius), Interval(y - radius, y + radius), Interval(z - side, z + side)};
}

// f = (a x² + b y³ + c z² + d y z)/10 with z = k/10·x y: along the graph it is a polynomial in x and y.
TEST(SecondOrder, HoldsTheDerivativesOfEveryPointOfTheBox) {
  std::mt19937 random(41);
  const auto number = [&] { return std::uniform_int_distribution(-9, 9)(random); };
  const auto real = [&](double r) { return std::uniform_real_distribution(-r, r)(random); };
  const UpwardRounding rounding;
  for (int trial = 0; trial < 200; ++trial) {
    const int k = number(), a = number(), b = number(), c = number(), d = number();
    const double x0 = real(2), y0 = real(2), radius = trial % 2 == 0 ? 1e-9 : 0.1, q = k / 10.0;
    Polynomial f;
    for (const auto& [n, factors] :
         {std::pair(a, std::vector<Factor>{{0, 2}}), {b, {{1, 3}}}, {c, {{2, 2}}}, {d, {{1}, {2}}}})
      if (n != 0) f.monomials.emplace_back(tenth(n), factors);
    const auto found = sheet_derivatives(graph(k), {0, 1}, about(k, x0, y0, radius), {f});
    ASSERT_TRUE(found);
    const SheetDerivatives& along = found->front();
    for (int sample = 0; sample < 10; ++sample) {
      const double x = x0 + real(radius), y = y0 + real(radius);
      const double truth[] = {(2 * a * x + 2 * c * q * q * x * y * y + d * q * y * y) / 10,
                              (3 * b * y * y + 2 * c * q * q * x * x * y + 2 * d * q * x * y) / 10,
                              (2 * a + 2 * c * q * q * y * y) / 10, (4 * c * q * q * x * y + 2 * d * q * y) / 10,
                              (6 * b * y + 2 * c * q * q * x * x + 2 * d * q * x) / 10};
      const Interval bounds[] = {along.first[0], along.first[1], along.second(0, 0), along.second(0, 1), along.second(1, 1)};
      for (int i = 0; i < 5; ++i) {
        EXPECT_LE(bounds[i].lo(), truth[i] + 1e-7);
        EXPECT_GE(bounds[i].hi(), truth[i] - 1e-7);
        EXPECT_LT(bounds[i].width(), radius < 1e-6 ? 1e-5 : 1e3);
      }
    }
  }
}

TEST(SecondOrder, HoldsThoseOfSinesAndCosines) {
  const UpwardRounding rounding;
  const Polynomial f{{Monomial(3, {Factor{0, 1, Function::sine}}), Monomial(5, {Factor{0, 1, Function::cosine}})}, ""};
  for (const double x : {-2.0, -0.5, 0.3, 1.0, 2.5}) {
    const Box at{Interval(x), Interval(0.0), Interval(0.0)};
    EXPECT_NEAR(gradient(f, at)[0].mid(), 3 * std::cos(x) - 5 * std::sin(x), 1e-12);
    EXPECT_NEAR(hessian(f, at)(0, 0).mid(), -3 * std::sin(x) - 5 * std::cos(x), 1e-12);
  }
}

// e = (a x² + b y² + c + p x y)/10 on the level lines y − m/10·x² = const: its second derivative by x is a polynomial.
// c makes e negative, 0 or positive where it is critical, which is all one.
TEST(CriticalLimits, AreConvexOnLevelLinesWhereTheirSecondDerivativeSaysSo) {
  std::mt19937 random(42);
  const auto number = [&] { return std::uniform_int_distribution(-9, 9)(random); };
  const auto real = [&](double r) { return std::uniform_real_distribution(-r, r)(random); };
  const UpwardRounding rounding;
  int convex = 0, wrong = 0, lost = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const int a = number(), b = number(), c = number() / 5, m = number(), p = number();
    const double x = real(1), y = real(1), slope = m / 10.0, radius = trial % 2 == 0 ? 1e-7 : 0.05;
    Polynomial e, h{{Monomial(1, {Factor{1}})}, ""};
    if (a != 0) e.monomials.emplace_back(tenth(a), std::vector<Factor>{{0, 2}});
    if (b != 0) e.monomials.emplace_back(tenth(b), std::vector<Factor>{{1, 2}});
    if (c != 0) e.monomials.emplace_back(tenth(c), std::vector<Factor>{});
    if (p != 0) e.monomials.emplace_back(tenth(p), std::vector<Factor>{{0}, {1}});
    if (m != 0) h.monomials.emplace_back(tenth(-m), std::vector<Factor>{{0, 2}});
    const auto along = sheet_derivatives(graph(3), {0, 1}, about(3, x, y, radius), {e, h});
    ASSERT_TRUE(along);
    const bool said = SignCellTest::convex_on_levels((*along)[0], (*along)[1]);
    const auto truth = [&](double u, double v) {
      return (2 * a + b * (4 * slope * v + 8 * slope * slope * u * u) + 6 * p * slope * u) / 10;
    };
    convex += said;
    for (int sample = 0; said && sample < 10; ++sample) wrong += truth(x + real(radius), y + real(radius)) < 0;
    lost += radius < 1e-6 && !said && truth(x, y) > 1e-3;
    const std::vector<double> d{real(1), real(1)};
    const double on_line = (a * d[0] * d[0] + b * d[1] * d[1] + p * d[0] * d[1]) / 5;
    const bool line = SignCellTest::convex_on_lines((*along)[0], d);
    wrong += line && on_line < 0;
    lost += !line && on_line > 1e-3;
  }
  EXPECT_GT(convex, 500);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(lost, 0);
}

// y³ is convex along y above y = 0 only; a linear function nowhere.
TEST(CriticalLimits, AreConvexOnLinesWhereTheyAreAllOverTheCell) {
  const UpwardRounding rounding;
  const Polynomial cubic{{Monomial(1, {Factor{1, 3}})}, ""}, linear{{Monomial(1, {Factor{1}})}, ""};
  for (const double y : {-1.0, -0.05, 0.0, 0.05, 1.0}) {
    const auto along = sheet_derivatives(graph(3), {0, 1}, about(3, 0.5, y, 0.1), {cubic, linear});
    ASSERT_TRUE(along);
    EXPECT_EQ(SignCellTest::convex_on_lines((*along)[0], {0, 1}), y == 1) << y;
    EXPECT_FALSE(SignCellTest::convex_on_lines((*along)[1], {0, 1}));
  }
}

}  // namespace
}  // namespace corank::certify
