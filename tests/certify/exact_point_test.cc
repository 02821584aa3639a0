// Points that are known exactly: verified, isolated, and refined to many digits.
#include <gtest/gtest.h>

#include <stdexcept>

#include "corank/certify/algebraic_number.h"
#include "corank/certify/distinct.h"
#include "corank/certify/exact_verification.h"
#include "corank/certify/isolation.h"
#include "corank/certify/refinement.h"
#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

ExactNumber q(const std::string& text) { return ExactNumber::rational(text); }

// t = √2
AlgebraicNumber root_of_two() { return {{q("-2"), q("0"), q("1")}, q("1"), q("2")}; }

ExactPoint rational_point(const std::vector<std::string>& coordinates) {
  ExactPoint point{{q("0"), q("1")}, q("-1"), q("1"), {}, -1, 0};
  for (const std::string& c : coordinates) point.coordinates.push_back({q(c)});
  return point;
}

TEST(AlgebraicNumber, NeedsOneRootWithAChangeOfSign) {
  EXPECT_NO_THROW(root_of_two());
  EXPECT_THROW(AlgebraicNumber({q("-2"), q("0"), q("1")}, q("-2"), q("2")), std::invalid_argument);  // two roots
  EXPECT_THROW(AlgebraicNumber({q("-2"), q("0"), q("1")}, q("2"), q("3")), std::invalid_argument);   // none
  EXPECT_THROW(AlgebraicNumber({q("1"), q("-2"), q("1")}, q("0"), q("2")), std::invalid_argument);   // (t − 1)²
  // (t − 1)³ − … three roots 1, 2, 3: a change of sign, but more than one root
  EXPECT_THROW(AlgebraicNumber({q("-6"), q("11"), q("-6"), q("1")}, q("0"), q("4")), std::invalid_argument);
  EXPECT_THROW(AlgebraicNumber({q("0"), ExactNumber::pi()}, q("-1"), q("1")), std::invalid_argument);
}

TEST(AlgebraicNumber, DecidesSigns) {
  const AlgebraicNumber t = root_of_two();
  EXPECT_EQ(t.sign({q("-2"), q("0"), q("1")}), 0);  // t² − 2
  EXPECT_EQ(t.sign({q("-141421356237309504880/100000000000000000000"), q("1")}), 1);
  EXPECT_EQ(t.sign({q("-141421356237309504881/100000000000000000000"), q("1")}), -1);
  EXPECT_EQ(t.product({q("1"), q("1")}, {q("-1"), q("1")}), RationalPolynomial{q("1")});  // (√2 + 1)(√2 − 1) = 1
  const UpwardRounding rounding;
  const Interval value = t.enclose({q("0"), q("1/2")});
  EXPECT_LE(value.lo(), 0.70710678118654752440);
  EXPECT_GE(value.hi(), 0.70710678118654752440);
  EXPECT_LT(value.width(), 1e-15);
}

TEST(AlgebraicNumber, ARationalRootInTheMiddleStaysInside) {
  const AlgebraicNumber t({q("0"), q("1")}, q("-1"), q("1"));
  EXPECT_EQ(t.sign({q("0"), q("5")}), 0);
  EXPECT_EQ(t.sign({q("1/1000000000000"), q("1")}), 1);
}

// x² + y² = 1, x = y: the points ±(√2/2, √2/2).
test::SystemBuilder diagonal() {
  test::SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}}).equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  return b;
}

TEST(VerifyExactly, AcceptsWhatHoldsAndNothingElse) {
  const System system = diagonal().system();
  ExactPoint point{{q("-2"), q("0"), q("1")}, q("1"), q("2"), {{q("0"), q("1/2")}, {q("0"), q("1/2")}}, -1, 0};
  EXPECT_TRUE(verify_exactly(system, point).holds) << verify_exactly(system, point).failure;
  ExactPoint wrong = point;
  wrong.coordinates[1][1] = q("500000000000000000000001/1000000000000000000000000");
  EXPECT_FALSE(verify_exactly(system, wrong).holds);
  wrong = point;
  wrong.polynomial[0] = q("-3");
  EXPECT_FALSE(verify_exactly(system, wrong).holds);
  wrong = point;
  wrong.lower = q("3/2");  // no root between
  EXPECT_FALSE(verify_exactly(system, wrong).holds);
  wrong = point;
  wrong.coordinates.pop_back();
  EXPECT_FALSE(verify_exactly(system, wrong).holds);
}

TEST(VerifyExactly, AsksForTheDomainAndTheInequalities) {
  test::SystemBuilder b;
  const int x = b.variable("x", "0", "1/3");
  b.equation({{"1", {{x, 2}}}, {"-1", {{x, 1}}}}).at_least_zero({{"-1", {{x, 1}}}});
  EXPECT_TRUE(verify_exactly(b.system(), rational_point({"0"})).holds);
  EXPECT_FALSE(verify_exactly(b.system(), rational_point({"1"})).holds);
}

TEST(VerifyExactly, FindsTheDimensionOfTheKernel) {
  // M(q) = [[q, q], [q, 2q]] : regular but at q = 0, where it vanishes.
  test::SystemBuilder b;
  const int x = b.variable("q", "-1", "1"), u = b.variable("xi1", "-1", "1", VariableKind::kernel),
            v = b.variable("xi2", "-1", "1", VariableKind::kernel);
  b.equation({{"1", {{x, 1}, {u, 1}}}, {"1", {{x, 1}, {v, 1}}}})
      .equation({{"1", {{x, 1}, {u, 1}}}, {"2", {{x, 1}, {v, 1}}}});
  b.equation({{"1", {{u, 2}}}, {"1", {{v, 2}}}, {"-1", {}}});
  ExactPoint point = rational_point({"0", "0", "0"});
  point.coordinates[1].clear();
  point.coordinates[2].clear();
  const ExactVerification at_zero = verify_exactly(b.system(), point);
  EXPECT_TRUE(at_zero.holds) << at_zero.failure;
  EXPECT_EQ(at_zero.corank, 2);
  point.coordinates[0] = {q("1/1000000000000000000000000")};
  EXPECT_FALSE(verify_exactly(b.system(), point).holds);
}

