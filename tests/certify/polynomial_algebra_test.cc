// Exact arithmetic on polynomials whose enclosures may carry a tolerance: what is done to a coefficient is done to both.
#include "corank/certify/polynomial_algebra.h"

#include <gtest/gtest.h>

#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using test::SystemBuilder;

constexpr double kWidening = 1e-3;

class Tolerant : public testing::Test {
 protected:
  static Polynomial wide(const std::vector<test::SystemBuilder::Term>& terms) {
    Polynomial f = test::SystemBuilder::polynomial(terms);
    widen(f, kWidening);
    return f;
  }
  static Polynomial exact(const std::vector<test::SystemBuilder::Term>& terms) {
    return test::SystemBuilder::polynomial(terms);
  }
  // The monomial with these factors; a coefficient of 0 where there is none.
  static Monomial at(const Polynomial& f, const std::vector<Factor>& factors) {
    for (const Monomial& m : f.monomials)
      if (m.factors == factors) return m;
    return {0, {}};
  }
  // Encloses c·(1 ± share).
  static void expect(const Monomial& m, double c, double share) {
    EXPECT_TRUE(m.coefficient.enclose().contains(c));
    EXPECT_NEAR(m.enclosure.lo(), c - share, 1e-6);
    EXPECT_NEAR(m.enclosure.hi(), c + share, 1e-6);
  }
  UpwardRounding rounding_;
};

TEST_F(Tolerant, EnclosuresAreSolvedForWithTheirSign) {
  const auto value = solved_for(wide({{"2", {{0, 1}}}, {"0.5", {{1, 1}}}, {"3", {}}}), 0);
  ASSERT_TRUE(value);
  expect(at(*value, {{1, 1}}), -0.25, 0.25 * kWidening);
  EXPECT_EQ(at(*value, {}).enclosure, Interval(-1.5));
}

TEST_F(Tolerant, NothingIsDividedByWhatMayBeZero) {
  Polynomial f = exact({{"1", {{1, 1}}}});
  f.monomials.emplace_back(0, std::vector<Factor>{{0, 1}});
  f.monomials.back().enclosure = Interval(-kWidening, kWidening);
  EXPECT_FALSE(solved_for(f, 0));
}

TEST_F(Tolerant, NoSquareProductOrSineIsSolvedFor) {
  EXPECT_FALSE(solved_for(exact({{"1", {{0, 2}}}, {"1", {{1, 1}}}}), 0));
  EXPECT_FALSE(solved_for(exact({{"1", {{0, 1}, {1, 1}}}, {"1", {{1, 1}}}}), 0));
  EXPECT_FALSE(solved_for(exact({{"1", {{0, 1, Function::sine}}}, {"1", {{1, 1}}}}), 0));
  EXPECT_FALSE(solved_for(exact({{"1", {{0, 1}}}, {"1", {{0, 1, Function::sine}}}}), 0));
  EXPECT_TRUE(solved_for(exact({{"1", {{0, 1}}}, {"1", {{1, 1, Function::sine}}}}), 0));
}

TEST_F(Tolerant, SumsCarryTheFactorInTheirEnclosures) {
  const Polynomial f = sum(exact({{"1", {{0, 1}}}}), ExactNumber(-2), wide({{"0.5", {{1, 1}}}}));
  expect(at(f, {{1, 1}}), -1, kWidening);
}

TEST_F(Tolerant, SumsOfLikeTermsAddTheirEnclosures) {
  const Polynomial one_of_two = sum(exact({{"0.5", {{0, 1}}}}), ExactNumber(1), wide({{"0.25", {{0, 1}}}}));
  expect(at(one_of_two, {{0, 1}}), 0.75, 0.25 * kWidening);
  const Polynomial other = sum(wide({{"0.25", {{0, 1}}}}), ExactNumber(1), exact({{"0.5", {{0, 1}}}}));
  expect(at(other, {{0, 1}}), 0.75, 0.25 * kWidening);
  const Polynomial none = sum(wide({{"0.5", {{0, 1}}}}), ExactNumber(-1), exact({{"0.5", {{0, 1}}}}));
  expect(at(none, {{0, 1}}), 0, 0.5 * kWidening);
  EXPECT_EQ(none.monomials.size(), 1u) << "0 for some choices of coefficients only";
  EXPECT_TRUE(sum(exact({{"0.5", {{0, 1}}}}), ExactNumber(-1), exact({{"0.5", {{0, 1}}}})).monomials.empty());
  const Polynomial signs = sum(exact({{"0.5", {{0, 1}}}}), ExactNumber(1), exact({{"0.5", {{0, 1}}}}));
  expect(at(signs, {{0, 1}}), 1, 0);
}

