// What only exact arithmetic proves: the three-slider's degenerate points, Dextar's configurations with a kernel of
// dimension 2.
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "corank/certify/algebraic_number.h"
#include "corank/certify/exact_verification.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/system_builder.h"

namespace corank {
namespace {
using symbolic::KernelSide;
using symbolic::SingularitySet;

System system_of_file(const std::string& model_file, SingularitySet set, const std::string& constant = "",
                      const std::string& value = "", std::optional<KernelSide> side = std::nullopt) {
  auto model = symbolic::read_model(CORANK_SOURCE_DIR "/models/" + model_file);
  if (!constant.empty()) model.set_constant(constant, symbolic::Expression(value.c_str()));
  return symbolic::algebrize(symbolic::singularity_system(model, set, side));
}

Cover proven(const System& system, std::optional<double> sigma = std::nullopt) {
  solve::Options options;
  options.sigma = sigma;
  Cover cover = solve::solve(system, options);
  solve::prove_exactly(system, options, cover);
  return cover;
}

std::string text(const ExactPoint& point, std::size_t variable) {
  return certify::text({point.polynomial, point.lower, point.upper}, point.coordinates[variable]).value_or("?");
}

// "-3/5 0 4/5" of each point that is known exactly.
std::multiset<std::string> exact_configurations(const Cover& cover) {
  std::multiset<std::string> result;
  for (const auto& p : cover.points)
    if (p.point >= 0) {
      const auto& exact = cover.exact_points[static_cast<std::size_t>(p.point)];
      result.insert(text(exact, 0) + " " + text(exact, 1) + " " + text(exact, 2));
    }
  return result;
}

class ExactThreeSlider : public testing::TestWithParam<std::tuple<SingularitySet, KernelSide>> {};

// Reference answers: DESIGN's, from Bohigas2017.
TEST_P(ExactThreeSlider, WithEqualRodsHasSixProvenPoints) {
  const auto [set, side] = GetParam();
  const System system = system_of_file("three_slider.cuik", set, "L2", "1", side);
  const Cover cover = proven(system);
  EXPECT_EQ(cover.boxes.size(), 6u);
  EXPECT_EQ(cover.count(Verdict::isolated), 4u);
  EXPECT_EQ(cover.count(Verdict::exact), 2u);
  EXPECT_EQ(exact_configurations(cover),
            (std::multiset<std::string>{"-1 -1 0", "-1 1 0", "0 0 -1", "0 0 1", "1 -1 0", "1 1 0"}));
  for (const auto& box : cover.boxes) {
    ASSERT_GE(box.point, 0);
    const auto& point = cover.exact_points[static_cast<std::size_t>(box.point)];
    EXPECT_TRUE(certify::verify_exactly(system, point).holds);
    EXPECT_TRUE(certify::PointLocation(point).in(box.box));
    EXPECT_EQ(point.corank, 1);
    // The box of a degenerate point lies where the blow-up has shown it alone.
    if (box.verdict == Verdict::exact) {
      EXPECT_GT(point.sole_within, 0);
      EXPECT_EQ((certify::reach(point, box.box) - ExactNumber::dyadic(point.sole_within)).sign(), -1);
    }
  }
}

TEST_P(ExactThreeSlider, WithDifferentRodsHasItsExactValues) {
  const auto [set, side] = GetParam();
  const Cover cover = proven(system_of_file("three_slider.cuik", set, "L2", "4/5", side));
  std::multiset<std::string> expected{"-1 -4/5 0", "-1 4/5 0", "1 -4/5 0", "1 4/5 0"};
  if (set == SingularitySet::forward)
    for (const char* point : {"-3/5 0 -4/5", "-3/5 0 4/5", "3/5 0 -4/5", "3/5 0 4/5"}) expected.insert(point);
  EXPECT_EQ(exact_configurations(cover), expected);
  EXPECT_EQ(cover.count(Verdict::isolated), expected.size());
  EXPECT_EQ(cover.boxes.size(), expected.size());
}

INSTANTIATE_TEST_SUITE_P(SetsAndKernels, ExactThreeSlider,
                         testing::Combine(testing::Values(SingularitySet::forward, SingularitySet::inverse),
                                          testing::Values(KernelSide::right, KernelSide::left)));

TEST(ExactThreeSlider, WithIrrationalPointsHasSquareRoots) {
  const Cover cover = proven(system_of_file("three_slider.cuik", SingularitySet::forward, "L2", "7/10"));
  EXPECT_TRUE(exact_configurations(cover).contains("-1/10*sqrt(51) 0 7/10"));
}

class ExactDextar : public testing::TestWithParam<double> {};

// Both arms stretched: J3 at distance 1.8 from the ground joints, which are 1.18 apart; so J3x = 0.59, J3y² = 1.8² − 0.59² =
// 2.8919.
TEST_P(ExactDextar, HasNoUndecidedBoxThatNoPointExplains) {
  const System system = system_of_file("dextar.cuik", SingularitySet::inverse);
  const Cover cover = proven(system, GetParam());
  EXPECT_TRUE(cover.complete());
  std::set<std::string> points;
  for (const auto& point : cover.exact_points) {
    EXPECT_EQ(point.corank, 2);
    EXPECT_TRUE(certify::verify_exactly(system, point).holds);
    points.insert(text(point, 0) + ", " + text(point, 1));
  }
  EXPECT_EQ(points, (std::set<std::string>{"59/100, 11/100*sqrt(239)", "59/100, -11/100*sqrt(239)"}));
  for (const auto& box : cover.boxes) {
    if (box.verdict == Verdict::regular || box.verdict == Verdict::boundary) {
      EXPECT_GE(box.kernel_at_most, 1);
      if (box.kernel_at_most == 1) continue;
    } else {
      EXPECT_EQ(box.verdict, Verdict::undecided);
    }
    ASSERT_GE(box.point, 0);  // it may hold a kernel of dimension 2 only because it holds such a point
    EXPECT_TRUE(certify::PointLocation(cover.exact_points[static_cast<std::size_t>(box.point)]).in(box.box));
  }
  EXPECT_LE(cover.count(Verdict::undecided), 4u);
}

INSTANTIATE_TEST_SUITE_P(Sigmas, ExactDextar, testing::Values(0.1, 0.01));

TEST(ExactDextar, HasAKernelOfDimensionOneOnAllOfItsForwardLocus) {
  const Cover cover = proven(system_of_file("dextar.cuik", SingularitySet::forward), 0.1);
  EXPECT_TRUE(cover.exact_points.empty());
  for (const auto& box : cover.boxes) EXPECT_EQ(box.kernel_at_most, 1);
}

TEST(ProveExactly, FindsNumbersOfDegreeFour) {
  test::SystemBuilder b;  // √2 and √3
  const int x = b.variable("x", "0", "2"), y = b.variable("y", "0", "2");
  b.equation({{"1", {{x, 2}}}, {"-2", {}}}).equation({{"1", {{y, 2}}}, {"-3", {}}});
  const Cover cover = proven(b.system());
  ASSERT_EQ(cover.exact_points.size(), 1u);
  EXPECT_EQ(cover.exact_points[0].polynomial.size(), 5u);
  EXPECT_TRUE(certify::verify_exactly(b.system(), cover.exact_points[0]).holds);
}

TEST(ProveExactly, FindsATangencyOfCircles) {
  // x² + y² = 1 and (x − 2)² + y² = 1 touch in (1, 0) alone; with the radius 101/100 they meet twice.
  for (const bool tangent : {true, false}) {
    test::SystemBuilder b;
    const int x = b.variable("x", "-3", "3"), y = b.variable("y", "-3", "3");
    b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
    b.equation({{"1", {{x, 2}}}, {"-4", {{x, 1}}}, {"1", {{y, 2}}}, {tangent ? "3" : "29799/10000", {}}});
    const Cover cover = proven(b.system());
    EXPECT_EQ(cover.count(Verdict::exact), tangent ? 1u : 0u);
    EXPECT_EQ(cover.count(Verdict::isolated), tangent ? 0u : 2u);
    EXPECT_EQ(cover.boxes.size(), tangent ? 1u : 2u);
  }
}

TEST(ProveExactly, DoesNotCallAPointAloneThatIsNot) {
  // x (x − 10⁻⁷) = 0, in a box of 10⁻⁶: two solutions; twice each, so that no interval test decides them.
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1");
  b.equation({{"1", {{x, 4}}}, {"-2e-7", {{x, 3}}}, {"1e-14", {{x, 2}}}});
  const Cover cover = proven(b.system());
  for (const auto& box : cover.boxes) {
    const bool holds_both = box.box[0].contains(0.0) && box.box[0].contains(1e-7);
    if (holds_both) {
      EXPECT_EQ(box.verdict, Verdict::undecided);
    }
  }
}

TEST(ProveExactly, LeavesAContinuumUndecided) {
  // (x² + y² − 1)² = 0 twice: a circle that looks like points.
  test::SystemBuilder b;
  const int x = b.variable("x", "1/2", "1"), y = b.variable("y", "0", "1/100");
  b.equation({{"1", {{x, 4}}}, {"2", {{x, 2}, {y, 2}}}, {"1", {{y, 4}}}, {"-2", {{x, 2}}}, {"-2", {{y, 2}}}, {"1", {}}});
  b.equation({{"1", {{x, 5}}},
              {"2", {{x, 3}, {y, 2}}},
              {"1", {{x, 1}, {y, 4}}},
              {"-2", {{x, 3}}},
              {"-2", {{x, 1}, {y, 2}}},
              {"1", {{x, 1}}}});
  const Cover cover = proven(b.system(), 1e-2);
  EXPECT_EQ(cover.count(Verdict::exact), 0u);
  EXPECT_EQ(cover.count(Verdict::isolated), 0u);
  EXPECT_GT(cover.count(Verdict::undecided), 0u);
}

TEST(ProveExactly, SurvivesEquationsWhoseSquaresAreNoDoubles) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
  b.equation({{"1e200", {{x, 1}}}, {"1e200", {{y, 1}}}, {"-2e200", {}}});
  b.equation({{"1e200", {{x, 1}}}, {"-1e200", {{y, 1}}}});
  b.equation({{"1", {{z, 2}}}, {"-2", {{z, 1}}}, {"1", {}}});
  const Cover cover = proven(b.system());
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.points.size(), 1u);
}

