// Points that are known exactly: verified, isolated, and refined to many digits.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "corank/certify/algebraic_number.h"
#include "corank/certify/blow_up.h"
#include "corank/certify/distinct.h"
#include "corank/certify/exact_verification.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/refinement.h"
#include "corank/core/rounding.h"
#include "corank/tests/applied_steps.h"
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

// t³ − 3t has the roots 0 and ±√3; the one in (−1, 1) is the middle.
AlgebraicNumber zero_in_the_middle() { return {{q("0"), q("-3"), q("0"), q("1")}, q("-1"), q("1")}; }

TEST(AlgebraicNumber, ARootInTheMiddleIsKeptByBisection) {
  const AlgebraicNumber t = zero_in_the_middle();
  EXPECT_EQ(t.sign({q("1/1000000000000"), q("1")}), 1);
  EXPECT_EQ(t.sign({q("-1/1000000000000"), q("1")}), -1);
  const UpwardRounding rounding;
  EXPECT_TRUE(t.enclose({q("0"), q("1")}).contains(0));
}

TEST(AlgebraicNumber, TakesAnEndWhereADerivativeVanishes) {
  EXPECT_NO_THROW(AlgebraicNumber({q("-2"), q("0"), q("1")}, q("0"), q("2"))) << "2t is 0 at 0: no change of sign";
}

TEST(AlgebraicNumber, BoundsHoldTheValueWhereTheFunctionTurns) {
  // t = ∛2 in (0, 2), where t² − 2t is 0 at both ends and −0.93 at t.
  const AlgebraicNumber t({q("-2"), q("0"), q("0"), q("1")}, q("0"), q("2"));
  const auto bounds = t.bounds({q("0"), q("-2"), q("1")}, q("1"));
  EXPECT_EQ((bounds.lower - q("-0.93")).sign(), -1);
  EXPECT_EQ((bounds.upper - q("-0.933")).sign(), 1);
  EXPECT_EQ(t.sign({q("0"), q("-2"), q("1")}), -1);
}

TEST(AlgebraicNumber, MultipliesPolynomialsTermByTerm) {
  const AlgebraicNumber t({q("-2"), q("0"), q("0"), q("0"), q("1")}, q("1"), q("2"));
  EXPECT_EQ(t.product({q("1"), q("2"), q("3")}, {q("4"), q("5")}), (RationalPolynomial{q("4"), q("13"), q("22"), q("15")}));
  EXPECT_EQ(t.product({q("0"), q("0"), q("1")}, {q("0"), q("0"), q("1")}), RationalPolynomial{q("2")}) << "t⁴ = 2";
}

TEST(AlgebraicNumber, IsWrittenWithTheSignOfItsRoot) {
  const RationalPolynomial p{q("-2"), q("0"), q("1")};
  EXPECT_EQ(text(AlgebraicNumber(p, q("1"), q("2")), {q("0"), q("1")}), "sqrt(2)");
  EXPECT_EQ(text(AlgebraicNumber(p, q("-2"), q("-1")), {q("0"), q("1")}), "-sqrt(2)");
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

TEST(VerifyExactly, AsksForEachEndOfADomain) {
  test::SystemBuilder b;
  b.variable("x", "1/3", "2/3");
  for (const char* inside : {"1/3", "1/2", "2/3"}) EXPECT_TRUE(verify_exactly(b.system(), rational_point({inside})).holds);
  EXPECT_FALSE(verify_exactly(b.system(), rational_point({"333333333333333333/1000000000000000000"})).holds);
  EXPECT_FALSE(verify_exactly(b.system(), rational_point({"666666666666666667/1000000000000000000"})).holds);
}

TEST(VerifyExactly, TakesNoUndecidedSignForAProof) {
  // √2 is less than the lower end by 10^−75 or so, which no enclosure tells.
  test::SystemBuilder b;
  b.variable("x", "1.414213562373095048801688724209698078569671875376948073176679737990732478463", "2");
  const ExactPoint point{{q("-2"), q("0"), q("1")}, q("1"), q("2"), {{q("0"), q("1")}}, -1, 0};
  EXPECT_FALSE(verify_exactly(b.system(), point).holds);
}

TEST(VerifyExactly, AsksForEachInequality) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1");
  b.at_least_zero({{"1", {{x, 1}}}}).at_least_zero({{"1/3", {}}, {"-1", {{x, 1}}}});
  EXPECT_TRUE(verify_exactly(b.system(), rational_point({"1/3"})).holds);
  EXPECT_FALSE(verify_exactly(b.system(), rational_point({"-1/3"})).holds);
  EXPECT_FALSE(verify_exactly(b.system(), rational_point({"333333333333333334/1000000000000000000"})).holds);
}

