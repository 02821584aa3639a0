// Distances of bodies of affine forms: no claim that a random place of them contradicts.
#include "corank/certify/distance.h"

#include <gtest/gtest.h>

#include "corank/core/closest_points.h"
#include "corank/core/rounding.h"
#include "corank/tests/planted_distance.h"
#include "corank/tests/seeds.h"

namespace corank::certify {
namespace {

Standing standing_of_bodies(const Requirement& requirement, const std::vector<test::PlantedRequirement::Entry>& entries,
                            double width) {
  const UpwardRounding rounding;
  const auto form = [&](int variable) {
    const test::PlantedRequirement::Entry& e = entries[variable];
    return AffineForm{Interval(e.constant) + Interval(-e.rest, e.rest), {e.slopes[0], e.slopes[1]}};
  };
  return standing(requirement, form, std::vector{Interval(-width, width), Interval(-width, width)});
}

TEST(Distance, IsNeverClaimedAgainstASample) {
  const test::PlantedCount count = test::count_planted<test::PlantedDistance>(
      test::seeds(20) * 30, 20, [](const auto& p) { return standing_of_bodies(p.requirement, p.entries, p.width); });
  EXPECT_EQ(count.contradicted, 0);
  const int all = count.satisfied + count.violated + count.open;
  EXPECT_GT(count.satisfied, all / 4) << "of " << all;
  EXPECT_GT(count.violated, all / 4) << "of " << all;
}

TEST(Distance, IsSharpToSecondOrder) {
  const std::vector<test::DistanceCase> cases = test::distance_cases();
  for (std::size_t k = 0; k < cases.size(); ++k)
    EXPECT_EQ(standing_of_bodies(cases[k].requirement(), cases[k].entries(), cases[k].width), cases[k].expected) << k;
}

TEST(ClosestPoints, AreNearestAmongAllFaces) {
  std::mt19937 random(3);
  const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  for (int round = 0; round < 600; ++round) {
    PointsOfBodies hulls;
    std::array<test::BodyPoints, 2> bodies;
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t k = 0; k < 1 + random() % 4; ++k) {
        hulls[b].push_back({number() + (b == 0 ? 1 : 0), number(), round % 3 == 0 ? 0 : number()});
        bodies[b].emplace_back(hulls[b].back()[0], hulls[b].back()[1], hulls[b].back()[2]);
      }
    const ClosestPoints found = closest_points(hulls);
    Eigen::Vector3d difference = Eigen::Vector3d::Zero();
    for (std::size_t b = 0; b < 2; ++b) {
      double sum = 0;
      for (std::size_t k = 0; k < bodies[b].size(); ++k) {
        EXPECT_GE(found.weights[b][k], 0);
        sum += found.weights[b][k];
        difference += (b == 0 ? found.weights[b][k] : -found.weights[b][k]) * bodies[b][k];
      }
      EXPECT_NEAR(sum, 1, 1e-9);
    }
    EXPECT_NEAR(difference.norm(), test::distance_of_hulls(bodies[0], bodies[1]), 1e-6);
  }
}

}  // namespace
}  // namespace corank::certify
