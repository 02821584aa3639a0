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

}  // namespace
}  // namespace corank::check
