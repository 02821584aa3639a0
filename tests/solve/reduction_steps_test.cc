// What the steps of a reduction keep, wherever they were chosen: ranges, contradictions, tolerances.
#include <gtest/gtest.h>

#include "corank/solve/reduction/reducer.h"
#include "corank/tests/solve/reductions.h"

namespace corank::solve {
namespace {

TEST(Reducer, KeepsTheRangesOfWhatItEliminates) {
  // x = 2y + 1 ∈ [−4, 4] gives y ∈ [−5/2, 3/2], z = −y ∈ [−1, 3] gives y ∈ [−3, 1].
  const Reduction r = reduce(chain().system(), Eliminate::exact);
  ASSERT_EQ(r.system.size(), 1);
  const auto box = lifted(r, {r.system.variables[0].lower.enclose().lo()});
  const auto other = lifted(r, {r.system.variables[0].upper.enclose().lo()});
  EXPECT_EQ(Interval::hull(box[1], other[1]), Interval(-2.5, 1));
  // w = (1 − x²)/4 with x ∈ [−4, 3] leaves [−2, 2] at one end.
  ASSERT_EQ(r.system.inequalities.size(), 1u);
  EXPECT_EQ(r.system.variables[0].name, "x");
  EXPECT_EQ(text(r.system.inequalities[0]), "-1/4*x0^2 + 9/4");
}

TEST(Reducer, NarrowsBySidesInEitherDirection) {
  for (const char* slope : {"2", "-2"}) {
    SystemBuilder b;
    const int x = b.variable("x", "-1", "1"), y = b.variable("y", "0", "1");
    b.equation({{"1", {{y, 1}}}, {slope, {{x, 1}}}});
    const Reduction r = reduce(b.system(), Eliminate::exact);
    ASSERT_EQ(r.system.size(), 1);
    EXPECT_EQ(r.system.variables[0].domain, slope[0] == '-' ? Interval(0, 0.5) : Interval(-0.5, 0));
  }
}

TEST(Reducer, FindsContradictionsInExactArithmetic) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"3", {{x, 1}}}, {"-1", {}}}).equation({{"0.1", {{x, 1}}}, {"-0.1", {{y, 1}}}});
  b.equation({{"1", {{y, 1}}}, {"-0.3333333333333333333", {}}});
  EXPECT_FALSE(reduce(b.system(), Eliminate::exact).consistent);
  SystemBuilder c;
  c.variable("x", "0", "1");
  c.variable("y", "2", "3");
  c.equation({{"1", {{0, 1}}}, {"-1", {{1, 1}}}});
  EXPECT_FALSE(reduce(c.system(), Eliminate::exact).consistent) << "no common value";
}

TEST(Reducer, DropsEquationsThatFollow) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}}).equation({{"1", {{x, 2}}}, {"1", {{z, 2}}}, {"-1", {}}});
  b.equation({{"1/3", {{x, 2}}}, {"1/3", {{y, 2}}}, {"-1/3", {}}}).equation({{"1", {{y, 1}}}, {"1", {{z, 1}}}});
  const Reduction r = reduce(b.system(), Eliminate::exact);
  EXPECT_EQ(r.system.equations.size(), 1u);
  EXPECT_EQ(r.system.dimension(), 1);
}

TEST(Reducer, NotesWhyARepeatedEquationIsDropped) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"1", {{z, 2}}}, {"-1", {{x, 1}, {z, 1}}}, {"-2", {}}});
  b.equation({{"3", {{x, 2}}}, {"3", {{y, 2}}}, {"3", {{z, 2}}}, {"-3", {{x, 1}, {z, 1}}}, {"-6", {}}});
  const Reduction r = reduce(b.system(), Eliminate::exact);
  EXPECT_EQ(r.steps, (std::vector<ReductionStep>{SumOfEquations{2, 1, -3}, SumOfEquations{1, 0, -1}}));
}

TEST(Reducer, RemembersThatACircleImpliesARange) {
  SystemBuilder b;
  const int c = b.variable("c", "-1", "1"), s = b.variable("s", "-1", "1"), d = b.variable("d", "-1/2", "3/2"),
            e = b.variable("e", "0", "1");
  b.equation({{"1", {{d, 2}}}, {"-1", {{d, 1}}}, {"-3/4", {}}, {"1", {{s, 2}}}});  // (d − 1/2)² + s² = 1
  b.equation({{"1", {{c, 2}}}, {"1", {{s, 2}}}, {"-1", {}}}).equation({{"1", {{c, 1}}}, {"-1", {{d, 1}}}, {"1/2", {}}});
  b.equation({{"1", {{e, 1}}}, {"-1", {{s, 1}}}});
  const Reduction r = reduce(b.system(), Eliminate::exact);
  ASSERT_EQ(r.system.size(), 2);
  for (const Variable& v : r.system.variables) {
    const bool is_circle_side = v.name == "c";
    EXPECT_TRUE(v.upper_implied) << v.name;
    EXPECT_EQ(v.lower_implied, is_circle_side) << v.name << ": e >= 0 is the model's own condition";
  }
}

