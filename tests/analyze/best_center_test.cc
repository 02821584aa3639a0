// Balls of best centres and maps against distances in closed form.
#include "corank/analyze/clearance/best_center.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "corank/analyze/clearance/clearance_map.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/analyze/exact.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

study::Question model(const std::string& name, std::optional<symbolic::SingularitySet> set) {
  study::Model model = study::read_model(std::filesystem::path(CORANK_SOURCE_DIR) / "models" / name);
  return {.model = std::move(model.mechanism), .set = set, .assembly = std::move(model.assembly)};
}

Best best_of(const study::Question& question, const std::vector<NamedRange>& region, double precision = 0.01) {
  solve::Control control;
  return best_center(question, {}, region, {.precision = precision}, {}, control);
}

// Of the arm of models/planar/arm_4r.cuik all links are parallel at an inverse singularity.
double arm_clearance(double x, double y) {
  double least = 1e9;
  for (int k = 0; k < 8; ++k) {
    const double radius = std::fabs(1 + (k & 1 ? 0.8 : -0.8) + (k & 2 ? 0.6 : -0.6) + (k & 4 ? 0.5 : -0.5));
    least = std::min(least, std::fabs(std::hypot(x, y) - radius));
  }
  return least;
}
// Of models/planar/five_bar_three_motors.cuik: an arm stretched or folded.
double five_bar_clearance(double x, double y) {
  const double left = std::hypot(x, y), right = std::hypot(x - 1.18, y);
  return std::min({left, 1.8 - left, right - 0.1, 1.7 - right});
}

TEST(Clearance, OfRedundantRobotsIsThatOfTheirClosedForms) {
  const struct {
    const char *file, *x, *y;
    double (*truth)(double, double);
  } robots[] = {{"planar/arm_4r.cuik", "P_x", "P_y", arm_clearance},
                {"planar/five_bar_three_motors.cuik", "J3_x", "J3_y", five_bar_clearance}};
  std::mt19937 random(11);
  std::uniform_int_distribution<int> place(0, 64);
  for (const auto& [file, x, y, truth] : robots) {
    for (int k = 0; k < 4; ++k) {
      const double at_x = 0.3 + place(random) / 128.0, at_y = 0.5 + place(random) / 128.0, distance = truth(at_x, at_y);
      if (!test::long_run() && k > 0) continue;  // of each robot one
      ASSERT_GT(distance, 0);
      solve::Control control;
      const Clearance c =
          clearance(model(file, symbolic::SingularitySet::inverse),
                    {.at = {{x, number(at_x)}, {y, number(at_y)}}, .in = {x, y}}, {.precision = 0.02}, {}, control);
      SCOPED_TRACE(testing::Message() << file << " " << at_x << " " << at_y);
      EXPECT_EQ(c.center, Clearance::Center::assembled);
      ASSERT_TRUE(c.nearest.complete && c.nearest.upper);
      EXPECT_LE(c.nearest.lower, distance);
      EXPECT_GE(*c.nearest.upper, distance * (1 - 1e-9));
    }
    solve::Control control;
    const Clearance none = clearance(model(file, symbolic::SingularitySet::forward),
                                     {.at = {{x, "0.5"}, {y, "1"}}, .in = {x, y}}, {}, {}, control);
    EXPECT_TRUE(none.nearest.empty) << "no forward singularities, as the model says";
  }
}

