// Requirements on matrices of affine forms: no claim that a random matrix within them contradicts.
#include "corank/certify/requirement.h"

#include <gtest/gtest.h>

#include "corank/core/rounding.h"
#include "corank/tests/planted_requirement.h"
#include "corank/tests/seeds.h"

namespace corank::certify {
namespace {

std::vector<Interval> offsets(double width) { return {Interval(-width, width), Interval(-width, width)}; }

Standing standing_of(const Requirement& requirement, const std::vector<test::PlantedRequirement::Entry>& entries,
                     double width) {
  const UpwardRounding rounding;
  const auto form = [&](int variable) {
    const test::PlantedRequirement::Entry& e = entries[variable];
    return AffineForm{Interval(e.constant) + Interval(-e.rest, e.rest), {e.slopes[0], e.slopes[1]}};
  };
  return standing(requirement, form, offsets(width));
}

TEST(Requirement, IsNeverClaimedAgainstASample) {
  const test::PlantedCount count = test::count_planted<test::PlantedRequirement>(
      test::seeds(20) * 100, 50,
      [](const auto& planted) { return standing_of(planted.requirement, planted.entries, planted.width); });
  EXPECT_EQ(count.contradicted, 0);
  const int all = count.satisfied + count.violated + count.open;
  EXPECT_GT(count.satisfied, all / 20) << "of " << all;
  EXPECT_GT(count.violated, all / 4);
}

TEST(Requirement, OfAFunctionIsItsSign) {
  const UpwardRounding rounding;
  Requirement r;
  r.excess = 0;
  const auto of = [&](double constant) {
    const auto form = [&](int) { return AffineForm{constant, {1.0, 0.0}}; };
    return standing(r, form, offsets(0.5));
  };
  EXPECT_EQ(of(-0.5), Standing::satisfied) << "0 is at most 0";
  EXPECT_EQ(of(-0.4), Standing::open);
  EXPECT_EQ(of(0.4), Standing::open);
  EXPECT_EQ(of(0.5), Standing::open);
  EXPECT_EQ(of(0.6), Standing::violated);
}

// x − δ1 y = 0 and the form 4 y² − x²: positive where |δ1| < 2.
TEST(Requirement, KeepsWhatCancelsToFirstOrder) {
  const UpwardRounding rounding;
  Requirement r;
  r.tests.push_back({2, {{-1, 1}, {0, {}}}, {-1, 4}, {}, {}});
  const auto of = [&](double lower, double upper) {
    const double middle = (lower + upper) / 2;
    const auto form = [&](int) { return AffineForm{-middle, {-1.0}}; };
    return standing(r, form, std::vector{Interval(lower - middle, upper - middle)});
  };
  EXPECT_EQ(of(-1.9, 1.9), Standing::satisfied);
  EXPECT_EQ(of(1.6, 1.9), Standing::satisfied);
  EXPECT_EQ(of(1.9, 2.1), Standing::open);
  EXPECT_EQ(of(2.01, 2.5), Standing::violated);
}

TEST(Requirement, CountsTermsOfSecondOrder) {
  for (const test::SecondOrderCase& c : test::second_order_cases())
    EXPECT_EQ(standing_of({"", {c.test}}, c.entries, c.width), c.expected) << c.test.columns << " columns, " << c.width;
}

// A row twice: its kernel is known to be no smaller.
TEST(Requirement, WithADependentRowIsNeverViolated) {
  const UpwardRounding rounding;
  Requirement r;
  r.tests.push_back({2, {{-1, 1}, {0, {}}, {-1, 1}, {0, {}}}, {-1, 4}, {}, {}});
  const auto of = [&](double slope) {
    return standing(
        r,
        [&](int) {
          return AffineForm{-slope, {0.0}};
        },
        std::vector{Interval(0.0)});
  };
  EXPECT_EQ(of(1), Standing::satisfied);
  EXPECT_EQ(of(3), Standing::open);
}

TEST(AffineForm, HoldsSumsAndProducts) {
  const UpwardRounding rounding;
  std::mt19937 random(7);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  for (int round = 0; round < 200; ++round) {
    const std::vector sides{Interval(-number(0, 1), number(0, 1)), Interval(-number(0, 1), number(0, 1))};
    double c[2], a[2][2], f[2];
    const double at[2] = {number(sides[0].lo(), sides[0].hi()), number(sides[1].lo(), sides[1].hi())};
    AffineForm form[2];
    for (int k = 0; k < 2; ++k) {
      c[k] = number(-2, 2);
      f[k] = c[k];
      form[k].constant = c[k];
      for (int j = 0; j < 2; ++j) {
        a[k][j] = number(-2, 2);
        f[k] += a[k][j] * at[j];
        form[k].slopes.emplace_back(a[k][j]);
      }
    }
    const auto holds = [](const Interval& range, double x) { return range.lo() <= x + 1e-12 && x - 1e-12 <= range.hi(); };
    EXPECT_TRUE(holds(product(form[0], form[1], sides).range(sides), f[0] * f[1]));
    form[0].add(-3.0, form[1]);
    EXPECT_TRUE(holds(form[0].range(sides), f[0] - 3 * f[1]));
    form[1].add(-1.0, form[1]);
    EXPECT_TRUE(form[1].range(sides) == Interval(0.0)) << "what cancels does";
  }
}

}  // namespace
}  // namespace corank::certify
