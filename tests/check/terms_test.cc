// The checker's reduction, step by step: what is no elimination, no repetition and no contradiction.
#include "corank/check/terms.h"

#include <gtest/gtest.h>

#include "corank/tests/system_builder.h"

namespace corank::check {
namespace {

using Term = test::SystemBuilder::Term;

Terms terms(const std::vector<Term>& list, double tolerance = 0) {
  return {test::SystemBuilder::polynomial(list), tolerance};
}
// The term's coefficient, 0 where there is none.
ExactNumber coefficient(const Terms& f, const std::vector<Factor>& factors) {
  const auto at = f.list().find(factors);
  return at == f.list().end() ? ExactNumber(0) : at->second.exact;
}
bool holds(const Enclosure& x, const char* number) { return Enclosure(ExactNumber::rational(number)).inside(x); }

TEST(Terms, DefineAVariableOnlyWhereItStandsAloneAndLinear) {
  EXPECT_TRUE(terms({{"2", {{0, 1}}}, {"1", {{1, 2}}}}).solved_for(0));
  EXPECT_FALSE(terms({{"1", {{0, 1}, {1, 1}}}, {"1", {{1, 2}}}}).solved_for(0)) << "x y + y^2";
  EXPECT_FALSE(terms({{"1", {{0, 2}}}, {"1", {{1, 1}}}}).solved_for(0)) << "x^2 + y";
  EXPECT_FALSE(terms({{"1", {{0, 1, Function::sine}}}, {"1", {{1, 1}}}}).solved_for(0)) << "sin x + y";
  EXPECT_FALSE(terms({{"1", {{1, 1}}}}).solved_for(0)) << "y";
  const ExactNumber root = ExactNumber::apply(ConstantFunction::sqrt, 2);
  const Terms irrational(Polynomial{{Monomial(root, {{0, 1}}), Monomial(1, {{1, 1}})}, ""}, 0);
  EXPECT_FALSE(irrational.solved_for(0));
}

TEST(Terms, DefineNoVariableWhoseCoefficientMayBeZero) {
  const std::vector<Term> nearly_none{{"1/3", {{0, 1}}}, {"-33/100", {{0, 1}}}, {"1", {{1, 1}}}};
  EXPECT_TRUE(terms(nearly_none).solved_for(0));
  EXPECT_FALSE(terms(nearly_none, 0.05).solved_for(0));
}

TEST(Terms, KeepTheToleranceOfWhatTheyWereDividedByAndMultipliedWith) {
  const auto value = terms({{"1/3", {{0, 1}}}, {"1", {{1, 1}}}}, 0.01).solved_for(0);
  ASSERT_TRUE(value);
  EXPECT_EQ(coefficient(*value, {{1, 1}}), -3);
  EXPECT_FALSE(value->is_exact());
  const auto product = terms({{"1", {{0, 1}, {1, 1}}}}).substituted(0, *value);
  ASSERT_TRUE(product);
  EXPECT_FALSE(product->is_exact());
  EXPECT_FALSE(terms({{"1", {{0, 1}}}, {"1/3", {{0, 1}}}}, 0.01).is_exact());
}

TEST(Terms, HaveATolerancePlusAndMinus) {
  const Terms f = terms({{"1/3", {{0, 1}}}, {"1", {}}}, 0.01);
  const Coefficient& c = f.list().at({{0, 1}});
  for (const char* number : {"331/1000", "336/1000"}) EXPECT_TRUE(holds(c.range, number)) << number;
  EXPECT_TRUE(f.list().at({}).range.inside(Enclosure(1.0))) << "integers have none";
}

TEST(Terms, DoNotVanishWithinATolerance) {
  EXPECT_TRUE(terms({{"1/3", {{0, 1}}}, {"-1/3", {{0, 1}}}}).list().empty());
  EXPECT_FALSE(terms({{"1/3", {{0, 1}}}, {"-1/3", {{0, 1}}}}, 0.01).list().empty());
  const Terms f = terms({{"1/3", {{0, 1}}}}, 0.01);
  EXPECT_FALSE(f.plus(-1, f).list().empty());
}

TEST(Terms, CancelWhereTheFactorSaysSo) {
  const Terms f = terms({{"1/3", {{0, 1}}}});
  EXPECT_TRUE(f.plus(-1, f).list().empty());
  EXPECT_EQ(coefficient(f.plus(1, f), {{0, 1}}), ExactNumber::rational("2/3"));
}

TEST(Terms, PutValuesInAsOftenAsThePowerSays) {
  const auto cube = terms({{"1", {{0, 3}}}}).substituted(0, terms({{"2", {{1, 1}}}}));
  ASSERT_TRUE(cube);
  EXPECT_EQ(coefficient(*cube, {{1, 3}}), 8);
  const auto square = terms({{"1", {{0, 1}, {1, 1}}}}).substituted(0, terms({{"1", {{1, 1}}}}));
  ASSERT_TRUE(square);
  EXPECT_EQ(coefficient(*square, {{1, 2}}), 1);
}

TEST(Terms, PutNothingIntoASineAndNoSineIntoAProduct) {
  const Terms sine = terms({{"1", {{2, 1, Function::sine}}}});
  EXPECT_FALSE(sine.substituted(2, terms({{"1", {{1, 1}}}})));
  EXPECT_FALSE(terms({{"1", {{0, 1}, {1, 1}}}}).substituted(0, sine));
  EXPECT_FALSE(terms({{"1", {{0, 2}}}}).substituted(0, sine));
  EXPECT_TRUE(terms({{"1", {{0, 1}}}}).substituted(0, sine));
}

TEST(Terms, AreARepetitionOnlyOfAMultiple) {
  const Terms f = terms({{"1", {{0, 2}}}, {"1", {{1, 2}}}, {"-1", {}}});
  EXPECT_TRUE(terms({{"3", {{0, 2}}}, {"3", {{1, 2}}}, {"-3", {}}}).is_multiple_of(f));
  EXPECT_FALSE(terms({{"1", {{0, 2}}}, {"2", {{1, 2}}}, {"-1", {}}}).is_multiple_of(f));
  EXPECT_FALSE(terms({{"1", {{0, 2}}}, {"1", {{2, 2}}}, {"-1", {}}}).is_multiple_of(f));
  EXPECT_FALSE(terms({{"1", {{0, 2}}}, {"-1", {}}}).is_multiple_of(f));
  const Terms tolerant = terms({{"1/3", {{0, 2}}}, {"-1", {}}}, 0.01);
  EXPECT_FALSE(tolerant.is_multiple_of(tolerant)) << "each choice of coefficients is its own";
}

TEST(Terms, AreAffineInOneVariableOfDegreeOneOnly) {
  EXPECT_TRUE(terms({{"2", {{0, 1}}}, {"1", {}}}).affine());
  EXPECT_FALSE(terms({{"2", {{0, 2}}}, {"1", {}}}).affine());
  EXPECT_FALSE(terms({{"2", {{0, 1}}}, {"1", {{1, 1}}}}).affine());
  EXPECT_FALSE(terms({{"2", {{0, 1, Function::sine}}}}).affine());
}

TEST(Reduction, FindsNoContradictionWithinTheTolerance) {
  test::SystemBuilder builder;
  const int x = builder.variable("x", "-2", "2");
  builder.variable("y", "-2", "2");
  builder.equation({{"3/2", {{x, 1}}}, {"-1/2", {}}}).equation({{"3/2", {{x, 1}}}, {"-5001/10000", {}}});
  System system = builder.system();
  EXPECT_TRUE(reduce(system, {Elimination{x, 0}}).contradiction);
  system.coefficient_tolerance = 0.01;
  EXPECT_FALSE(reduce(system, {Elimination{x, 0}}).contradiction);
}

// f = x² + y − 1, g = x y − 2: h₂ = 3/2·y·f − x·g, h₃ = 2·x²·h₂ with a sum before them, and a row with a sine.
TEST(Reduction, FormsImpliedEquationsFromTheirFactors) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 1}}}, {"-1", {}}}).equation({{"1", {{x, 1}, {y, 1}}}, {"-2", {}}});
  const ExactNumber half = ExactNumber(1) / ExactNumber(2);
  const ImpliedEquation second{{{0, ExactNumber(3) * half, {{y, 1}}}, {1, -1, {{x, 1}}}}}, third{{{2, 2, {{x, 2}}}}};
  const Reduced plain = reduce(b.system(), {second, third});
  ASSERT_EQ(plain.implied.size(), 2u);
  const Terms& h = plain.implied[0];  // (3/2 − 1) x² y + 3/2 y² − 3/2 y + 2 x
  EXPECT_EQ(h.list().size(), 4u);
  EXPECT_EQ(coefficient(h, {{x, 2}, {y, 1}}), half);
  EXPECT_EQ(coefficient(h, {{y, 2}}), ExactNumber(3) * half);
  EXPECT_EQ(coefficient(h, {{y, 1}}), -(ExactNumber(3) * half));
  EXPECT_EQ(coefficient(h, {{x, 1}}), ExactNumber(2));
  EXPECT_EQ(coefficient(plain.implied[1], {{x, 4}, {y, 1}}), ExactNumber(1));
  EXPECT_EQ(coefficient(plain.implied[1], {{x, 3}}), ExactNumber(4));
  EXPECT_EQ(plain.equations.size(), 2u) << "they are none of the system's equations";
  // After f ← f + 2 g the same parts give another row.
  const Reduced summed = reduce(b.system(), {SumOfEquations{0, 1, 2}, second});
  EXPECT_EQ(coefficient(summed.implied[0], {{x, 1}, {y, 2}}), ExactNumber(3));
  test::SystemBuilder wave;
  wave.variable("x", "-2", "2"), wave.variable("y", "-2", "2");
  wave.equation({{"1", {{x, 1, Function::sine}}}, {"1", {{y, 1}}}});
  EXPECT_THROW(reduce(wave.system(), {ImpliedEquation{{{0, 1, {{y, 1}}}}}}), std::invalid_argument);
  EXPECT_EQ(reduce(wave.system(), {ImpliedEquation{{{0, 2, {}}}}}).implied.size(), 1u);
}

}  // namespace
}  // namespace corank::check