TEST(VerifyExactly, AsksThatThePolynomialDividesEveryEquation) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{x, 1}}}, {"-3", {}}});  // √2 − 1 at √2: no constant
  const ExactPoint point{{q("-2"), q("0"), q("1")}, q("1"), q("2"), {{q("0"), q("1")}}, -1, 0};
  EXPECT_FALSE(verify_exactly(b.system(), point).holds);
}

TEST(VerifyExactly, MissesNoCoordinateButThoseOfKernelVectors) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 1}}}}).equation({{"1", {{y, 2}}}, {"1", {}}});  // the second has no solution
  ExactPoint point = rational_point({"0", "0"});
  point.coordinates[1].clear();
  EXPECT_FALSE(verify_exactly(b.system(), point).holds);
}

TEST(VerifyExactly, IsAboutRationalCoefficientsWithoutSinesOrTolerance) {
  test::SystemBuilder b, sine;
  const int x = b.variable("x", "-1", "1");
  b.equation({{"1", {{x, 1}}}});
  System system = b.system();
  EXPECT_TRUE(verify_exactly(system, rational_point({"0"})).holds);
  system.coefficient_tolerance = 1e-6;
  EXPECT_FALSE(verify_exactly(system, rational_point({"0"})).holds);
  sine.variable("x", "-1", "1");
  sine.equation({{"1", {{x, 1, Function::cosine}}}});
  EXPECT_FALSE(verify_exactly(sine.system(), rational_point({"0"})).holds) << "cos 0 is 1";
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

// M(q) = [q 1 0; 2q 2 0; …] at q = 1, with further rows of the test.
class KernelDimension : public ::testing::Test {
 protected:
  KernelDimension() {
    q_ = builder_.variable("q", "-1", "1");
    for (int k = 0; k < 3; ++k) xi_[k] = builder_.variable("xi" + std::to_string(k), "-1", "1", VariableKind::kernel);
    row({"1", "1", "0"});
    row({"2", "2", "0"});
  }
  void row(const std::vector<std::string>& entries) {
    std::vector<test::SystemBuilder::Term> terms;
    for (std::size_t k = 0; k < 3; ++k)
      if (entries[k] != "0") terms.push_back({entries[k], {{q_, 1}, {xi_[k], 1}}});
    builder_.equation(terms);
  }
  ExactVerification verified(int kernel_vectors = 1) const {
    ExactPoint point = rational_point({"1", "0", "0", "0"});
    for (std::size_t k = 1; k < 4; ++k) point.coordinates[k].clear();
    System system = builder_.system();
    system.kernel_vectors = kernel_vectors;
    return verify_exactly(system, point);
  }
  int q_ = 0, xi_[3] = {};
  test::SystemBuilder builder_;
};

TEST_F(KernelDimension, CountsARepeatedRowOnce) {
  EXPECT_EQ(verified().corank, 2);
  row({"1", "1", "1"});
  EXPECT_EQ(verified().corank, 1);
  row({"0", "0", "1"});
  EXPECT_EQ(verified().corank, 1) << "the difference of two others";
}

TEST_F(KernelDimension, OfTheRowsAfterOneThatVanishesCounts) {
  row({"3", "3", "0"});
  row({"0", "0", "1"});
  EXPECT_EQ(verified().corank, 1);
  row({"0", "1", "0"});
  EXPECT_FALSE(verified().holds) << "regular";
}

TEST(KernelMatrix, HasTheEquationsThatAreLinearAndHomogeneousInTheFirstKernelVector) {
  test::SystemBuilder b;
  const int x = b.variable("q", "-1", "1"), u = b.variable("u", "-1", "1", VariableKind::kernel),
            v = b.variable("v", "-1", "1", VariableKind::kernel);
  b.equation({{"1", {{x, 2}, {u, 1}}}, {"-3", {{v, 1}}}});
  b.equation({{"1", {{x, 1}, {u, 2}}}, {"1", {{v, 1}}}});
  b.equation({{"1", {{u, 1}, {v, 1}}}});
  b.equation({{"1", {{x, 1}, {u, 1}}}, {"1", {{x, 1}}}});
  const PolynomialMatrix one = kernel_matrix(b.system());
  EXPECT_EQ(one.rows, 1);
  EXPECT_EQ(one.columns, 2);
  ASSERT_EQ(one.entries.size(), 2u);
  EXPECT_EQ(products_of(one.entries[0]), (Products{{{x, 2}}}));
  EXPECT_EQ(products_of(one.entries[1]), (Products{Factors{}}));
  System two = b.system();  // u is ξ¹, v is ξ²
  two.kernel_vectors = 2;
  two.equations.push_back(test::SystemBuilder::polynomial({{"1", {{x, 1}, {u, 1}}}}));
  two.equations.push_back(test::SystemBuilder::polynomial({{"1", {{x, 1}, {v, 1}}}}));
  const PolynomialMatrix of_first = kernel_matrix(two);
  EXPECT_EQ(of_first.rows, 1);
  ASSERT_EQ(of_first.entries.size(), 1u);
  EXPECT_EQ(products_of(of_first.entries[0]), (Products{{{x, 1}}}));
}

TEST(KernelMatrix, OfSeveralVectorsAsksForAKernelOfTheirNumber) {
  test::SystemBuilder b;
  const int x = b.variable("q", "-1", "1");
  int xi[4];
  for (int k = 0; k < 4; ++k) xi[k] = b.variable("xi" + std::to_string(k), "-1", "1", VariableKind::kernel);
  b.equation({{"1", {{xi[0], 1}}}, {"1", {{x, 1}, {xi[1], 1}}}});  // M = [1 q], twice
  b.equation({{"1", {{xi[2], 1}}}, {"1", {{x, 1}, {xi[3], 1}}}});
  System system = b.system();
  system.kernel_vectors = 2;
  ExactPoint point = rational_point({"0", "0", "0", "0", "0"});
  for (std::size_t k = 1; k < 5; ++k) point.coordinates[k].clear();
  EXPECT_FALSE(verify_exactly(system, point).holds) << "the kernel of [1 0] has dimension 1";
  system.equations = {test::SystemBuilder::polynomial({{"1", {{x, 1}, {xi[0], 1}}}, {"1", {{x, 1}, {xi[1], 1}}}})};
  EXPECT_EQ(verify_exactly(system, point).corank, 2);
}

TEST(LiesIn, IsDecidedBetweenNeighbouringDoubles) {
  const ExactPoint point{{q("-2"), q("0"), q("1")}, q("1"), q("2"), {{q("0"), q("1")}}, -1, 0};  // √2
  const double above = 0x1.6a09e667f3bcdp+0, below = 0x1.6a09e667f3bccp+0;
  EXPECT_TRUE(PointLocation(point).in({{below, above}}));
  EXPECT_FALSE(PointLocation(point).in({{1.0, below}}));
  EXPECT_FALSE(PointLocation(point).in({{above, 2.0}}));
  EXPECT_FALSE(PointLocation(point).in({{1.5, 2.0}}));
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

TEST(BlowUp, DividesARowByItsLowestPowerOnly) {
  // x² + x³ = 0: u² + t u³ on the face u = 1.
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{x, 3}}}});
  const auto faces = blow_up(b.system(), rational_point({"0"}), q("2"));
  ASSERT_TRUE(faces && faces->size() == 1);
  const auto& monomials = (*faces)[0].equations.at(0).monomials;
  ASSERT_EQ(monomials.size(), 2u);
  EXPECT_EQ(monomials[0].factors, (std::vector<Factor>{{0, 2}}));
  EXPECT_EQ(monomials[1].factors, (std::vector<Factor>{{0, 3}, {1, 1}}));
}

