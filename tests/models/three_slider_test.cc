// The three-slider mechanism: counts, places and verdicts of its singularities (see models/three_slider.cuik for the
// answers).
#include <gtest/gtest.h>

#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/writing/printer.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/models/given_rates.h"

namespace corank {
namespace {
using symbolic::KernelSide;
using symbolic::SingularitySet;
using Points = std::vector<std::array<double, 3>>;  // (y_A, y_B, x_C)

System three_slider_system(SingularitySet set, const char* l2, std::optional<KernelSide> side = std::nullopt) {
  auto model = symbolic::read_model(CORANK_SOURCE_DIR "/models/three_slider.cuik");
  model.set_constant("L2", symbolic::Expression(l2));
  return symbolic::algebrize(symbolic::singularity_system(model, set, side));
}

Points corners(double a, double b) { return {{a, b, 0}, {a, -b, 0}, {-a, b, 0}, {-a, -b, 0}}; }

// Every expected point is in exactly one point of the cover, with the expected verdict.
void expect_points(const Cover& cover, const Points& isolated, const Points& undecided) {
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.points.size(), isolated.size() + undecided.size());
  EXPECT_EQ(cover.count(Verdict::isolated), isolated.size());
  for (const auto& [expected, verdict] :
       {std::pair(&isolated, Verdict::isolated), std::pair(&undecided, Verdict::undecided)})
    for (const auto& q : *expected) {
      int holding = 0;
      for (const auto& p : cover.points) {
        bool inside = true;
        for (std::size_t j = 0; j < 3; ++j)
          inside = inside && q[j] >= p.box[j].lo() - 1e-12 && q[j] <= p.box[j].hi() + 1e-12;
        if (!inside) continue;
        ++holding;
        EXPECT_EQ(p.verdict, verdict);
        for (std::size_t j = 0; j < 3; ++j) EXPECT_LE(p.box[j].width(), verdict == Verdict::isolated ? 1e-12 : 1e-2);
      }
      EXPECT_EQ(holding, 1) << q[0] << ' ' << q[1] << ' ' << q[2];
    }
}

class ThreeSlider : public testing::TestWithParam<KernelSide> {};

TEST_P(ThreeSlider, WithDifferentRodsHasEightForwardSingularities) {
  Points expected = corners(1, 0.8);
  for (double y : {-0.6, 0.6})
    for (double x : {-0.8, 0.8}) expected.push_back({y, 0, x});
  expect_points(solve::solve(three_slider_system(SingularitySet::forward, "4/5", GetParam())), expected, {});
}

TEST_P(ThreeSlider, WithDifferentRodsHasFourInverseSingularities) {
  expect_points(solve::solve(three_slider_system(SingularitySet::inverse, "4/5", GetParam())), corners(1, 0.8), {});
}

TEST_P(ThreeSlider, WithEqualRodsHasFourSimpleAndTwoDegenerateSingularities) {
  for (SingularitySet set : {SingularitySet::forward, SingularitySet::inverse})
    expect_points(solve::solve(three_slider_system(set, "1", GetParam())), corners(1, 1), {{0, 0, 1}, {0, 0, -1}});
}

INSTANTIATE_TEST_SUITE_P(Kernels, ThreeSlider, testing::Values(KernelSide::right, KernelSide::left));

// v_A, v_C and the rod's rate are one to one: with the rods' rates as unknowns nothing else is singular.
TEST_P(ThreeSlider, WithTheRatesOfItsRodsHasTheSameSingularities) {
  const auto solved = [](SingularitySet set, const char* l2) {
    auto model = test::with_rates("three_slider", test::kRodRates);
    model.set_constant("L2", symbolic::Expression(l2));
    return solve::solve(test::study_system(model, set, GetParam()));
  };
  Points expected = corners(1, 0.8);
  expect_points(solved(SingularitySet::inverse, "4/5"), expected, {});
  for (double y : {-0.6, 0.6})
    for (double x : {-0.8, 0.8}) expected.push_back({y, 0, x});
  expect_points(solved(SingularitySet::forward, "4/5"), expected, {});
  for (SingularitySet set : {SingularitySet::forward, SingularitySet::inverse})
    expect_points(solved(set, "1"), corners(1, 1), {{0, 0, 1}, {0, 0, -1}});
}

TEST(ThreeSlider, WithTheRatesOfItsRodsHasTheSameCrossings) {
  auto model = test::with_rates("three_slider", test::kRodRates);
  EXPECT_TRUE(solve::solve(test::study_system(model, SingularitySet::cspace_singular)).boxes.empty());
  model.set_constant("L2", symbolic::Expression("1"));
  const Cover cover = solve::solve(test::study_system(model, SingularitySet::cspace_singular));
  EXPECT_TRUE(cover.complete());
  const test::CoverLookup lookup(cover);
  for (double x : {-1.0, 1.0}) EXPECT_TRUE(lookup.holds(std::array{0.0, 0.0, x}, 0));
  for (const auto& b : cover.boxes) EXPECT_GT(std::fabs(b.box[2].mid()), 0.99);
}

TEST(ThreeSlider, CspaceOfDifferentRodsIsRegularThroughout) {
  const Cover cover = solve::solve(three_slider_system(SingularitySet::cspace, "4/5"));
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_TRUE(cover.complete());
  EXPECT_GT(cover.count(Verdict::regular), 50u);
  EXPECT_EQ(cover.count(Verdict::regular), cover.boxes.size());
}

TEST(ThreeSlider, CspaceOfEqualRodsIsUndecidedOnlyAroundItsCrossings) {
  const Cover cover = solve::solve(three_slider_system(SingularitySet::cspace, "1"));
  EXPECT_TRUE(cover.complete());
  std::size_t undecided = 0;
  for (const auto& b : cover.boxes) {
    if (b.verdict != Verdict::undecided) continue;
    ++undecided;
    EXPECT_LT(b.box[0].mag(), 0.25) << b.box[0];
    EXPECT_LT(b.box[1].mag(), 0.25) << b.box[1];
    EXPECT_GT(b.box[2].mig(), 0.9) << b.box[2];
  }
  EXPECT_GT(undecided, 0u);
  EXPECT_GT(cover.count(Verdict::regular), 50u);
  // y_A = ±y_B, y_A² + x_C² = 1
  const test::CoverLookup lookup(cover);
  for (int k = 0; k < 1000; ++k) {
    const double angle = 0.0063 * k, y = std::cos(angle), x = std::sin(angle);
    EXPECT_TRUE(lookup.holds(std::array{y, y, x}, 1e-12) && lookup.holds(std::array{y, -y, x}, 1e-12)) << angle;
  }
}

TEST(ThreeSlider, CspaceSingularitiesExistOnlyForEqualRods) {
  EXPECT_TRUE(solve::solve(three_slider_system(SingularitySet::cspace_singular, "4/5")).boxes.empty());
  const Cover cover = solve::solve(three_slider_system(SingularitySet::cspace_singular, "1"));
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.points.size(), 2u);
  const test::CoverLookup lookup(cover);
  EXPECT_TRUE(lookup.holds(std::array{0.0, 0.0, 1.0}, 0) && lookup.holds(std::array{0.0, 0.0, -1.0}, 0));
}

TEST(ThreeSlider, TheAlgebrizedFileGivesTheSamePoints) {
  for (SingularitySet set : {SingularitySet::forward, SingularitySet::inverse})
    for (const char* l2 : {"4/5", "1"}) {
      const auto system = three_slider_system(set, l2);
      const auto again =
          symbolic::algebrize(symbolic::plain_system(symbolic::parse_model(symbolic::to_cuik(system), "derived.cuik")));
      const Cover direct = solve::solve(system), derived = solve::solve(again);
      ASSERT_EQ(direct.points.size(), derived.points.size());
      for (std::size_t k = 0; k < direct.points.size(); ++k) EXPECT_EQ(direct.points[k].box, derived.points[k].box);
    }
}

}  // namespace
}  // namespace corank
