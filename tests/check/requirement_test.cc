// The checker's own requirements, on the matrices that those of certify/ are tried with.
#include "corank/check/requirement.h"

#include <gtest/gtest.h>

#include "corank/tests/planted_requirement.h"
#include "corank/tests/seeds.h"

namespace corank::check {
namespace {

Standing standing_of(const test::PlantedRequirement& planted) {
  const auto form = [&](int variable) {
    const test::PlantedRequirement::Entry& e = planted.entries[variable];
    return Form{Enclosure(e.constant) + Enclosure(-e.rest, e.rest), {e.slopes[0], e.slopes[1]}};
  };
  return standing(planted.requirement, form, {Enclosure(-planted.width, planted.width), {-planted.width, planted.width}});
}

TEST(CheckedRequirement, IsNeverClaimedAgainstASample) {
  const test::PlantedCount count = test::count_planted(test::seeds(20) * 20, standing_of);
  EXPECT_EQ(count.contradicted, 0);
  const int all = count.satisfied + count.violated + count.open;
  EXPECT_GT(count.satisfied, all / 20) << "of " << all;
  EXPECT_GT(count.violated, all / 4);
}

TEST(CheckedRequirement, OfAFunctionIsItsSign) {
  Requirement r;
  r.excess = 0;
  const auto of = [&](double constant) {
    return standing(r, [&](int) { return Form{constant, {1.0}}; }, {Enclosure(-0.5, 0.5)});
  };
  EXPECT_EQ(of(-0.5), Standing::satisfied);
  EXPECT_EQ(of(0.4), Standing::open);
  EXPECT_EQ(of(0.6), Standing::violated);
}

// What first-order terms alone would wrongly show.
TEST(CheckedRequirement, CountsTermsOfSecondOrder) {
  const auto of = [](const VelocityTest& test, const std::vector<Form>& forms, double width) {
    Requirement r;
    r.tests.push_back(test);
    return standing(r, [&](int k) { return forms[k]; }, {Enclosure(-width, width), Enclosure(-width, width)});
  };
  const Form first{0.0, {1.0, 0.0}}, second{0.0, {0.0, 1.0}}, beside_one{1.0, {1.0, 0.0}};
  // x + δ1 y + δ2 z = 0, y² + z² − x² > 0: not at δ1 = δ2 = 0.8, where the diagonal is positive.
  const VelocityTest form{3, {{-1, 1}, {0, {}}, {1, {}}}, {-1, 1, 1}, {}, {}};
  EXPECT_EQ(of(form, {first, second}, 0.8), Standing::open);
  EXPECT_EQ(of(form, {first, second}, 0.6), Standing::satisfied);
  // x = δ1 w, y = w: ‖(x, y)‖ < 1.05 |w| is √(1 + δ1²) < 1.05.
  const VelocityTest norm{
      3, {{-1, -1}, {-1, 0}, {0, {}}, {-1, 0}, {-1, -1}, {-1, 1}}, {}, {{{0, 1}, 1}}, ExactNumber::rational("1.05")};
  EXPECT_EQ(of(norm, {first}, 0.5), Standing::open);
  EXPECT_EQ(of(norm, {first}, 0.3), Standing::satisfied);
  // (1 + δ1) x = y/2: |x| < 2 |y| is 1/2 < 2 (1 + δ1).
  const VelocityTest slow{2, {{0, {}}, {-1, ExactNumber::rational("-1/2")}}, {-1, 4}, {}, {}};
  EXPECT_EQ(of(slow, {beside_one}, 0.9), Standing::open);
  EXPECT_EQ(of(slow, {beside_one}, 0.5), Standing::satisfied);
}

}  // namespace
}  // namespace corank::check