TEST(BlowUp, HasAFaceForEachVariableWithTheOthersOnBothSides) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}}).equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  const auto faces = blow_up(b.system(), rational_point({"0", "0"}), q("1/2"));
  ASSERT_TRUE(faces);
  ASSERT_EQ(faces->size(), 2u);
  for (std::size_t one = 0; one < 2; ++one) {
    const auto& variables = (*faces)[one].variables;
    EXPECT_EQ(variables[one].domain, Interval(1.0));
    EXPECT_EQ(variables[1 - one].domain, Interval(-1, 1));
    EXPECT_EQ(variables[2].domain, Interval(-0.5, 0.5)) << "t has both signs, since u = 1 stands for u = -1, too";
  }
}

TEST(BlowUp, ShiftsTheEquationsToThePoint) {
  // x² − x at 1: u + t u².
  test::SystemBuilder b;
  const int x = b.variable("x", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"-1", {{x, 1}}}});
  const auto faces = blow_up(b.system(), rational_point({"1"}), q("1/2"));
  ASSERT_TRUE(faces && faces->size() == 1);
  const auto& monomials = (*faces)[0].equations.at(0).monomials;
  ASSERT_EQ(monomials.size(), 2u);
  for (const Monomial& m : monomials) EXPECT_EQ(m.coefficient, ExactNumber(1));
}

