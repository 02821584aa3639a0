// The clearance of all robots within their tolerances: no robot has a singularity in the proven ball, and one has a
// singularity at the upper bound.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "corank/analyze/clearance/clearance.h"
#include "corank/analyze/clearance/tolerance_factor.h"
#include "corank/result/files/verification.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/models/closed_forms.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using Overrides = std::vector<result::ConstantOverride>;

study::Question robot(const std::string& file, const Overrides& constants) {
  study::Model model = study::read_model(std::string(CORANK_SOURCE_DIR "/models/") + file, constants);
  return {.model = std::move(model.mechanism),
          .set = symbolic::SingularitySet::forward,
          .constants = constants,
          .assembly = std::move(model.assembly)};
}

Overrides links(double tolerance) {
  Overrides result;
  for (const auto& [name, value] : {std::pair("l2", "0.9"), {"l3", "0.9"}, {"l4", "0.9"}, {"l5", "0.9"}, {"d", "1.18"}})
    result.push_back({name, std::string(value) + "±" + std::to_string(tolerance)});
  return result;
}

Clearance clearance_for_all(const study::Question& question, const BallOptions& ball, double precision = 1e-3) {
  solve::Control control;
  return clearance(question, ball, {.precision = precision}, {}, control);
}
const BallOptions kBall{.at = {{"J3x", "1/2"}, {"J3y", "1"}}, .in = {"J3x", "J3y"}};

// The distance of a five-bar's singular J3 from the ball's centre, near the nearest one.
double distance(const std::array<double, 5>& bar) {
  const auto [l2, l3, l4, l5, d] = bar;
  double least = HUGE_VAL;
  for (int k = 0; k < 4000; ++k)
    for (const int sign : {-1, 1}) {
      const test::Point j4 = l5 * test::direction(2 * M_PI * k / 4000);
      const auto j2 = test::intersect_circles({d, 0}, l2, j4, l3 + l4, sign);
      if (j2) least = std::min(least, length(j4 + (l4 / (l3 + l4)) * (*j2 - j4) - test::Point{0.5, 1}));
    }
  return least;
}

TEST(ToleratedClearance, OfDextarIsThatOfTheWorstRobot) {
  const double tolerance = 0.005;
  const Clearance c = clearance_for_all(robot("dextar.cuik", links(tolerance)), kBall);
  ASSERT_TRUE(c.nearest.complete && c.nearest.upper);
  EXPECT_GE(c.nearest.lower, 0.999 * *c.nearest.upper * (1 - 1e-12));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> change(-tolerance, tolerance);
  double least = HUGE_VAL;
  for (unsigned k = 0; k < test::seeds(100); ++k) {
    std::array<double, 5> bar{0.9, 0.9, 0.9, 0.9, 1.18};
    for (double& length : bar) {
      const double by = change(random);
      length += k % 2 == 0 ? std::copysign(tolerance, by) : by;
    }
    least = std::min(least, distance(bar));
  }
  EXPECT_GE(least, c.nearest.lower);
  EXPECT_NEAR(least, *c.nearest.upper, 1e-5) << "all 32 corners are among the robots, but for a sampled angle";
  ASSERT_EQ(c.robot.size(), 5u);
  for (const CoordinateValue& v : c.robot)
    EXPECT_NEAR(std::fabs(v.value.mid() - (v.name == "d" ? 1.18 : 0.9)), tolerance, 1e-6) << v.name;
}

TEST(ToleratedClearance, FallsAsTheTolerancesGrowAndAsFarAsToFirstOrder) {
  const std::array<double, 5> nominal{0.9, 0.9, 0.9, 0.9, 1.18};
  double slope = 0;
  for (std::size_t k = 0; k < nominal.size(); ++k) {
    std::array<double, 5> more = nominal, less = nominal;
    more[k] += 1e-3, less[k] -= 1e-3;
    slope += std::fabs(distance(more) - distance(less)) / 2e-3;
  }
  const double exact = distance(nominal);
  for (const double tolerance : {0.0005, 0.001, 0.002, 0.004}) {
    const Clearance c = clearance_for_all(robot("dextar.cuik", links(tolerance)), kBall, 1e-5);
    EXPECT_GT(exact - c.nearest.lower, 0.9 * slope * tolerance) << tolerance;
    EXPECT_LT(exact - c.nearest.lower, 1.1 * slope * tolerance) << tolerance;
  }
}

TEST(ToleratedClearance, HasItsCertificates) {
  const Clearance c = clearance_for_all(robot("dextar.cuik", links(0.002)), kBall, 0.01);
  solve::Control control;
  const result::Result free = claim_free(c, {}, control);
  EXPECT_TRUE(free.cover.boxes.empty());
  EXPECT_TRUE(result::verify(free).complete());
  const auto nearest = claim_nearest(c, control);
  ASSERT_TRUE(nearest);
  EXPECT_TRUE(result::verify(*nearest).verified());
  Clearance wrong = c;
  wrong.nearest.lower = 1.02 * *c.nearest.upper;
  EXPECT_FALSE(claim_free(wrong, {}, control).cover.boxes.empty());
}