TEST(Reducer, KeepsWhatCancelsForSomeChoicesOfTheCoefficientsOnly) {
  // x = y, then x z/2 − y z/2 is 0 for equal coefficients only: so z² = 1 as such would lose the zeros of z² + δ y z = 1.
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
  b.equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  b.equation({{"1", {{z, 2}}}, {"-1", {}}, {"0.5", {{x, 1}, {z, 1}}}, {"-0.5", {{y, 1}, {z, 1}}}});
  System system = b.system();
  system.coefficient_tolerance = 1e-3;
  const Reduction r = reduce(system);
  ASSERT_EQ(r.system.equations.size(), 1u);
  const UpwardRounding rounding;
  // z² − 1 + 0.001 x z at x = 2, z = 1.
  EXPECT_TRUE(evaluate(r.system.equations[0], point({2, 1})).contains(0.001));
  EXPECT_EQ(evaluate(reduce(b.system()).system.equations[0], point({2, 1})), Interval(0.0));
}

TEST(Reducer, SaysThatAnEquationRepeatsAnotherWithinTheToleranceOnly) {
  for (const char* range : {"2", "200"}) {
    SystemBuilder b;
    const int x = b.variable("x", std::string("-") + range, range), y = b.variable("y", "-2", "2"),
              z = b.variable("z", "-2", "2");
    b.equation({{"0.5", {{x, 2}}}, {"-1", {{y, 2}}}, {"1", {{z, 2}}}});
    b.equation({{"1", {{x, 2}}}, {"-2", {{y, 2}}}, {"2", {{z, 2}}}});
    System system = b.system();
    EXPECT_EQ(reduce(system).system.equations.size(), 1u);
    EXPECT_FALSE(reduce(system).subset);
    system.coefficient_tolerance = 1e-3;
    const Reduction r = reduce(system);
    EXPECT_EQ(r.subset, range == std::string("2")) << "20 is more than 10 · 0.001 · 5";
    EXPECT_EQ(r.system.equations.size(), r.subset ? 1u : 2u);
  }
}

TEST(Reducer, SaysThatAnEquationHoldsWithinTheToleranceOnly) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}}).equation({{"0.5", {{x, 1}}}, {"-0.5", {{y, 1}}}});
  System system = b.system();
  EXPECT_FALSE(reduce(system).subset);
  system.coefficient_tolerance = 1e-3;
  const Reduction r = reduce(system);
  EXPECT_TRUE(r.subset && r.system.equations.empty());
}

TEST(Reducer, TakesNoRangeAsImpliedWithinATolerance) {
  for (const bool tolerant : {false, true}) {
    SystemBuilder b;
    const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-2", "2");
    b.equation({{"0.9", {{x, 2}}}, {"1", {{y, 2}}}, {"-0.9", {}}});  // x² may reach (1 + τ)/(1 − τ)
    System system = b.system();
    system.coefficient_tolerance = tolerant ? 1e-3 : 0;
    EXPECT_EQ(reduce(system).system.variables[0].upper_implied, !tolerant);
  }
}

TEST(Reducer, TakesAConstantThatMayBeZeroForNoContradiction) {
  // x = 1/2 and x = 1/2 of another tolerance: 0 = 0 for some choices.
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 1}}}, {"-1", {}}}).equation({{"0.5", {{x, 1}}}, {"-0.5", {}}, {"1e-4", {{y, 2}}}});
  b.equation({{"0.5", {{x, 1}}}, {"-0.5", {}}});
  System system = b.system();
  system.coefficient_tolerance = 1e-3;
  const Reduction r = reduce(system, Eliminate::integers);
  EXPECT_TRUE(r.consistent);
  EXPECT_TRUE(r.subset) << "one was dropped";
  EXPECT_EQ(r.system.equations.size(), 1u) << "with 1e-4 y² it is no 0 = 0, though as small";
}

