// Where to cut, and on what to lean: choices that no proof depends on.
#include "corank/tests/solve/cover_questions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "corank/core/rounding.h"
#include "corank/solve/step/branching.h"
#include "corank/solve/step/preconditioner.h"

namespace corank::solve {
namespace {

// s = sin t is as narrow as t once t is narrow, while halves of [−1, 1] say little about many turns.
TEST(Branching, BisectsArgumentsRatherThanTheirSines) {
  SystemBuilder b;
  const int y = b.variable("y", "-2", "2"), t = b.variable("t", "0", "30"), s = b.variable("s", "-1", "1");
  b.equation({{"1", {{s, 1}}}, {"-1", {{t, 1, Function::sine}}}}).equation({{"1", {{y, 1}, {s, 1}}}, {"-1", {{t, 1}}}});
  const UpwardRounding rounding;
  const BranchingRule rule(b.system());
  const certify::CompiledSystem compiled(b.system());
  EXPECT_EQ(rule.weights()[s], 0);
  EXPECT_EQ(rule.weights()[t], 1);
  const std::vector<Interval> x{Interval(-0.1, 0.1), Interval(0, 1), Interval(-1, 1)};
  const std::vector<double> limits(3, 0.05);
  EXPECT_NE(rule.choose(compiled, x, limits), s);
  const std::vector<Interval> narrow{Interval(0, 0.01), Interval(0, 0.01), Interval(-1, 1)};
  EXPECT_EQ(rule.choose(compiled, narrow, limits), s);
}

// x + y + z² = 0 and x − y = 0 over a wide z: the equations alone are as uncertain in x and y, what is left open by their
// combinations is z's.
TEST(Branching, BisectsWhatNewtonsRowsLeaveOpen) {
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1"), z = b.variable("z", "-1", "1");
  b.equation({{"8", {{x, 1}}}, {"8", {{y, 1}}}, {"1", {{z, 2}}}}).equation({{"8", {{x, 1}}}, {"-8", {{y, 1}}}});
  const UpwardRounding rounding;
  const BranchingRule rule(b.system());
  const certify::CompiledSystem compiled(b.system());
  PreconditionerFactory factory(compiled);
  std::vector<Interval> box{Interval(-1, 1), Interval(-1, 1), Interval(-1, 1)};
  const std::vector<double> limits(3, 0.05);
  EXPECT_NE(rule.choose(compiled, box, limits), z);
  certify::NewtonWorkspace workspace;
  std::vector<Interval> contracted = box;
  const certify::NewtonStep step(compiled, factory.at_midpoint(box), contracted, workspace);
  EXPECT_EQ(rule.choose(compiled, box, limits, &step), z);
}

// c² = 1 says that c is 1 or −1, and which of them, in whatever else it occurs.
TEST(Branching, BeginsWithTheVariableOfAnEquationThatHasNoOther) {
  SystemBuilder b;
  const int x = b.variable("x", "-8", "8"), y = b.variable("y", "-8", "8"), c = b.variable("c", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"1/100", {{x, 1}, {c, 1}}}, {"-9", {}}});
  b.equation({{"1", {{c, 2}}}, {"-1", {}}});
  const UpwardRounding rounding;
  const certify::CompiledSystem compiled(b.system());
  const std::vector<Interval> box{Interval(-8, 8), Interval(-8, 8), Interval(-1, 1)};
  const BranchingRule rule(b.system());
  EXPECT_GT(rule.weights()[2], rule.weights()[0]);
  EXPECT_EQ(rule.choose(compiled, box, std::vector<double>(3, 0.05)), c);
}

// ξ of six unknowns on a sphere: it waits where configurations are isolated or on curves, not on surfaces. Isolated ones let
// it be wider, too, when a box is put off.
TEST(Branching, LetsManyRatesWaitForTheirConfigurations) {
  const auto rule = [](int dimension) {
    SystemBuilder b;
    const int x = b.variable("x", "-1", "1");
    for (int k = 1; k <= 6; ++k) b.variable("xi" + std::to_string(k), "-1", "1", VariableKind::kernel);
    for (int k = 1; k <= 6 - dimension; ++k) b.equation({{"1", {{x, 1}, {k, 1}}}});
    b.equation({{"1", {{x, 2}}}, {"1", {{1, 1}}}, {"-1/2", {}}});
    return BranchingRule(b.system());
  };
  for (const int dimension : {0, 1}) EXPECT_LT(rule(dimension).weights()[1], rule(dimension).weights()[0]);
  EXPECT_EQ(rule(2).weights()[1], rule(2).weights()[0]);
  EXPECT_GT(rule(0).patience(1), rule(0).patience(0));
  for (const int dimension : {1, 2}) EXPECT_EQ(rule(dimension).patience(1), 1);
}

TEST(Preconditioner, InvertsTheDependentColumns) {
  const UpwardRounding rounding;
  const System system = circle_and_diagonal().system();
  const certify::CompiledSystem compiled(system);
  PreconditionerFactory factory(compiled);
  const std::vector<Interval> x{Interval(0.5, 0.9), Interval(0.6, 0.8)};
  const auto& p = factory.at_midpoint(x);
  ASSERT_EQ(p.rank(), 2);
  const double jacobian[2][2] = {{2 * 0.7, 2 * 0.7}, {1, -1}};  // at (0.7, 0.7)
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      double entry = 0, rounding_error = 1e-12;
      for (int k = 0; k < 2; ++k) {
        const double y = p.y[static_cast<std::size_t>(a * 2 + k)], j = jacobian[p.equations[k]][p.dependent[b]];
        EXPECT_EQ(y, static_cast<double>(static_cast<float>(y))) << "a proof keeps it in four bytes";
        entry += y * j;
        rounding_error += std::fabs(y * j) * 0x1p-23;
      }
      EXPECT_NEAR(entry, a == b ? 1 : 0, rounding_error);
    }
}

}  // namespace
}  // namespace corank::solve