TEST(ToleratedClearance, OfARobotFromPartsHoldsForEachRobot) {
  const BallOptions ball{.at = {{"pose_x", "4/5"}, {"pose_y", "1/2"}, {"pose_phi", "1/10"}}, .in = {"pose_x", "pose_y"}};
  const std::vector<std::pair<std::string, double>> constants{{"bx", 2}, {"cx", 0.8}, {"cy", 1.5}, {"px", 1}};
  const double tolerance = 0.01;
  const auto with = [&](const auto& text_of) {
    Overrides overrides;
    for (const auto& [name, value] : constants) overrides.push_back({name, text_of(value)});
    return clearance_for_all(robot("planar/3rpr.cuik", overrides), ball, 0.005);
  };
  const Clearance all = with([&](double v) { return std::to_string(v) + " ± " + std::to_string(tolerance); });
  ASSERT_TRUE(all.nearest.complete && all.nearest.upper);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> change(-tolerance, tolerance);
  for (unsigned k = 0; k < test::seeds(3); ++k) {
    const Clearance one = with([&](double v) { return std::to_string(v + change(random)); });
    EXPECT_GE(*one.nearest.upper, all.nearest.lower);
    EXPECT_LT(all.nearest.lower, one.nearest.lower) << "another robot is worse";
  }
}