TEST_F(Tolerant, ProductsCarryTheToleranceOfEitherFactor) {
  const Polynomial f = exact({{"0.5", {{0, 2}}}}), g = wide({{"0.5", {{0, 2}}}});
  const Polynomial value = wide({{"0.5", {{1, 1}}}}), plain = exact({{"0.5", {{1, 1}}}, {"1", {}}});
  expect(at(substitute(f, 0, value), {{1, 2}}), 0.125, 2 * 0.125 * kWidening);
  expect(at(substitute(g, 0, plain), {{1, 2}}), 0.125, 0.125 * kWidening);
  expect(at(substitute(g, 0, plain), {{1, 1}}), 0.5, 0.5 * kWidening);
}

TEST_F(Tolerant, PowersOfOneVariableAdd) {
  const Polynomial f = substitute(exact({{"1", {{0, 2}, {1, 3}}}}), 0, exact({{"2", {{1, 2}}}}));
  ASSERT_EQ(f.monomials.size(), 1u);
  EXPECT_EQ(f.monomials[0].factors, (std::vector<Factor>{{1, 7}}));
  EXPECT_EQ(f.monomials[0].coefficient, ExactNumber(4));
}

TEST_F(Tolerant, MultiplesAreSoInEveryTerm) {
  const auto f = exact({{"1", {{0, 2}}}, {"2", {{1, 1}}}, {"3", {}}});
  EXPECT_EQ(proportional(exact({{"2", {{0, 2}}}, {"4", {{1, 1}}}, {"6", {}}}), f), ExactNumber(2));
  EXPECT_FALSE(proportional(exact({{"2", {{0, 2}}}, {"4", {{1, 1}}}, {"5", {}}}), f));
  EXPECT_FALSE(proportional(exact({{"2", {{0, 2}}}, {"5", {{1, 1}}}, {"6", {}}}), f));
  Polynomial g = f, h = exact({{"2", {{0, 2}}}, {"4", {{1, 1}}}, {"6", {}}});
  const ExactNumber root = ExactNumber::apply(ConstantFunction::sqrt, 2),
                    other = ExactNumber::apply(ConstantFunction::sqrt, 3);
  const auto set = [](Polynomial& p, const ExactNumber& c) { p.monomials[1] = Monomial(c, p.monomials[1].factors); };
  set(g, root), set(h, 2 * root);
  EXPECT_EQ(proportional(h, g), ExactNumber(2));
  set(h, 2 * other);
  EXPECT_FALSE(proportional(h, g)) << "√3 is not √2";
  set(h, 3 * root);
  EXPECT_FALSE(proportional(h, g));
}

TEST_F(Tolerant, ValuesOfWavesAreTheirs) {
  const Polynomial f = exact({{"2", {{0, 1, Function::sine}}}, {"1", {{0, 1, Function::cosine}}}});
  EXPECT_TRUE(evaluate(f, {0.0}).contains(1.0));
  EXPECT_LT(evaluate(f, {0.0}).width(), 1e-12);
}

TEST(PolynomialAlgebra, SolvesOnlyForWhatIsLinearWithARationalFactor) {
  const UpwardRounding rounding;
  const auto f = SystemBuilder::polynomial({{"2", {{0, 1}}}, {"-4", {{1, 2}}}, {"3", {{1, 1}, {2, 1}}}, {"6", {}}});
  EXPECT_TRUE(solved_for(f, 0).has_value());
  const auto value = SystemBuilder::polynomial({{"2", {{1, 2}}}, {"-3/2", {{1, 1}, {2, 1}}}, {"-3", {}}});
  EXPECT_TRUE(sum(*solved_for(f, 0), -1, value).monomials.empty());
  EXPECT_FALSE(solved_for(f, 1).has_value());
  EXPECT_FALSE(solved_for(f, 2).has_value());
  EXPECT_FALSE(solved_for(f, 3).has_value());
}

TEST(PolynomialAlgebra, CallsMultiplesProportionalAndNothingElse) {
  const auto f = SystemBuilder::polynomial({{"1", {{0, 2}}}, {"-2", {{1, 1}}}});
  const auto g = SystemBuilder::polynomial({{"1", {{1, 1}}}, {"-1/2", {{0, 2}}}});
  const auto h = SystemBuilder::polynomial({{"1", {{1, 1}}}, {"1/2", {{0, 2}}}});
  EXPECT_TRUE(proportional(f, g));
  EXPECT_FALSE(proportional(f, h));
  EXPECT_FALSE(proportional(f, SystemBuilder::polynomial({{"1", {{0, 2}}}})));
}

}  // namespace
}  // namespace corank::certify
