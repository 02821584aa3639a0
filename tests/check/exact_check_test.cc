// Exact points that are nearly one: off by 10⁻⁶⁰, zero without being so in form, or with another solution near by.
#include "corank/check/exact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "corank/check/blow_up.h"
#include "corank/tests/check/covers.h"

namespace corank::check {
namespace {

using testing::HasSubstr;

ExactNumber number(const std::string& text) { return ExactNumber::rational(text); }
ExactNumber tiny() { return number("1e-60"); }
// The first 60 digits of √(1/2): less than it.
ExactNumber digits() { return number("707106781186547524400844362104849039284835937688474036588339") * tiny(); }

// t = √(1/2), or 0 as a root of t² − t.
ExactPoint root_of_half(std::vector<RationalPolynomial> coordinates, int corank = -1) {
  return {{number("-1/2"), 0, 1}, 0, 1, std::move(coordinates), corank, 0};
}
ExactPoint zero_of_two(std::vector<RationalPolynomial> coordinates, int corank = -1) {
  return {{0, -1, 1}, number("-1/2"), number("1/2"), std::move(coordinates), corank, 0};
}
ExactPoint rational(std::vector<RationalPolynomial> coordinates, int corank = -1) {
  return {{0, 1}, -1, 1, std::move(coordinates), corank, 0};
}

std::string holds(const System& system, const ExactPoint& point) {
  const ExactCheck check(system, point);
  return check.fault().empty() ? check.holds() : check.fault();
}
std::string kernel(const System& system, const ExactPoint& point) {
  const ExactCheck check(system, point);
  EXPECT_EQ(check.fault(), "");
  return check.kernel();
}

const char* const kHalf = "[SYSTEM VARS]\nx : [0, 2]\n[SYSTEM EQS]\nx^2 = 1/2;\n";

TEST(ExactPoint, SatisfiesInequalitiesExactly) {
  System system = plain(kHalf);
  const auto with = [&](const ExactNumber& constant) {
    system.inequalities = {Polynomial{{Monomial(1, {{0, 2}}), Monomial(constant, {})}, "g"}};
    return holds(system, root_of_half({{0, 1}}));
  };
  EXPECT_EQ(with(number("-1/2")), "");
  EXPECT_EQ(with(tiny() - number("1/2")), "");
  EXPECT_THAT(with(-tiny() - number("1/2")), HasSubstr("an inequality"));
}

TEST(ExactPoint, LiesInItsDomainExactly) {
  System system = plain(kHalf);
  const ExactPoint point = root_of_half({{0, 1}});
  EXPECT_EQ(holds(system, point), "");
  Variable& x = system.variables[0];
  const auto domain = [&](const ExactNumber& lower, const ExactNumber& upper) {
    x.lower = lower;
    x.upper = upper;
    return holds(system, point);
  };
  const ExactNumber third = ExactNumber::apply(ConstantFunction::sqrt, number("1/3"));
  const ExactNumber two_thirds = ExactNumber::apply(ConstantFunction::sqrt, number("2/3"));
  EXPECT_EQ(domain(third, two_thirds), "");
  EXPECT_THAT(domain(0, third), HasSubstr("domain"));
  EXPECT_THAT(domain(two_thirds, 1), HasSubstr("domain"));
  EXPECT_THAT(domain(0, number("7/10")), HasSubstr("domain"));
  EXPECT_THAT(domain(0, digits()), HasSubstr("domain")) << "less by 10^-61";
  EXPECT_THAT(domain(number("8/10"), 1), HasSubstr("domain"));
}

TEST(ExactPoint, IsNoneOfASystemWithSinesOrATolerance) {
  System sine;
  sine.variables.emplace_back("x", VariableKind::length, -2, 2);
  sine.equations = {Polynomial{{Monomial(1, {{0, 1, Function::sine}}), Monomial(-1, {})}, "sin x = 1"}};
  EXPECT_THAT(holds(sine, rational({{1}})), HasSubstr("not a polynomial"));
  System system = plain(kHalf);
  system.coefficient_tolerance = 1e-3;
  EXPECT_THAT(holds(system, root_of_half({{0, 1}})), HasSubstr("tolerance"));
}

TEST(ExactPoint, HasRationalCoordinates) {
  const ExactNumber root = ExactNumber::apply(ConstantFunction::sqrt, number("1/2"));
  EXPECT_THAT(holds(plain(kHalf), rational({{root}})), HasSubstr("not a rational number"));
}

// The number of roots where the slope is 0 at one of them: that takes Sturm's chain.
TEST(ExactPoint, IsDefinedByTheOnlyRootAlsoWhereItIsAMultipleOne) {
  const System system = plain(kHalf);
  const auto fault = [&](const RationalPolynomial& p, const char* lower, const char* upper) {
    return ExactCheck(system, {p, number(lower), number(upper), {{0}}, -1, 0}).fault();
  };
  EXPECT_EQ(fault({0, 0, 0, 1}, "-1", "1"), "") << "t^3";
  EXPECT_EQ(fault({0, 0, 0, 1, 0, 1}, "-1", "1"), "") << "t^3 (t^2 + 1)";
  EXPECT_EQ(fault({0, 0, 0, 2, -1}, "-1", "1"), "") << "t^3 (2 - t)";
  EXPECT_THAT(fault({0, 0, 0, number("-1/4"), 0, 1}, "-1", "1"), HasSubstr("not have exactly one root"));
  EXPECT_THAT(fault({0, number("1/4"), 0, number("-5/4"), 0, 1}, "-2", "2"), HasSubstr("not have exactly one root"));
}

// M is the matrix of (a, b).
System kernel_system(const std::string& equations) {
  System system =
      plain("[SYSTEM VARS]\nx : [-9, 9]\na : [-1, 1]\nb : [-1, 1]\n[SYSTEM EQS]\n" + equations + "a^2 + b^2 = 1;\n");
  for (const std::size_t j : {1u, 2u}) system.variables[j].kind = VariableKind::kernel;
  system.configuration_size = 1;
  return system;
}

TEST(KernelAtAPoint, HasTheRankOfItsMatrix) {
  const System equal = kernel_system("x*a + x*b = 0;\n2*x*a + 2*x*b + x^2*a + x^2*b = 0;\n");
  EXPECT_EQ(kernel(equal, rational({{1}, {}, {}}, 1)), "");
  EXPECT_THAT(kernel(equal, rational({{1}, {}, {}}, 0)), HasSubstr("dimension is 1"));
  EXPECT_EQ(kernel(equal, rational({{0}, {}, {}}, 2)), "");
  const System square = kernel_system("a^2 + x*b^2 = 0;\n");
  EXPECT_EQ(kernel(square, rational({{1}, {}, {}}, 2)), "") << "no equation is linear in the kernel vector";
}

TEST(KernelAtAPoint, HasNoPivotThatIsZeroThere) {
  const System system = kernel_system("x*a = 0;\nb + a = 0;\n");
  EXPECT_THAT(kernel(system, zero_of_two({{0, 1}, {}, {}}, 0)), HasSubstr("is not shown"));
  EXPECT_EQ(kernel(system, rational({{}, {}, {}}, -1)), "");
}

TEST(KernelAtAPoint, HasNoEntryThatIsOnlyNearlyZero) {
  const System system = kernel_system("x*a = 0;\n3*b = 0;\n");
  const ExactPoint nearly = root_of_half({{-digits(), 1}, {}, {}}, 1);
  EXPECT_THAT(kernel(system, nearly), HasSubstr("is not shown"));
}

TEST(KernelAtAPoint, IsThatOfOneKernelVector) {
  System system = plain(
      "[SYSTEM VARS]\nx : [-9, 9]\na : [-1, 1]\nb : [-1, 1]\nc : [-1, 1]\nd : [-1, 1]\n"
      "[SYSTEM EQS]\nx*a + x*b = 0;\nx*c + x*d = 0;\na^2 + b^2 = 1;\nc^2 + d^2 = 1;\na*c + b*d = 0;\n");
  for (const std::size_t j : {1u, 2u, 3u, 4u}) system.variables[j].kind = VariableKind::kernel;
  system.configuration_size = 1;
  system.kernel_vectors = 2;
  EXPECT_EQ(kernel(system, rational({{0}, {}, {}, {}, {}}, 2)), "");
  EXPECT_NE(kernel(system, rational({{0}, {}, {}, {}, {}}, 4)), "");
  EXPECT_NE(kernel(system, rational({{1}, {}, {}, {}, {}}, 2)), "");
}

TEST(ExactPoint, LiesInItsBoxExactly) {
  const System system = plain("[SYSTEM VARS]\nx : [0, 1]\n[SYSTEM EQS]\nx^2 = x;\n");
  const ExactPoint beyond = rational({{number("1/2") + tiny()}});
  EXPECT_NE(ExactCheck(system, beyond).inside({{0, 0.5}}), "");
  EXPECT_EQ(ExactCheck(system, beyond).inside({{0.5, 1}}), "");
}

// What is within the radius is so in exact numbers, not where a ball's rounded ends are.
TEST(ExactPoint, HasABoxWithinTheRadiusExactly) {
  const System system = plain("[SYSTEM VARS]\nx : [-1, 1]\n[SYSTEM EQS]\nx^2 = x;\n");
  const ExactPoint half = rational({{number("1/2") + tiny()}});
  EXPECT_NE(ExactCheck(system, half).within(0.5, {{0, 0.75}}), "") << "0 is farther by 10^-60";
  EXPECT_EQ(ExactCheck(system, half).within(0.5, {{1e-30, 1}}), "");
  const ExactPoint small = rational({{pow(ExactNumber(2), -200)}});
  EXPECT_NE(ExactCheck(system, small).within(1, {{-1, 1}}), "") << "-1 is farther by 2^-200";
  EXPECT_EQ(ExactCheck(system, small).within(1, {{-0.75, 1}}), "");
}

// --- the only solution near by: each system has one more, at a distance of 1/2 ---

std::string sole(const std::string& equations, double radius) {
  const System system = plain("[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\n[SYSTEM EQS]\n" + equations);
  const ExactPoint origin = rational({{0}, {0}});
  const ExactCheck check(system, origin);
  EXPECT_EQ(check.holds(), "");
  return check_sole(system, check, radius);
}

TEST(OnlySolution, HasNoOtherInAnyDirection) {
  for (const char* equations : {
           "2*x^3 - x^2 = 0;\ny^3 + y = 0;\n",   // (1/2, 0)
           "2*x^3 + x^2 = 0;\ny^3 + y = 0;\n",   // (−1/2, 0)
           "x^3 + x = 0;\n2*y^3 - y^2 = 0;\n",   // (0, 1/2)
           "x + y = 0;\n2*x^3 - x^2 = 0;\n",     // (1/2, −1/2)
           "x^2 - y^2 = 0;\n2*y^3 + y^2 = 0;\n"  // (±1/2, −1/2)
       }) {
    EXPECT_EQ(sole(equations, 0.25), "") << equations;
    for (const double radius : {0.5, 1.0}) EXPECT_NE(sole(equations, radius), "") << equations << radius;
  }
}

TEST(OnlySolution, IsToldByEquationsWithACommonLinearPart) {
  EXPECT_EQ(sole("x + y = 0;\nx + y + x^2 + y^2 = 0;\n", 1), "") << "x^2 + y^2 = 0 is left";
  EXPECT_NE(sole("x + y = 0;\nx + y + x^2 - y^2 = 0;\n", 1), "") << "the line";
}

TEST(OnlySolution, IsOneOfAnAlgebraicNumber) {
  const System system = plain("[SYSTEM VARS]\nx : [-9, 9]\n[SYSTEM EQS]\n(x^2 - 1/2)^2 = 0;\n");
  const ExactPoint point = root_of_half({{0, 1}});
  const ExactCheck check(system, point);
  EXPECT_EQ(check_sole(system, check, 1), "");
  EXPECT_NE(check_sole(system, check, 1.5), "") << "-sqrt(1/2)";
}

}  // namespace
}  // namespace corank::check