// x² = 0 and two boxes that hold its solution, each an undecided point.
struct TwiceZero {
  TwiceZero() {
    const int x = builder.variable("x", "-1", "1");
    builder.equation({{"1", {{x, 2}}}});
    for (const Interval& side : {Interval(-1e-7, 1e-7), Interval(0, 2e-7)})
      cover.boxes.push_back({{side}, Verdict::undecided, {}});
    cover.points = cover.boxes;
    cover.sigma = {1e-6, 1e-6};
  }
  test::SystemBuilder builder;
  Cover cover;
};

TEST(ProveExactly, CountsASolutionOnceThatTwoClustersHold) {
  TwiceZero zero;
  solve::prove_exactly(zero.builder.system(), {}, zero.cover);
  EXPECT_EQ(zero.cover.points.size(), 1u);
  EXPECT_EQ(zero.cover.boxes.size(), 1u);
  EXPECT_EQ(zero.cover.count(Verdict::exact), 1u);
}

TEST(ProveExactly, TakesNoTimeBeyondTheLimit) {
  TwiceZero zero;
  solve::Options options;
  options.time_limit = 1e-9;
  solve::prove_exactly(zero.builder.system(), options, zero.cover);
  EXPECT_EQ(zero.cover.count(Verdict::undecided), 2u);
  EXPECT_TRUE(zero.cover.exact_points.empty());
}

TEST(ProveDecimals, AreRightToTheLastDigit) {
  test::SystemBuilder b;  // x⁵ − x − 1 = 0, no radicals
  const int x = b.variable("x", "1", "2");
  b.equation({{"1", {{x, 5}}}, {"-1", {{x, 1}}}, {"-1", {}}});
  Cover cover = proven(b.system());
  solve::Control control;
  solve::prove_decimals(solve::prepare(b.system(), {}, control), 60, cover, control);
  ASSERT_EQ(cover.decimals.size(), 1u);
  ASSERT_EQ(cover.decimals[0].size(), 1u);
  // f changes its sign between one unit less and one more.
  const auto value = [](const ExactNumber& t) { return *(pow(t, 5) - t - ExactNumber(1)).sign(); };
  const ExactNumber printed = ExactNumber::rational(cover.decimals[0][0]), unit = pow(ExactNumber(10), -60);
  EXPECT_EQ(cover.decimals[0][0].size(), 62u);
  EXPECT_EQ(value(printed - unit), -1);
  EXPECT_EQ(value(printed + unit), 1);
}

}  // namespace
}  // namespace corank