TEST(BlowUp, AsksForWhatTheTheoremNeeds) {
  test::SystemBuilder b, sine;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 1}, {y, 1}}}});
  System system = b.system();
  EXPECT_TRUE(blow_up(system, rational_point({"0", "0"}), q("1/2")));
  EXPECT_FALSE(blow_up(system, rational_point({"0", "0"}), q("0"))) << "a radius";
  system.coefficient_tolerance = 1e-6;
  EXPECT_FALSE(blow_up(system, rational_point({"0", "0"}), q("1/2"))) << "exact coefficients";
  ExactPoint point = rational_point({"0", "0"});
  point.coordinates[1].clear();
  EXPECT_FALSE(blow_up(b.system(), point, q("1/2"))) << "every coordinate";
  sine.variable("x", "-1", "1");
  sine.equation({{"1", {{x, 1, Function::sine}}}});
  EXPECT_FALSE(blow_up(sine.system(), rational_point({"0"}), q("1/2"))) << "polynomials";
}

TEST(BlowUp, DividesByNoPivotThatMayBeZero) {
  // y x at x = 0, y = t, the root 0 of t³ − 3t: the linear part t u_x is 0 at the point, but not modulo the polynomial.
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 1}, {y, 1}}}});
  const RationalPolynomial p{q("0"), q("-3"), q("0"), q("1")};
  EXPECT_FALSE(blow_up(b.system(), {p, q("-1"), q("1"), {{q("0")}, {q("0"), q("1")}}, -1, 0}, q("1/2")));
  EXPECT_TRUE(blow_up(b.system(), {p, q("1"), q("2"), {{q("0")}, {q("0"), q("1")}}, -1, 0}, q("1/2"))) << "√3 is not 0";
}

TEST(HoldsNothingElse, GoesByTheFarthestEndOfTheBox) {
  ExactPoint point = rational_point({"0", "0"});
  point.sole_within = 0.5;
  EXPECT_TRUE(holds_nothing_else(point, {{-0.25, 0.25}, {-0.25, 0.25}}));
  EXPECT_FALSE(holds_nothing_else(point, {{-0.75, 0.25}, {-0.25, 0.25}})) << "below";
  EXPECT_FALSE(holds_nothing_else(point, {{-0.25, 0.75}, {-0.25, 0.25}})) << "above, though not in the last variable";
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
  Reduction reduction = certify::apply(b.system(), {Elimination{z, static_cast<int>(b.system().equations.size()) - 1}});
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
  reduction.subset = false;
  reduction.tolerant = true;
  EXPECT_FALSE(is_solution_of_region(*zero, reduction, region({0.7, 0.8}))) << "a zero of some choice of coefficients";
}

TEST(ProveZero, IsComparedWithTheSidesOfTheKeptVariables) {
  Reduction reduction;
  reduction.kept = {1};
  const ProvenZero zero{{{q("1/4"), q("1/2")}}, 53};
  EXPECT_TRUE(is_solution_of_region(zero, reduction, {{5, 6}, {0.25, 0.5}}));
  EXPECT_FALSE(is_solution_of_region(zero, reduction, {{0, 1}, {5, 6}}));
}

TEST(ProveZero, LeavesADoubleRootUnproven) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1");
  b.equation({{"1", {{x, 2}}}});
  EXPECT_FALSE(prove_zero(b.system(), {ExactNumber::dyadic(1e-9)}, 10, 424));
}

// x + 2^48 x² about 0 with 53 bits: X = [−r, r] with r = 2^−49, where 1 − f' is [−1, 1], so that K is X.
TEST(ProveZero, AsksForTheInterior) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1");
  b.equation({{"1", {{x, 1}}}, {"281474976710656", {{x, 2}}}});
  const auto zero = prove_zero(b.system(), {ExactNumber()}, 10);
  ASSERT_TRUE(zero);
  EXPECT_EQ(zero->bits, 106);
}