// For each of 10,000 robots the three legs' lines neither meet in a point nor are parallel anywhere in the ball: their
// moments about a point and directions are independent, with one sign of the determinant.
TEST(ToleratedClearance, OfAPlanarPlatformIsFreeOfEveryRobotsSingularities) {
  const double tolerance = 0.01;
  Overrides overrides;
  const std::array<std::pair<const char*, double>, 6> constants{
      {{"bx", 2}, {"cx", 0.8}, {"cy", 1.5}, {"px", 1}, {"qx", 0.6}, {"qy", 0.4}}};
  for (const auto& [name, value] : constants)
    overrides.push_back({name, std::to_string(value) + " ± " + std::to_string(tolerance)});
  const BallOptions ball{.at = {{"pose_x", "4/5"}, {"pose_y", "1/2"}, {"pose_phi", "1/10"}}, .in = {"pose_x", "pose_y"}};
  const Clearance c = clearance_for_all(robot("planar/3rpr.cuik", overrides), ball, 0.005);
  ASSERT_TRUE(c.nearest.complete && c.nearest.upper);
  const auto determinant = [](const std::array<double, 6>& l, double x, double y) {
    const auto [bx, cx, cy, px, qx, qy] = l;
    const double s = std::sin(0.1), cosine = std::cos(0.1);
    const std::array<test::Point, 3> ground{{{0, 0}, {bx, 0}, {cx, cy}}}, own{{{0, 0}, {px, 0}, {qx, qy}}};
    std::array<std::array<double, 3>, 3> rows{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double u = cosine * own[i].x - s * own[i].y, v = s * own[i].x + cosine * own[i].y;
      const double ex = x + u - ground[i].x, ey = y + v - ground[i].y;
      rows[i] = {ex, ey, u * ey - v * ex};
    }
    const auto& [a, b, d] = rows;
    return a[0] * (b[1] * d[2] - b[2] * d[1]) - a[1] * (b[0] * d[2] - b[2] * d[0]) + a[2] * (b[0] * d[1] - b[1] * d[0]);
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> change(-tolerance, tolerance);
  int changed = 0, beyond = 0;
  const double inside = c.nearest.lower * (1 - 1e-9), outside = *c.nearest.upper * 1.02;
  for (int k = 0; k < 10'000; ++k) {
    std::array<double, 6> l{};
    for (std::size_t i = 0; i < l.size(); ++i) {
      const double by = change(random);
      l[i] = constants[i].second + (k % 2 == 0 ? std::copysign(tolerance, by) : by);
    }
    const double at_centre = determinant(l, 0.8, 0.5);
    const auto differs = [&](double radius, double angle) {
      return determinant(l, 0.8 + radius * std::cos(angle), 0.5 + radius * std::sin(angle)) * at_centre <= 0;
    };
    bool farther = false;
    for (int a = 0; a < 90; ++a) {
      const double angle = 2 * M_PI * (a + 0.5) / 90;
      changed += differs(inside, angle) + differs(inside * std::sqrt((a + 0.5) / 90), 7 * angle);
      farther = farther || differs(outside, angle);
    }
    beyond += farther;
  }
  EXPECT_EQ(changed, 0);
  EXPECT_GT(beyond, 0) << "the worst robots have a singularity just outside";
}

// The clearance at the factor is the radius, from both sides.
TEST(ToleranceFactor, IsWhereTheWorstRobotJustKeepsTheRadius) {
  for (const double radius : {0.15, 0.159}) {
    solve::Control control;
    const ToleranceFactor f =
        tolerance_factor(robot("dextar.cuik", links(0.001)), kBall, {.radius = radius, .precision = 0.1}, {}, control);
    ASSERT_TRUE(f.complete() && f.upper) << f.reason;
    EXPECT_LE(*f.upper, f.lower * 1.1 * (1 + 1e-12));
    EXPECT_EQ(f.robot.size(), 5u);
    EXPECT_GE(clearance_for_all(robot("dextar.cuik", links(0.001 * f.lower)), kBall).nearest.upper, radius);
    EXPECT_LT(clearance_for_all(robot("dextar.cuik", links(0.001 * *f.upper)), kBall).nearest.lower, radius);
    const auto of = [&](const char* name) { return std::ranges::find(f.robot, name, &CoordinateValue::name)->value.mid(); };
    EXPECT_LT(distance({of("l2"), of("l3"), of("l4"), of("l5"), of("d")}), radius + 1e-5);
    for (const CoordinateValue& t : f.tolerances)
      EXPECT_NEAR(t.value.width(), 0.002 * f.lower, 1e-9) << t.name << ", nested about its nominal value";
  }
}

// A point is held by two legs. Where d is less than 5 + √7, the second one would be shorter at the centre, (5, 3), than its
// limit: no singularity shows that.
TEST(ToleranceFactor, IsSoughtAlsoBelowAFactorThatIsLeftOpen) {
  const study::Question legs{
      .model = symbolic::parse_model("[CONSTANTS]\nd := 10 ± 0.1\n[SYSTEM VARS]\nx : [-20, 20]\ny : [-20, 20]\n"
                                     "r1 : [1/2, 12]\nr2 : [1/2, 12]\n[SYSTEM EQS]\nx^2 + y^2 = r1^2;\n"
                                     "(x - d)^2 + y^2 = r2^2;\n[INPUTS] r1 r2\n[OUTPUTS] x y\n"
                                     "[LIMITS]\nr1 : [4, 9]\nr2 : [4, 9]\n",
                                     "legs.cuik"),
      .set = symbolic::SingularitySet::forward};
  solve::Control control;
  const BallOptions at{.at = {{"x", "5"}, {"y", "3"}}, .in = {"x", "y"}};
  const ToleranceFactor f = tolerance_factor(legs, at, {.radius = 2.5, .precision = 0.05}, {}, control);
  const double largest = 10 * (5 - std::sqrt(7.0));  // 10 − 0.1 · largest = 5 + √7
  EXPECT_LE(f.lower, largest);
  EXPECT_GE(f.lower, 20);  // 16 is proven, 32 is open
}

TEST(ToleranceFactor, IsZeroWhereTheRobotAsDrawnFallsShort) {
  solve::Control control;
  const study::Question question = robot("dextar.cuik", links(0.001));
  const ToleranceFactor none = tolerance_factor(question, kBall, {.radius = 0.16}, {}, control);
  EXPECT_EQ(none.lower, 0);
  EXPECT_EQ(none.upper, 0.0);
  EXPECT_TRUE(none.complete() && !none.nearest.empty());
  EXPECT_THROW(tolerance_factor(robot("dextar.cuik", {}), kBall, {.radius = 0.1}, {}, control), symbolic::ModelError)
      << "no tolerance";
  EXPECT_THROW(tolerance_factor(question, kBall, {.radius = 0}, {}, control), symbolic::ModelError);
}

TEST(ToleranceFactor, AsksForARadiusWithinTheRangesAndACentreThatEveryRobotReaches) {
  solve::Control control;
  const study::Question question = robot("dextar.cuik", {{"l", "0.9±0.01"}});
  BallOptions near = kBall;
  near.ranges = {{"J3x", "0.45", "0.55"}, {"J3y", "0.95", "1.05"}};
  EXPECT_THROW(tolerance_factor(question, near, {.radius = 0.1}, {}, control), symbolic::ModelError);
  BallOptions far = kBall;  // within reach where l > 0.8246
  far.at = {{"J3x", "1.6"}, {"J3y", "0.4"}};
  const ToleranceFactor f = tolerance_factor(question, far, {.radius = 0.02}, {}, control);
  EXPECT_GT(f.lower, 0);
  EXPECT_LT(0.9 - 0.01 * f.lower, 0.9);
  EXPECT_GT(0.9 - 0.01 * f.lower, 0.8246);
}

TEST(ToleranceFactor, SaysWhatItKnowsWhereALimitEndsIt) {
  solve::Control control({.boxes = 40});
  const ToleranceFactor f =
      tolerance_factor(robot("dextar.cuik", links(0.001)), kBall, {.radius = 0.15, .precision = 1e-6}, {}, control);
  EXPECT_FALSE(f.complete());
  EXPECT_FALSE(f.reason.empty());
}

}  // namespace
}  // namespace corank::analyze