TEST(BlowUp, LeavesNoFaceWithASolutionAtADoubleRoot) {
  // x² = 0: on the face u = 1 the equation is u² = 0.
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1");
  b.equation({{"1", {{x, 2}}}});
  const auto faces = blow_up(b.system(), rational_point({"0"}), q("1/2"));
  ASSERT_TRUE(faces);
  ASSERT_EQ(faces->size(), 1u);
  ASSERT_EQ((*faces)[0].equations.size(), 1u);
  const auto& monomials = (*faces)[0].equations[0].monomials;
  ASSERT_EQ(monomials.size(), 1u);
  EXPECT_EQ(monomials[0].factors, (std::vector<Factor>{{0, 2}}));
}

TEST(BlowUp, RefusesWhatIsNoSolution) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1");
  b.equation({{"1", {{x, 2}}}});
  EXPECT_FALSE(blow_up(b.system(), rational_point({"1/1000"}), q("1/2")));
}

TEST(HoldsNothingElse, GoesAsFarAsIsProvenAndNoFarther) {
  ExactPoint point = rational_point({"0", "1/3"});
  const std::vector<Interval> box{{-0.25, 0.5}, {0.25, 0.5}};
  EXPECT_FALSE(holds_nothing_else(point, box)) << "nothing is known about it";
  point.sole_within = 0.5;
  EXPECT_FALSE(holds_nothing_else(point, box)) << "a corner is as far as that";
  point.sole_within = 0x1.0000000000001p-1;
  EXPECT_TRUE(holds_nothing_else(point, box));
}

TEST(ApproximateZero, ConvergesAtADoubleRoot) {
  // (x − 1/3)² = 0, y = x: each step halves the error.
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"9", {{x, 2}}}, {"-6", {{x, 1}}}, {"1", {}}}).equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  const auto zero = approximate_zero(b.system(), {ExactNumber::dyadic(0.333), ExactNumber::dyadic(0.334)}, 512);
  ASSERT_TRUE(zero);
  const ExactNumber error = (*zero)[1] - q("1/3"), bound = pow(ExactNumber(2), -200);
  EXPECT_EQ((error - bound).sign(), -1);
  EXPECT_EQ((error + bound).sign(), 1);
}

TEST(ProveZero, GivesFiftyProvenDigits) {
  const auto zero = prove_zero(diagonal().system(), {ExactNumber::dyadic(0.707), ExactNumber::dyadic(0.707)}, 50);
  ASSERT_TRUE(zero);
  EXPECT_EQ(zero->bits, 212);
  EXPECT_EQ(proven_decimal(zero->sides[0].first, zero->sides[0].second, 50),
            "0.70710678118654752440084436210484903928483593768847");
}

TEST(ProveZero, IsTheSolutionOfARegionThatItLiesIn) {
  // z = 2x is eliminated, and the region says nothing of it.
  test::SystemBuilder b = diagonal();
  const int z = b.variable("z", "-4", "4");
  b.equation({{"1", {{z, 1}}}, {"-2", {{0, 1}}}});
  Reduction reduction = reduce(b.system(), Eliminate::exact);
  const std::vector<ExactNumber> start(reduction.kept.size(), ExactNumber::dyadic(0.707));
  const auto zero = prove_zero(reduction.system, start, 30);
  ASSERT_TRUE(zero);
  const auto region = [](const Interval& side) { return std::vector<Interval>{side, side, Interval::whole()}; };
  EXPECT_TRUE(is_solution_of_region(*zero, reduction, region({0.7, 0.8})));
  EXPECT_FALSE(is_solution_of_region(*zero, reduction, region({0.7, 0.7071})));
  EXPECT_FALSE(is_solution_of_region(*zero, reduction, region({0.7072, 0.8})));
  EXPECT_FALSE(is_solution_of_region(*zero, reduction, region({-0.8, -0.7}))) << "the other solution's";
  reduction.subset = true;
  EXPECT_FALSE(is_solution_of_region(*zero, reduction, region({0.7, 0.8})));
}

TEST(ProveZero, LeavesADoubleRootUnproven) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1");
  b.equation({{"1", {{x, 2}}}});
  EXPECT_FALSE(prove_zero(b.system(), {ExactNumber::dyadic(1e-9)}, 10, 424));
}

TEST(ProvenDecimal, SaysNoMoreThanTheBoundsDo) {
  EXPECT_EQ(proven_decimal(q("0.12345"), q("0.12346"), 10), "0.1235");
  EXPECT_EQ(proven_decimal(q("-0.0004"), q("0.0004"), 10), "0.000");
  EXPECT_EQ(proven_decimal(q("-3/5"), q("-3/5"), 10), "-0.6");
  EXPECT_EQ(proven_decimal(q("1/3"), q("1/3"), 5), "0.33333");
  EXPECT_EQ(proven_decimal(q("-1"), q("-1"), 5), "-1");
  EXPECT_EQ(proven_decimal(q("-3"), q("4"), 5), "?");
}

}  // namespace
}  // namespace corank::certify