TEST(Reducer, DropsWhatRepeatsToTenTimesTheToleranceAndNoMore) {
  // The second equation less twice the first is within τ · range² of 0; its coefficients are 3, so it may be 30 τ.
  for (const auto& [range, repeats] : {std::pair{"5.4", true}, {"5.5", false}}) {
    SystemBuilder b;
    const int x = b.variable("x", std::string("-") + range, range), y = b.variable("y", "-1", "1");
    b.equation({{"0.5", {{x, 2}}}, {"-1", {{y, 2}}}}).equation({{"1", {{x, 2}}}, {"-2", {{y, 2}}}});
    System system = b.system();
    system.coefficient_tolerance = 1e-3;
    const Reduction r = reduce(system, Eliminate::integers);
    EXPECT_EQ(r.system.equations.size(), repeats ? 1u : 2u) << range;
    EXPECT_EQ(r.subset, repeats) << range;
  }
}

TEST(Reducer, GivesTheRangeOfTheTiedVariableToTheOther) {
  // x = 2y + 1 in [0, 2] is y in [−1/2, 1/2]; x = −2y + 1 in [0, 3] is y in [−1, 1/2].
  for (const auto& [slope, upper, expected] : {std::tuple{"-2", "2", Interval(-0.5, 0.5)}, {"2", "3", Interval(-1, 0.5)}}) {
    SystemBuilder b;
    const int y = b.variable("y", "-4", "4"), x = b.variable("x", "0", upper);
    b.equation({{"1", {{x, 1}}}, {slope, {{y, 1}}}, {"-1", {}}});
    const Reduction r = reduce(b.system(), Eliminate::exact);
    ASSERT_EQ(r.system.size(), 1);
    EXPECT_EQ(r.system.variables[0].domain, expected);
  }
}

TEST(Reducer, GivesImpliedSidesToTheOtherVariableInItsDirection) {
  // x <= 1 is implied by the circle, x >= −1/2 is not; y = −x.
  SystemBuilder b;
  const int y = b.variable("y", "-4", "4"), x = b.variable("x", "-1/2", "1"), s = b.variable("s", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{s, 2}}}, {"-1", {}}}).equation({{"1", {{x, 1}}}, {"1", {{y, 1}}}});
  const Reduction r = reduce(b.system(), Eliminate::exact);
  ASSERT_EQ(r.system.variables[0].name, "y");
  EXPECT_TRUE(r.system.variables[0].lower_implied);
  EXPECT_FALSE(r.system.variables[0].upper_implied);
}

TEST(Reducer, AnImpliedEndInsideAnotherIsNoReasonToImplyThat) {
  // y in [0, 1] is cut at 0 by the model; x = y with the implied x >= −1 says nothing of that.
  SystemBuilder b;
  const int y = b.variable("y", "0", "1"), x = b.variable("x", "-1", "1"), s = b.variable("s", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{s, 2}}}, {"-1", {}}}).equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  const Reduction r = reduce(b.system(), Eliminate::exact);
  ASSERT_EQ(r.system.variables[0].name, "y");
  EXPECT_FALSE(r.system.variables[0].lower_implied);
  EXPECT_TRUE(r.system.variables[0].upper_implied);
}

TEST(Reducer, LeavesTheOneValueThatTwoRangesShare) {
  SystemBuilder b;
  b.variable("x", "0", "1"), b.variable("y", "1", "2"), b.variable("z", "-1", "1");
  b.equation({{"1", {{0, 1}}}, {"-1", {{1, 1}}}}).equation({{"1", {{0, 2}}}, {"1", {{2, 2}}}, {"-1", {}}});
  EXPECT_TRUE(reduce(b.system(), Eliminate::exact).consistent);
}

TEST(Reducer, ReplacesByItsDomainOnlyWhatHasOneValue) {
  SystemBuilder b;
  const int x = b.variable("x", "1/2", "1/2"), y = b.variable("y", "0.999", "1"), z = b.variable("z", "-2", "2");
  b.equation({{"1", {{x, 1}, {z, 2}}}, {"1", {{y, 2}, {z, 1}}}, {"-1", {{y, 1}}}});
  const Reduction r = reduce(b.system(), Eliminate::exact);
  EXPECT_EQ(r.kept, (std::vector<int>{y, z}));
}

// w = x z, whose range is what x and z leave: an inequality where that is not within w's domain, exactly.
class ReductionOfAnImage : public testing::Test {
 protected:
  Reduction of(const char* x_lower, const char* w_lower, const char* w_upper, double tolerance = 0) {
    SystemBuilder b;
    const int x = b.variable("x", x_lower, "1"), z = b.variable("z", "1", "2"), w = b.variable("w", w_lower, w_upper);
    b.equation({{"1", {{w, 1}}}, {"-1", {{x, 1}, {z, 1}}}});
    System system = b.system();
    system.coefficient_tolerance = tolerance;
    return reduce(system, tolerance > 0 ? Eliminate::integers : Eliminate::exact);
  }
};

