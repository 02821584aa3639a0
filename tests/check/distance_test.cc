// The checker's own distances, on the bodies that those of certify/ are tried with.
#include "corank/check/distance.h"

#include <gtest/gtest.h>

#include "corank/tests/planted_distance.h"
#include "corank/tests/seeds.h"

namespace corank::check {
namespace {

Standing standing_of_bodies(const Requirement& requirement, const std::vector<test::PlantedRequirement::Entry>& entries,
                            double width) {
  const auto form = [&](int variable) {
    const test::PlantedRequirement::Entry& e = entries[variable];
    return Form{Enclosure(e.constant) + Enclosure(-e.rest, e.rest), {e.slopes[0], e.slopes[1]}};
  };
  return standing(requirement, form, {Enclosure(-width, width), Enclosure(-width, width)});
}

TEST(CheckedDistance, IsNeverClaimedAgainstASample) {
  const test::PlantedCount count = test::count_planted<test::PlantedDistance>(
      test::seeds(20) * 20, 20, [](const auto& p) { return standing_of_bodies(p.requirement, p.entries, p.width); });
  EXPECT_EQ(count.contradicted, 0);
  const int all = count.satisfied + count.violated + count.open;
  EXPECT_GT(count.satisfied, all / 4) << "of " << all;
  EXPECT_GT(count.violated, all / 4) << "of " << all;
}

TEST(CheckedDistance, IsSharpToSecondOrder) {
  const std::vector<test::DistanceCase> cases = test::distance_cases();
  for (std::size_t k = 0; k < cases.size(); ++k)
    EXPECT_EQ(standing_of_bodies(cases[k].requirement(), cases[k].entries(), cases[k].width), cases[k].expected) << k;
}

}  // namespace
}  // namespace corank::check
