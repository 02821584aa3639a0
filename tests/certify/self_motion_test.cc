// Sets of larger dimension than the count of equations says, and each hypothesis that makes them so.
#include "corank/certify/self_motion.h"

#include <gtest/gtest.h>

#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using test::SystemBuilder;

Polynomial linear(const std::vector<SystemBuilder::Term>& terms) { return SystemBuilder::polynomial(terms); }

// Where a = b, x (a − b) = 0 and x (a² − b²) = 0 are 0 = 0, and x² + a² = 1 and x² + b² = 1 are one equation.
class Motion : public testing::Test {
 protected:
  Motion() {
    a_ = builder_.variable("a", "-2", "2"), b_ = builder_.variable("b", "-2", "2"), x_ = builder_.variable("x", "-2", "2");
    builder_.equation({{"1", {{x_, 2}}}, {"1", {{a_, 2}}}, {"-1", {}}});
    builder_.equation({{"1", {{x_, 2}}}, {"1", {{b_, 2}}}, {"-1", {}}});
    builder_.equation({{"1", {{x_, 1}, {a_, 1}}}, {"-1", {{x_, 1}, {b_, 1}}}});
  }
  Polynomial equal() const { return linear({{"1", {{a_, 1}}}, {"-1", {{b_, 1}}}}); }

  // E: x (a − b) = 0 and x² + b² = 1, for a and x; {R, g}: a = b and x² + a² = 1. b is free, x = √(1 − b²).
  Sheet prove(const System& system, const std::vector<int>& rows, const std::vector<Interval>& box) {
    const auto motion = self_motion(builder_.system(), {equal()}, 1);
    if (!motion) return {};
    const CompiledSystem f(system);
    // At a = b = 0.6, x = 0.8, columns a, x: E has [0.8 0; 0 1.6], {R, g} has [1 0; 1.2 1.6].
    const Preconditioner e{rows, {a_, x_}, {1 / 0.8, 0, 0, 1 / 1.6}};
    const Preconditioner r{motion->sufficient, {a_, x_}, {1, 0, -1.2 / 1.6, 1 / 1.6}};
    return prove_self_motion(f, *motion, e, r, box, workspace_);
  }
  std::vector<Interval> near() const { return {{0.58, 0.62}, {0.595, 0.605}, {0.78, 0.82}}; }

  int a_ = 0, b_ = 0, x_ = 0;
  SystemBuilder builder_;
  UpwardRounding rounding_;
  NewtonWorkspace workspace_;
};

TEST_F(Motion, IsOfTheDimensionThatItsRelationsLeave) {
  const auto motion = self_motion(builder_.system(), {equal()}, 1);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->sufficient, (std::vector<int>{3, 0})) << "R and the first equation";
  EXPECT_EQ(motion->extended.equations.size(), 4u);
  EXPECT_FALSE(self_motion(builder_.system(), {equal()}, 2)) << "one equation is left";
  EXPECT_FALSE(self_motion(builder_.system(), {}, 1)) << "without a relation three are";
}

TEST_F(Motion, NeedsEveryEquationToBeAMultipleOfARepresentative) {
  builder_.equation({{"1", {{a_, 2}}}, {"1", {{b_, 1}}}, {"-1", {}}});  // another one on a = b
  EXPECT_FALSE(self_motion(builder_.system(), {equal()}, 1));
  EXPECT_TRUE(self_motion(builder_.system(), {equal()}, 0));
}

TEST_F(Motion, TakesLinearRelationsEachWithAVariableOfItsOwn) {
  EXPECT_FALSE(self_motion(builder_.system(), {linear({{"1", {{a_, 1}}}, {"-1", {{b_, 2}}}})}, 1)) << "no line";
  EXPECT_FALSE(self_motion(builder_.system(), {linear({{"1", {{a_, 1}}}, {"-1", {{b_, 2}}}})}, 0));
  SystemBuilder parabola;
  for (const char* name : {"a", "b", "u"}) parabola.variable(name, "-2", "2");
  parabola.equation({{"1", {{0, 1}, {2, 1}}}, {"-1", {{1, 2}, {2, 1}}}});  // u (a − b²) = 0
  EXPECT_FALSE(self_motion(parabola.system(), {linear({{"1", {{0, 1}}}, {"-1", {{1, 2}}}})}, 2));
  SystemBuilder four;
  for (const char* name : {"p", "q", "u", "v"}) four.variable(name, "-2", "2");
  four.equation({{"1", {{0, 1}, {2, 1}}}, {"-1", {{1, 1}, {2, 1}}}});
  const auto sum = linear({{"1", {{0, 1}}}, {"1", {{1, 1}}}}), difference = linear({{"1", {{0, 1}}}, {"-1", {{1, 1}}}});
  for (const int dimension : {0, 1, 2})
    EXPECT_FALSE(self_motion(four.system(), {sum, difference}, dimension)) << "both are of p and q alone";
}

TEST_F(Motion, DoesNotReplaceTheArgumentOfASine) {
  builder_.equation({{"1", {{a_, 1, Function::sine}}}, {"-1", {{b_, 1, Function::sine}}}});
  for (const int dimension : {0, 1, 2, 3}) EXPECT_FALSE(self_motion(builder_.system(), {equal()}, dimension));
}

