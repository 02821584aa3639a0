// What equations imply of a variable: each case is just beyond what the lemmas of check/implied.h show.
#include "corank/check/implied.h"

#include <gtest/gtest.h>

#include "corank/check/problem.h"
#include "corank/tests/system_builder.h"

namespace corank::check {
namespace {

using Term = test::SystemBuilder::Term;
using Equations = std::vector<std::vector<Term>>;

// Variables 0, 1 … 4 = y, u, v, p, q in [−1, 2].
constexpr int kY = 0, kU = 1, kV = 2, kP = 3, kQ = 4;

System system_of(const Equations& equations, double tolerance = 0) {
  test::SystemBuilder builder;
  for (const char* name : {"y", "u", "v", "p", "q"}) builder.variable(name, "-1", "2");
  for (const auto& f : equations) builder.equation(f);
  System system = builder.system();
  system.coefficient_tolerance = tolerance;
  return system;
}

// Is y ≤ end (sign 1), y ≥ end (sign −1) implied?
bool implied(const Equations& equations, int variable, const char* end, int sign, double tolerance = 0) {
  const System system = system_of(equations);
  std::vector<Terms> terms;
  for (const Polynomial& f : system.equations) terms.emplace_back(f, tolerance);
  return Implied(system, terms).holds(variable, ExactNumber::rational(end), sign);
}

// a u² + b v² = c
std::vector<Term> squares(const char* a, int i, const char* b, int j, const char* c) {
  return {{a, {{i, 2}}}, {b, {{j, 2}}}, {std::string("-") + c, {}}};
}

TEST(ImpliedBySquares, IsABoundOfEachVariable) {
  EXPECT_TRUE(implied({squares("1", kY, "1", kU, "1")}, kY, "1", 1));
  EXPECT_TRUE(implied({squares("1", kY, "1", kU, "1")}, kY, "-1", -1));
  EXPECT_FALSE(implied({squares("1", kY, "1", kU, "1")}, kY, "99/100", 1));
  EXPECT_FALSE(implied({squares("1/4", kY, "1", kU, "1")}, kY, "1", 1)) << "up to 2";
}

TEST(ImpliedBySquares, IsNothingWhereOneIsSubtracted) {
  EXPECT_FALSE(implied({squares("1", kY, "-1", kU, "1")}, kY, "1", 1));
  EXPECT_FALSE(implied({{{"1", {{kY, 2}}}, {"1", {{kU, 2}}}, {"1", {{kV, 1}}}, {"-1", {}}}}, kY, "1", 1))
      << "v may be negative";
}

TEST(ImpliedBySquares, IsNoBoundOnTheOtherSideOfZero) {
  EXPECT_FALSE(implied({squares("1", kY, "1", kU, "1")}, kY, "-2", 1));
  EXPECT_FALSE(implied({squares("1", kY, "1", kU, "1")}, kY, "2", -1));
}

TEST(ImpliedByTheModel, IsEachEndBeyondOneOfAComponentOfADirection) {
  System system = system_of({{{"1", {{kU, 1}}}, {"-1", {{kP, 1}}}}});  // u = p
  system.variables[kY].within_one = system.variables[kP].within_one = true;
  system.variables[kP].upper = ExactNumber::rational("9/10");
  const auto holds = [&](int variable, const char* end, int sign) {
    std::vector<Terms> terms;
    for (const Polynomial& f : system.equations) terms.emplace_back(f, system.coefficient_tolerance);
    return Implied(system, terms).holds(variable, ExactNumber::rational(end), sign);
  };
  EXPECT_TRUE(holds(kY, "2", 1) && holds(kY, "-1", -1));
  EXPECT_FALSE(holds(kP, "9/10", 1)) << "the domain ends before";
  EXPECT_TRUE(holds(kP, "-1", -1) && holds(kU, "-1", -1));
  EXPECT_FALSE(holds(kQ, "2", 1));
  system.coefficient_tolerance = 1e-6;
  EXPECT_FALSE(holds(kY, "2", 1) || holds(kY, "-1", -1));
}

TEST(ImpliedBySquares, IsNothingWithinATolerance) {
  EXPECT_TRUE(implied({squares("1", kY, "1", kU, "1/4")}, kY, "1/2", 1));
  EXPECT_FALSE(implied({squares("1", kY, "1", kU, "1/4")}, kY, "1/2", 1, 0.01));
}

TEST(ImpliedBySums, IsTheExtremeOfWhatIsAdded) {
  const std::vector<Term> sine{{"1", {{kY, 1}}}, {"1", {{kU, 1, Function::sine}}}, {"-3", {}}};  // y ∈ [2, 4]
  EXPECT_TRUE(implied({sine}, kY, "4", 1));
  EXPECT_TRUE(implied({sine}, kY, "2", -1));
  EXPECT_FALSE(implied({sine}, kY, "3", 1));
  EXPECT_FALSE(implied({sine}, kY, "3", -1));
}

TEST(ImpliedBySums, TakesNoDomainThatIsNotImplied) {
  const std::vector<Term> equal{{"1", {{kY, 1}}}, {"-1", {{kU, 1}}}};
  EXPECT_FALSE(implied({equal}, kY, "2", 1)) << "u ≤ 2 is the search domain's";
  EXPECT_TRUE(implied({equal, squares("1", kU, "1", kV, "1")}, kY, "2", 1));
  EXPECT_FALSE(implied({equal, squares("1", kU, "1", kV, "1")}, kY, "0", 1));
  EXPECT_FALSE(implied({equal, squares("1", kU, "1", kV, "1")}, kY, "0", -1));
}

TEST(ImpliedBySums, IsNothingWhereATermHasNoBound) {
  EXPECT_FALSE(implied({{{"1", {{kY, 1}}}, {"1", {{kU, 2}}}}}, kY, "0", -1)) << "y = -u^2";
}

TEST(ImpliedByProducts, IsTheBoundOfCauchyAndSchwarz) {
  const std::vector<Term> product{{"1", {{kY, 1}}}, {"-1", {{kU, 1}, {kV, 1}}}};
  const std::vector<Term> twice{{"1", {{kY, 1}}}, {"-2", {{kU, 1}, {kV, 1}}}};
  const Equations circles{squares("1", kU, "1", kP, "1"), squares("1", kV, "1", kQ, "1")};
  EXPECT_TRUE(implied({product, circles[0], circles[1]}, kY, "1", 1));
  EXPECT_FALSE(implied({product, circles[0], circles[1]}, kY, "99/100", 1));
  EXPECT_FALSE(implied({twice, circles[0], circles[1]}, kY, "3/2", 1)) << "2 u v";
}

TEST(ImpliedByProducts, IsNothingWhereSomethingElseIsAdded) {
  const Equations circles{squares("1", kU, "1", kP, "1"), squares("1", kV, "1", kQ, "1")};
  const auto with = [&](const Term& term) {
    return Equations{{{"1", {{kY, 1}}}, {"-1", {{kU, 1}, {kV, 1}}}, term}, circles[0], circles[1]};
  };
  EXPECT_FALSE(implied(with({"-5", {{kP, 2}}}), kY, "1", 1));
  EXPECT_FALSE(implied(with({"-3", {}}), kY, "1", 1)) << "u v + 3";
  EXPECT_FALSE(implied(with({"-3", {}}), kY, "3", 1));
  EXPECT_TRUE(implied(with({"-3", {}}), kY, "4", 1));
}

TEST(ImpliedByProducts, NeedsDistinctFactors) {
  // u v + u p, u² + q² = 1, v² + p² = 1: up to √2.
  EXPECT_FALSE(implied({{{"1", {{kY, 1}}}, {"-1", {{kU, 1}, {kV, 1}}}, {"-1", {{kU, 1}, {kP, 1}}}},
                        squares("1", kU, "1", kQ, "1"),
                        squares("1", kV, "1", kP, "1")},
                       kY, "6/5", 1));
}

TEST(ImpliedByProducts, TakesTheLeastWeights) {
  // u v + q p, u²/4 + q² = 1, v² + p² = 1: up to 2.
  EXPECT_FALSE(implied({{{"1", {{kY, 1}}}, {"-1", {{kU, 1}, {kV, 1}}}, {"-1", {{kP, 1}, {kQ, 1}}}},
                        squares("1/4", kU, "1", kQ, "1"),
                        squares("1", kV, "1", kP, "1")},
                       kY, "3/2", 1));
}

// --- in a problem ---

// Of the variable's upper (sign 1) or lower end.
bool condition_implied(const Problem& problem, int variable, int sign) {
  return problem.conditions()[static_cast<std::size_t>(2 * variable + (sign > 0 ? 1 : 0))].implied;
}

// x² + w² = 4 in [−2, 2]², z = a x + b in a domain of its own; z is eliminated.
Problem with_value(const char* a, const char* b, const char* lower, const char* upper, double tolerance = 0) {
  test::SystemBuilder builder;
  const int x = builder.variable("x", "-2", "2"), w = builder.variable("w", "-2", "2"),
            z = builder.variable("z", lower, upper);
  builder.equation(squares("1", x, "1", w, "4"));
  builder.equation({{"-1", {{z, 1}}}, {a, {{x, 1}}}, {b, {}}});
  System system = builder.system();
  system.coefficient_tolerance = tolerance;
  return Problem(system, {Elimination{z, 1}});
}

TEST(ImpliedDomains, OfAValueFollowItsDirection) {
  EXPECT_TRUE(condition_implied(with_value("1", "0", "-5", "2"), 2, 1));
  EXPECT_FALSE(condition_implied(with_value("1", "0", "-5", "1"), 2, 1));
  EXPECT_TRUE(condition_implied(with_value("-1", "0", "-5", "2"), 2, 1));
  EXPECT_FALSE(condition_implied(with_value("-1", "0", "-5", "-2"), 2, 1)) << "-x ≤ -2 is not x ≤ 2";
  EXPECT_FALSE(condition_implied(with_value("1", "3", "-5", "2"), 2, 1)) << "x + 3 ≤ 2 is not x ≤ 2";
}

TEST(ImpliedDomains, HoldForEveryChoiceWithinTheTolerance) {
  EXPECT_TRUE(condition_implied(with_value("1/3", "0", "-5", "2/3"), 2, 1));
  EXPECT_FALSE(condition_implied(with_value("1/3", "0", "-5", "2/3", 0.01), 2, 1));
  System quarter = system_of({squares("1", kY, "1", kU, "1/4")});
  for (Variable& variable : quarter.variables)
    variable = Variable(variable.name, VariableKind::length, -1, ExactNumber::rational("1/2"));
  EXPECT_TRUE(condition_implied(Problem(quarter, {}), kY, 1));
  quarter.coefficient_tolerance = 0.01;
  EXPECT_FALSE(condition_implied(Problem(quarter, {}), kY, 1));
}

TEST(ImpliedDomains, AloneClipABox) {
  test::SystemBuilder builder;
  const int x = builder.variable("x", "-2", "1/2"), w = builder.variable("w", "-2", "2");
  builder.equation(squares("1", x, "1", w, "1"));
  const Problem problem(builder.system(), {});
  Sides sides{{-3, 3}, {-3, 3}};
  ASSERT_TRUE(problem.clip_to_implied(sides));
  EXPECT_EQ(sides[0].lo(), -2);
  EXPECT_EQ(sides[0].hi(), 3) << "x ≤ 1/2 is a boundary";
  EXPECT_EQ(sides[1].hi(), 2);
  const Sides domain = problem.domain();
  EXPECT_EQ(domain[0].lo(), -2);
  EXPECT_EQ(domain[0].hi(), 0.5);
}

}  // namespace
}  // namespace corank::check
