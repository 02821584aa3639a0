// What a trial predicts, against what the search then does.
#include <gtest/gtest.h>

#include "corank/solve/search/estimate.h"
#include "corank/tests/solve/same_cover.h"

namespace corank::solve {
namespace {

CostEstimate estimate_of(const System& system, double sigma, double seconds, std::uint32_t seed) {
  Options options;
  options.sigma = sigma;
  Control control;
  const Prepared prepared = prepared_with(system, options);
  return estimate(prepared, control, seconds, seed);
}

TEST(Estimate, IsWithinAFactorOfTwoOfTheBoxesOfASurfaceAndACurve) {
  for (const auto& [system, sigma] : {std::pair{torus().system(), 0.05}, {torus().system(), 0.3}, {lemniscate(), 0.01}}) {
    const Cover cover = solve_with(system, sigma);
    const CostEstimate cost = estimate_of(system, sigma, 1, 1);
    const auto boxes = static_cast<double>(cover.boxes.size());
    EXPECT_GT(cost.boxes.likely, boxes / 2);
    EXPECT_LT(cost.boxes.likely, boxes * 2);
    EXPECT_LE(cost.boxes.low, cost.boxes.likely);
    EXPECT_GE(cost.boxes.high, cost.boxes.likely);
    EXPECT_GT(cost.file.likely, boxes * 16);
    EXPECT_GT(cost.memory.likely, boxes * 16);
  }
}

TEST(Estimate, OfAWholeTreeIsItsSize) {
  const CostEstimate cost = estimate_of(torus().system(), 0.5, 1e6, 1);
  ASSERT_TRUE(cost.whole_tree);
  EXPECT_EQ(cost.processed.likely, static_cast<double>(solve_with(torus().system(), 0.5).statistics.processed));
  EXPECT_EQ(cost.processed.low, cost.processed.high);
}

// Four free values, 2 to a side, and y = 1000 (a + b + c + d): it takes 40,000 cells along y, and about 40 along each of
// three others.
TEST(Estimate, CutsNoSheetInFullWhoseImagesAreFiner) {
  SystemBuilder b;
  std::vector<SystemBuilder::Term> sum;
  for (const char* name : {"a", "b", "c", "d"}) sum.push_back({"1000", {{b.variable(name, "-1", "1"), 1}}});
  sum.push_back({"-1", {{b.variable("y", "-5000", "5000"), 1}}});
  b.equation(sum);
  const CostEstimate cost = estimate_of(b.system(), 0.2, 1, 1);
  EXPECT_GT(cost.boxes.likely, 1e8);
  EXPECT_LT(cost.boxes.likely, 1e11);
  EXPECT_LT(cost.trial_seconds, 60) << "it is no search";
}

// The estimator is unbiased: however few boxes stand for a level, the mean of many trials is the size of the tree.
TEST(Estimate, OfAFewBoxesALevelIsTheTreeOnTheAverage) {
  const auto real = static_cast<double>(solve_with(torus().system(), 0.5).statistics.processed);
  double sum = 0;
  constexpr int kSeeds = 40;
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    const CostEstimate cost = estimate_of(torus().system(), 0.5, 0, seed);
    EXPECT_FALSE(cost.whole_tree);
    sum += cost.processed.likely;
  }
  EXPECT_NEAR(sum / kSeeds / real, 1, 0.1);
}

}  // namespace
}  // namespace corank::solve