// The same of the second of two variables, or the first.
TEST(ProveZero, AsksForTheInteriorInEveryVariable) {
  for (const int j : {0, 1}) {
    test::SystemBuilder b;
    for (const char* name : {"x", "y"}) b.variable(name, "-1", "1");
    b.equation({{"1", {{j, 1}}}, {"281474976710656", {{j, 2}}}}).equation({{"1", {{1 - j, 1}}}});
    const auto zero = prove_zero(b.system(), {ExactNumber(), ExactNumber()}, 10);
    ASSERT_TRUE(zero);
    EXPECT_EQ(zero->bits, 106) << j;
  }
}

TEST(ProveZero, EnclosesTheZero) {
  for (int k = 2; k < 200; ++k) {
    test::SystemBuilder b;
    const int x = b.variable("x", "0", "20");
    b.equation({{"1", {{x, 2}}}, {std::to_string(-k), {}}});
    const auto zero = prove_zero(b.system(), {ExactNumber::dyadic(std::sqrt(static_cast<double>(k)))}, 10);
    ASSERT_TRUE(zero) << k;
    const auto& [lower, upper] = zero->sides[0];
    EXPECT_LE((lower * lower - k).sign(), 0) << k;
    EXPECT_GE((upper * upper - k).sign(), 0) << k;
  }
}

TEST(ProveZero, KnowsTheDerivativesOfProductsPowersAndWaves) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-4", "4"), y = b.variable("y", "-4", "4"), t = b.variable("t", "-4", "4");
  b.equation({{"1", {{x, 3}, {y, 2}}}, {"-8", {}}}).equation({{"1", {{x, 1}}}, {"-2", {{y, 1}}}});  // 8 y⁵ = 8
  b.equation({{"1", {{t, 1}}}, {"-1", {{t, 1, Function::cosine}}}});
  const auto start = [](double value) { return ExactNumber::dyadic(value); };
  const auto zero = prove_zero(b.system(), {start(1.9), start(1.1), start(0.7)}, 30);
  ASSERT_TRUE(zero);
  EXPECT_LE(zero->bits, 212) << "a wrong derivative converges slowly";
  EXPECT_EQ(proven_decimal(zero->sides[2].first, zero->sides[2].second, 20), "0.73908513321516064166");
  EXPECT_EQ(proven_decimal(zero->sides[0].first, zero->sides[0].second, 10), "2.0000000000");
  EXPECT_EQ((zero->sides[1].first - 1).sign(), -1);
  EXPECT_EQ((zero->sides[1].second - 1).sign(), 1);
}

TEST(Bounds, AreOfAllThatTheSidesHold) {
  const auto f = test::SystemBuilder::polynomial({{"1", {{0, 2}}}, {"-1", {}}});
  const auto [lower, upper] = bounds(f, {{q("1"), q("2")}}, 53);
  EXPECT_LE(lower.sign(), 0);
  EXPECT_GE((upper - 3).sign(), 0);
  EXPECT_EQ((upper - q("3.001")).sign(), -1);
}

TEST(ProvenDecimal, SaysNoMoreThanTheBoundsDo) {
  EXPECT_EQ(proven_decimal(q("0.12345"), q("0.12346"), 10), "0.1235");
  EXPECT_EQ(proven_decimal(q("-0.0004"), q("0.0004"), 10), "0.000");
  EXPECT_EQ(proven_decimal(q("-3/5"), q("-3/5"), 10), "-0.6");
  EXPECT_EQ(proven_decimal(q("1/3"), q("1/3"), 5), "0.33333");
  EXPECT_EQ(proven_decimal(q("-1"), q("-1"), 5), "-1");
  EXPECT_EQ(proven_decimal(q("-3"), q("4"), 5), "?");
  EXPECT_EQ(proven_decimal(q("0.1"), q("0.3"), 1), "0") << "0.2 would be wrong by one unit";
  EXPECT_EQ(proven_decimal(q("0.05"), q("0.2"), 1), "0") << "0.1 would be, above";
  EXPECT_EQ(proven_decimal(q("0.11"), q("0.29"), 1), "0.2");
}

}  // namespace
}  // namespace corank::certify