// Circles that the test plants in the plane: the best centre is that of a fine grid.
TEST(BestCenter, OfPlantedCirclesIsThatOfAFineGrid) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> place(-64, 64);
  for (int k = 0; k < 6; ++k) {
    const double cx = place(random) / 64.0, cy = place(random) / 64.0, r = 0.25 + (64 + place(random)) / 128.0;
    const std::string text = "[SYSTEM VARS]\nx : [-4, 4]\ny : [-4, 4]\n[SYSTEM EQS]\n(x - (" + std::to_string(cx) +
                             "))^2 + (y - (" + std::to_string(cy) + "))^2 = (" + std::to_string(r) + ")^2;\n";
    const study::Question circle{.model = symbolic::parse_model(text, "circle")};
    const double lo = place(random) / 64.0 - 1, hi = lo + 1.5;
    double most = 0;
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 200; ++j)
        most = std::max(most, std::fabs(std::hypot(lo + 1.5 * i / 200 - cx, lo + 1.5 * j / 200 - cy) - r));
    const Best best = best_of(circle, {{"x", number(lo), number(hi)}, {"y", number(lo), number(hi)}});
    SCOPED_TRACE(testing::Message() << text << lo);
    ASSERT_TRUE(best.complete && best.upper);
    EXPECT_GE(*best.upper, most);
    EXPECT_LE(best.lower, most + 0.011) << "the grid's fineness";
    EXPECT_GE(best.lower, 0.99 * *best.upper * (1 - 1e-12));
    ASSERT_EQ(best.center.size(), 2u);
    EXPECT_LE(best.lower, std::fabs(std::hypot(best.center[0] - cx, best.center[1] - cy) - r)) << "its ball is free";
  }
}

TEST(BestCenter, IsOneThatTheRobotReaches) {
  const study::Question dextar = model("dextar.cuik", symbolic::SingularitySet::inverse);
  // Beyond the reach of the left arm there is room without singularities, but no configuration.
  const Best outside = best_of(dextar, {{"J3x", "-1.7", "-1.5"}, {"J3y", "-0.1", "0.1"}});
  EXPECT_TRUE(outside.unassembled);
  EXPECT_TRUE(outside.center.empty());
  const Best inside = best_of(dextar, {{"J3x", "0.4", "0.8"}, {"J3y", "0.3", "0.9"}}, 0.05);
  ASSERT_TRUE(inside.complete && inside.upper && inside.center.size() == 2);
  double most = 0;
  for (int i = 0; i <= 100; ++i)
    for (int j = 0; j <= 100; ++j) {
      const double x = 0.4 + 0.4 * i / 100, y = 0.3 + 0.6 * j / 100, a = std::hypot(x, y), b = std::hypot(x - 1.18, y);
      most = std::max(most, std::min({a, b, 1.8 - a, 1.8 - b}));
    }
  EXPECT_GE(*inside.upper, most);
  EXPECT_LE(inside.lower, most + 0.01);
}

TEST(ClearanceMap, BoundsEveryPointOfItsCells) {
  solve::Control control;
  const ClearanceMap map =
      clearance_map(model("dextar.cuik", symbolic::SingularitySet::inverse), {},
                    {{"J3x", "-1.7", "0.9"}, {"J3y", "-0.3", "1.9"}}, {.grid = 7, .precision = 0.02}, {}, control);
  ASSERT_TRUE(map.complete);
  ASSERT_EQ(map.cells.size(), 49u);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0, 1);
  int nowhere = 0, assembled = 0;
  for (const MapCell& c : map.cells) {
    nowhere += c.robot == MapCell::Robot::nowhere;
    assembled += c.robot == MapCell::Robot::assembled;
    for (int k = 0; k < 50; ++k) {
      const double x = c.sides[0].lo() + share(random) * c.sides[0].width(),
                   y = c.sides[1].lo() + share(random) * c.sides[1].width();
      const double a = std::hypot(x, y), b = std::hypot(x - 1.18, y);
      if (a > 1.8 || b > 1.8) continue;
      EXPECT_NE(c.robot, MapCell::Robot::nowhere) << x << " " << y;
      const double truth = std::min({a, b, 1.8 - a, 1.8 - b});
      EXPECT_LE(c.cell_lower, truth);
      ASSERT_TRUE(c.cell_upper);
      // The nearest singularities of the arcs that the other arm reaches may be farther away than the whole circle.
      EXPECT_GE(*c.cell_upper, truth);
    }
  }
  EXPECT_GT(nowhere, 0);
  EXPECT_GT(assembled, 0);
}

}  // namespace
}  // namespace corank::analyze
