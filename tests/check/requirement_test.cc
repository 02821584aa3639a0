// The checker's own requirements, on the matrices that those of certify/ are tried with.
#include "corank/check/requirement.h"

#include <gtest/gtest.h>

#include "corank/tests/planted_requirement.h"
#include "corank/tests/seeds.h"

namespace corank::check {
namespace {

Standing standing_of(const Requirement& requirement, const std::vector<test::PlantedRequirement::Entry>& entries,
                     double width) {
  const auto form = [&](int variable) {
    const test::PlantedRequirement::Entry& e = entries[variable];
    return Form{Enclosure(e.constant) + Enclosure(-e.rest, e.rest), {e.slopes[0], e.slopes[1]}};
  };
  return standing(requirement, form, {Enclosure(-width, width), Enclosure(-width, width)});
}

TEST(CheckedRequirement, IsNeverClaimedAgainstASample) {
  const test::PlantedCount count = test::count_planted<test::PlantedRequirement>(
      test::seeds(20) * 20, 50,
      [](const auto& planted) { return standing_of(planted.requirement, planted.entries, planted.width); });
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

TEST(CheckedRequirement, CountsTermsOfSecondOrder) {
  for (const test::SecondOrderCase& c : test::second_order_cases())
    EXPECT_EQ(standing_of({"", {c.test}}, c.entries, c.width), c.expected) << c.test.columns << " columns, " << c.width;
}

}  // namespace
}  // namespace corank::check