TEST_F(ReductionOfAnImage, KeepsBothEndsOfItsRange) {
  EXPECT_TRUE(of("1/2", "1/2", "2").system.inequalities.empty());
  const auto lower = of("1/2", "3/4", "2").system.inequalities, upper = of("1/2", "1/2", "3/2").system.inequalities;
  ASSERT_EQ(lower.size(), 1u);
  EXPECT_EQ(text(lower[0]), "1*x0^1*x1^1 + -3/4");
  ASSERT_EQ(upper.size(), 1u);
  EXPECT_EQ(text(upper[0]), "-1*x0^1*x1^1 + 3/2");
}

TEST_F(ReductionOfAnImage, GoesByTheExactEnds) {
  // x >= the double below 1/3, so w = x z may be less than 1/3 by that.
  EXPECT_EQ(of("6004799503160661/18014398509481984", "1/3", "2").system.inequalities.size(), 1u);
  EXPECT_EQ(of("6004799503160662/18014398509481984", "1/3", "2").system.inequalities.size(), 0u);
}

TEST_F(ReductionOfAnImage, EnclosesTheCoefficientsOfItsInequalities) {
  for (const auto& [lower, upper] : {std::pair{"3/4", "2"}, {"1/2", "3/2"}}) {
    const Reduction r = of("1/2", lower, upper, 1e-3);
    ASSERT_EQ(r.system.inequalities.size(), 1u);
    for (const Monomial& m : r.system.inequalities[0].monomials)
      EXPECT_TRUE(m.enclosure.contains(m.coefficient.enclose())) << m.coefficient;
  }
}

TEST_F(ReductionOfAnImage, AsksForNoEndThatIsImplied) {
  SystemBuilder b;  // |w| <= 2 is implied by Cauchy and Schwarz, w <= 1 is not
  int v[5];
  for (int k = 0; k < 4; ++k) v[k] = b.variable("v" + std::to_string(k), "-9", "9");
  v[4] = b.variable("w", "-2", "1");
  for (const int k : {0, 2}) b.equation({{"1/2", {{v[k], 2}}}, {"1/2", {{v[k + 1], 2}}}, {"-1", {}}});
  b.equation({{"1", {{v[4], 1}}}, {"-1", {{v[0], 1}, {v[2], 1}}}, {"-1", {{v[1], 1}, {v[3], 1}}}});
  const auto inequalities = reduce(b.system(), Eliminate::exact).system.inequalities;
  ASSERT_EQ(inequalities.size(), 1u);
  EXPECT_EQ(text(inequalities[0]), "-1*x0^1*x2^1 + -1*x1^1*x3^1 + 1");
}

TEST(Reducer, DefinesEachVariableByThoseThatAreKept) {
  SystemBuilder b;  // z = y + 1, then y = x
  for (const char* name : {"x", "y", "z"}) b.variable(name, "-4", "4");
  b.equation({{"1", {{2, 1}}}, {"-1", {{1, 1}}}, {"-1", {}}}).equation({{"1", {{1, 1}}}, {"-1", {{0, 1}}}});
  const Reduction r = reduce(b.system(), Eliminate::exact);
  ASSERT_EQ(r.definitions.size(), 2u);
  EXPECT_EQ(r.definitions[0].variable, 2);
  EXPECT_EQ(text(r.definitions[0].value), "1 + 1*x0^1");
}

TEST(Reducer, ReplacesAVariableInTheInequalitiesToo) {
  SystemBuilder b;
  const int y = b.variable("y", "-4", "4"), x = b.variable("x", "-4", "4");
  b.equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}, {"-1", {}}}).at_least_zero({{"1", {{x, 2}}}, {"-1", {}}});
  const Reduction r = reduce(b.system(), Eliminate::exact);
  ASSERT_EQ(r.system.inequalities.size(), 1u);
  EXPECT_EQ(text(r.system.inequalities[0]), "2*x0^1 + 1*x0^2");
}

TEST(Reducer, NamesEquationsInItsStepsAsTheyWereGiven) {
  SystemBuilder b;  // the first equation goes, the third is shortened by the second
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
  b.equation({{"1", {{z, 1}}}, {"-1", {}}});
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"1", {{x, 1}, {y, 1}}}, {"-1", {}}});
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"1", {{x, 1}, {y, 1}}}, {"-1", {{x, 3}}}});
  const Reduction r = reduce(b.system(), Eliminate::exact);
  EXPECT_EQ(r.steps, (std::vector<ReductionStep>{Elimination{z, 0}, SumOfEquations{2, 1, -1}}));
}

}  // namespace
}  // namespace corank::solve