TEST_F(Motion, IsNotOfCoefficientsWithATolerance) {
  System system = builder_.system();
  widen(system.equations[0], 1e-6);
  EXPECT_TRUE(self_motion(system, {equal()}, 1)) << "integers have none";
  builder_.equation({{"1/3", {{x_, 1}, {a_, 1}}}, {"-1/3", {{x_, 1}, {b_, 1}}}});
  system = builder_.system();
  EXPECT_TRUE(self_motion(system, {equal()}, 1));
  widen(system.equations[3], 1e-6);
  for (const int dimension : {0, 1, 2}) EXPECT_FALSE(self_motion(system, {equal()}, dimension));
}

TEST_F(Motion, IsProvenWhereBothProofsAreOfOneZero) {
  const Sheet sheet = prove(builder_.system(), {2, 1}, near());
  ASSERT_TRUE(sheet.proven);
  for (const double b : {0.595, 0.6, 0.605}) {
    EXPECT_TRUE(sheet.image[0].contains(b));
    EXPECT_TRUE((sheet.image[2] + Interval(-1e-15, 1e-15)).contains(std::sqrt(1 - b * b)));
  }
}

// Hypothesis (1).
TEST_F(Motion, IsNotProvenWhereTheEquationsMayHaveMoreZeros) {
  EXPECT_FALSE(prove(builder_.system(), {1, 2}, near()).proven) << "not shown with the rows in the wrong order";
}

// Hypothesis (2): (a − b)(a − b − 1/10) = 0 has one zero in a box about a = b + 1/10, but a = b has none there.
TEST(MotionOfTwoLines, IsNotProvenOnTheOtherLine) {
  SystemBuilder lines;
  const int a = lines.variable("a", "-2", "2"), b = lines.variable("b", "-2", "2");
  lines.equation({{"1", {{a, 2}}}, {"-2", {{a, 1}, {b, 1}}}, {"1", {{b, 2}}}, {"-1/10", {{a, 1}}}, {"1/10", {{b, 1}}}});
  const UpwardRounding rounding;
  NewtonWorkspace workspace;
  const auto motion = self_motion(lines.system(), {linear({{"1", {{a, 1}}}, {"-1", {{b, 1}}}})}, 1);
  ASSERT_TRUE(motion);
  const CompiledSystem f(lines.system());
  const auto is_proven = [&](double at, double slope, double y) {
    const std::vector<Interval> box{Interval(at) + Interval(-0.001, 0.001), {-0.001, 0.001}};
    const Preconditioner e{{0}, {a}, {1 / slope}}, r{motion->sufficient, {a}, {y}};
    EXPECT_TRUE(newton_prove(f, e, box, workspace).proven);
    return prove_self_motion(f, *motion, e, r, box, workspace).proven;
  };
  EXPECT_TRUE(is_proven(0, -0.1, 1));
  EXPECT_FALSE(is_proven(0.1, 0.1, 1));
  EXPECT_FALSE(is_proven(0, -0.1, 0)) << "not shown";
}

TEST_F(Motion, RefusesProofsOfOtherRowsOrVariables) {
  const auto motion = self_motion(builder_.system(), {equal()}, 1);
  ASSERT_TRUE(motion);
  const CompiledSystem f(builder_.system());
  const Preconditioner e{{2, 1}, {a_, x_}, {1 / 0.8, 0, 0, 1 / 1.6}};
  const Preconditioner r{motion->sufficient, {a_, x_}, {1, 0, -1.2 / 1.6, 1 / 1.6}};
  const auto refuses = [&](const CompiledSystem& system, const Preconditioner& first, const Preconditioner& second) {
    EXPECT_THROW(prove_self_motion(system, *motion, first, second, near(), workspace_), std::logic_error);
  };
  Preconditioner other = r;
  other.equations = {0, 1};
  refuses(f, e, other);
  other = r;
  other.dependent = {b_, x_};  // a = b solved for b, x² + a² = 1 for x: a is free
  other.y = {-1, 0, 0, 1 / 1.6};
  refuses(f, e, other);
  const Preconditioner beyond{{3, 0}, {a_, x_}, {1, 0, -1.2 / 1.6, 1 / 1.6}};
  const System extended = motion->extended;
  System short_one = extended;
  short_one.equations.pop_back();
  short_one.inequalities.push_back(extended.equations.back());  // a row, but no equation of F
  refuses(CompiledSystem(short_one), beyond, r);
}

TEST_F(Motion, ComparesRelationsBothWays) {
  SystemBuilder four;
  for (const char* name : {"p", "q", "u", "v"}) four.variable(name, "-2", "2");
  const auto motion = [&](std::vector<Polynomial> relations) {
    const int dimension = 4 - static_cast<int>(relations.size());
    return *self_motion(four.system(), std::move(relations), dimension);
  };
  const auto pq = linear({{"1", {{0, 1}}}, {"-1", {{1, 1}}}}), uv = linear({{"1", {{2, 1}}}, {"-1", {{3, 1}}}}),
             both = linear({{"1", {{0, 1}}}, {"-1", {{1, 1}}}, {"2", {{2, 1}}}, {"-2", {{3, 1}}}}),
             uv1 = linear({{"1", {{2, 1}}}, {"-1", {{3, 1}}}, {"-1", {}}});
  EXPECT_TRUE(same_relations(motion({pq, uv}), motion({uv, pq})));
  EXPECT_FALSE(same_relations(motion({pq}), motion({pq, uv}))) << "uv does not follow";
  EXPECT_FALSE(same_relations(motion({pq, uv}), motion({pq, uv1}))) << "one of them follows";
  EXPECT_FALSE(same_relations(motion({both}), motion({pq})));
}

}  // namespace
}  // namespace corank::certify
