// What `partial` asks of the equations that a proof does not speak of: that they hold within the tolerance, and no less.
#include "corank/certify/domain.h"

#include <gtest/gtest.h>

#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using test::SystemBuilder;

constexpr double kTau = 1e-3;  // so that 10 τ = 1/100

// x = y for y in [0, 1], from the first equation alone; the further ones are what the tests ask about.
class Partial : public testing::Test {
 protected:
  Partial() {
    x_ = builder_.variable("x", "-1", "1"), y_ = builder_.variable("y", "0", "1");
    builder_.equation({{"1", {{x_, 1}}}, {"-1", {{y_, 1}}}});
  }
  bool hold(Interval y = Interval(0.25, 0.75)) {
    System system = builder_.system();
    system.coefficient_tolerance = tolerance_;
    const CompiledSystem compiled(system);
    std::vector<Interval> piece{y + Interval(-0.5, 0.5), y};
    const NewtonStep step(compiled, {{0}, {x_}, {1.0}}, piece, workspace_);
    return RedundantEquations(system).hold(DomainTest(system), step, piece);
  }

  int x_ = 0, y_ = 0;
  double tolerance_ = kTau;
  SystemBuilder builder_;
  UpwardRounding rounding_;
  NewtonWorkspace workspace_;
};

TEST_F(Partial, AppliesWhereCoefficientsHaveATolerance) {
  System system = builder_.system();
  EXPECT_FALSE(RedundantEquations(system).applies());
  system.coefficient_tolerance = kTau;
  EXPECT_TRUE(RedundantEquations(system).applies());
  EXPECT_DOUBLE_EQ(RedundantEquations(system).tolerance(), 10 * kTau);
}

TEST_F(Partial, AnotherEquationHoldsToTenTimesTheToleranceOfItsCoefficients) {
  // x − y + c, with |coefficients| of 2 + c: up to c = 1/100 · (2 + c), which is 2/99 = 0.0202.
  SystemBuilder beyond = builder_;
  builder_.equation({{"1", {{x_, 1}}}, {"-1", {{y_, 1}}}, {"0.0201", {}}});
  EXPECT_TRUE(hold());
  builder_ = beyond;
  builder_.equation({{"1", {{x_, 1}}}, {"-1", {{y_, 1}}}, {"0.0203", {}}});
  EXPECT_FALSE(hold());
}

TEST_F(Partial, TheToleranceOfAnEquationIsThatOfItsOwnCoefficients) {
  // A tenth of the first equation, which has a bound ten times as large.
  builder_.equation({{"0.1", {{x_, 1}}}, {"-0.1", {{y_, 1}}}, {"0.0025", {}}});
  EXPECT_FALSE(hold()) << "0.0025 is more than 1/100 of 0.2025";
}

TEST_F(Partial, EveryOtherEquationHolds) {
  builder_.equation({{"1", {{x_, 1}}}, {"-1", {{y_, 1}}}});
  EXPECT_TRUE(hold());
  builder_.equation({{"1", {{x_, 1}}}, {"1", {{y_, 1}}}});
  EXPECT_FALSE(hold()) << "the last one does not";
}

TEST_F(Partial, AnotherEquationHoldsAllOverThePiece) {
  builder_.equation({{"1", {{x_, 1}}}, {"1", {{y_, 1}}}, {"-1", {}}});  // 2y − 1 on the piece
  EXPECT_TRUE(hold(Interval(0.49, 0.51)));
  EXPECT_FALSE(hold(Interval(0.25, 0.75))) << "0 is among its values, which is not enough";
}

TEST_F(Partial, ThePieceLiesInTheDomain) {
  EXPECT_TRUE(hold(Interval(0.25, 0.5)));
  SystemBuilder narrow;
  narrow.variable("x", "-1", "0.4"), narrow.variable("y", "0", "1");
  narrow.equation({{"1", {{x_, 1}}}, {"-1", {{y_, 1}}}});
  builder_ = narrow;
  EXPECT_TRUE(hold(Interval(0.1, 0.2)));
  EXPECT_FALSE(hold(Interval(0.3, 0.5))) << "x goes on to 0.5";
}

TEST_F(Partial, ThePieceSatisfiesTheInequalitiesWithinTheTolerance) {
  builder_.at_least_zero({{"-1", {{x_, 1}}}, {"1/2", {}}});  // x ≤ 1/2
  EXPECT_TRUE(hold(Interval(0.25, 0.49)));
  EXPECT_TRUE(hold(Interval(0.25, 0.509)));
  EXPECT_FALSE(hold(Interval(0.25, 0.511)));
}

}  // namespace
}  // namespace corank::certify
