// Distances of sets from centres where they are known.
#include "corank/analyze/sets/nearest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "corank/analyze/clearance/clearance.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/analyze/exact.h"

namespace corank::analyze {
namespace {

Clearance nearest_to(const std::string& text, const std::vector<NamedValue>& at, double precision = 0.01,
                     const std::vector<NamedRange>& ranges = {}) {
  study::Question question{.model = symbolic::parse_model(text, "test.cuik")};
  BallOptions ball;
  ball.at = at;
  ball.ranges = ranges;
  for (const NamedValue& v : at) ball.in.push_back(v.name);
  solve::Options search;
  solve::Control control;
  return clearance(question, ball, {.precision = precision}, search, control);
}

void expect_radius(const Clearance& c, double truth, double precision = 0.01) {
  ASSERT_TRUE(c.nearest.upper);
  EXPECT_TRUE(c.nearest.complete);
  EXPECT_LE(c.nearest.lower, truth * (1 + 1e-12));
  EXPECT_GE(*c.nearest.upper, truth * (1 - 1e-12));
  EXPECT_GE(c.nearest.lower, (1 - precision) * *c.nearest.upper * (1 - 1e-12));
}

TEST(Nearest, BoundsTheDistanceOfACircle) {
  const std::string circle = "[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\n[SYSTEM EQS]\nx^2 + y^2 = 4;\n";
  expect_radius(nearest_to(circle, {{"x", "1/2"}, {"y", "1/3"}}), 2 - std::hypot(0.5, 1.0 / 3));
  expect_radius(nearest_to(circle, {{"x", "2"}, {"y", "2"}}, 1e-4), 2 * std::sqrt(2) - 2, 1e-4);
}

TEST(Nearest, BoundsTheDistanceOfACircleFromItsCentreWhereAllPointsAreNearest) {
  const std::string circle = "[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\n[SYSTEM EQS]\nx^2 + y^2 = 4;\n";
  expect_radius(nearest_to(circle, {{"x", 0}, {"y", 0}}), 2);
}

TEST(Nearest, LeavesOutWhatTheRangesForbid) {
  const std::string circle = "[SYSTEM VARS]\nx : [-3, 1]\ny : [-3, 3]\n[SYSTEM EQS]\nx^2 + y^2 = 4;\n";
  const double end = std::hypot(0.75, std::sqrt(3));  // the point (1, √3) from (1/4, 0)
  expect_radius(nearest_to(circle, {{"x", "1/4"}, {"y", 0}}), end);
}

TEST(Nearest, MeasuresOnlyTheCoordinatesOfTheBall) {
  // A plane through the z-axis' point 5: in x alone its distance is 0.
  const std::string plane = "[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\nz : [-9, 9]\n[SYSTEM EQS]\nx + y + z = 5;\n";
  const Clearance flat = nearest_to(plane, {{"x", 0}, {"y", 0}});
  ASSERT_TRUE(flat.nearest.upper);
  EXPECT_EQ(flat.nearest.lower, 0);
  EXPECT_LT(*flat.nearest.upper, 1e-3);
  expect_radius(nearest_to(plane, {{"x", 0}, {"y", 0}, {"z", 0}}), 5 / std::sqrt(3));
}

TEST(Nearest, CountsAnAngleTheShorterWayRound) {
  // cos θ = cos 3, so θ = ±3: from −2.9 the nearer one is −3, from 3.1 the angle 3 at 0.1 and −3 at 2π − 6.1.
  const std::string angle = "[SYSTEM VARS]\ntheta ~ [-pi, pi]\nx : [-1, 1]\n[SYSTEM EQS]\nx = cos(theta);\nx = cos(3);\n";
  expect_radius(nearest_to(angle, {{"theta", "-2.9"}}), 0.1);
  expect_radius(nearest_to(angle, {{"theta", "3.1"}}), 0.1);
  expect_radius(nearest_to(angle, {{"theta", "pi"}}), M_PI - 3);
  const std::string low = "[SYSTEM VARS]\ntheta ~ [-pi, 0]\nx : [-1, 1]\n[SYSTEM EQS]\nx = cos(theta);\nx = cos(3);\n";
  expect_radius(nearest_to(low, {{"theta", "-0.5"}}), 2.5);
}

TEST(Nearest, ProvesThatThereIsNothingAtAll) {
  const Clearance none =
      nearest_to("[SYSTEM VARS]\nx : [-1, 1]\ny : [-1, 1]\n[SYSTEM EQS]\nx^2 + y^2 = 4;\n", {{"x", "1/2"}, {"y", 0}});
  EXPECT_TRUE(none.nearest.empty);
  EXPECT_TRUE(none.nearest.complete);
  EXPECT_FALSE(none.nearest.upper);
  EXPECT_EQ(none.lower(), 0.5) << "the ball that lies in the ranges";
}

TEST(Nearest, KeepsValidBoundsWhereItIsEnded) {
  study::Question question{.model = symbolic::parse_model(
                               "[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\n[SYSTEM EQS]\nx^2 + y^2 = 4;\n", "test.cuik")};
  BallOptions ball{.at = {{"x", "0"}, {"y", "0"}}, .in = {"x", "y"}};
  solve::Options search;
  search.max_boxes = 5;
  solve::Control control(limits_of(search));
  const Clearance c = clearance(question, ball, {.precision = 1e-5}, search, control);
  EXPECT_FALSE(c.nearest.complete);
  EXPECT_LE(c.nearest.lower, 2);
  EXPECT_TRUE(!c.nearest.upper || *c.nearest.upper >= 2);
}

// Ellipsoids Σ (x_i − c_i)²/s_i² = 1 rotated by nothing, in two to four dimensions: the true distance is found by Lagrange's
// condition, one equation in one unknown.
TEST(Nearest, FindsPlantedDistancesOfRandomEllipsoids) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> semi(0.5, 2), place(-3, 3);
  int lost = 0, imprecise = 0;
  for (int k = 0; k < 24; ++k) {
    const int n = 2 + k % 3;
    std::vector<double> s, p;
    std::string variables, sum;
    std::vector<NamedValue> at;
    for (int i = 0; i < n; ++i) {
      s.push_back(std::round(semi(random) * 64) / 64);
      p.push_back(std::round(place(random) * 64) / 64);
      const std::string name = "x" + std::to_string(i + 1);
      variables += name + " : [-4, 4]\n";
      sum += (i ? " + " : "") + ("(" + name + "/(" + ExactNumber::dyadic(s.back()).text() + "))^2");
      at.push_back({name, number(p.back())});
    }
    // x_i = s_i² p_i/(s_i² + m); f(m) = Σ (s_i p_i/(s_i² + m))² − 1 falls from ∞ at m = −min s².
    double least = 1e9;
    for (const double a : s) least = std::min(least, a * a);
    double low = -least, high = 1e4;
    for (int step = 0; step < 200; ++step) {
      const double m = (low + high) / 2;
      double f = -1;
      for (int i = 0; i < n; ++i) f += std::pow(s[i] * p[i] / (s[i] * s[i] + m), 2);
      (f > 0 ? low : high) = m;
    }
    double truth = 0;
    for (int i = 0; i < n; ++i) truth += std::pow(p[i] - s[i] * s[i] * p[i] / (s[i] * s[i] + low), 2);
    truth = std::sqrt(truth);
    const Clearance c = nearest_to("[SYSTEM VARS]\n" + variables + "[SYSTEM EQS]\n" + sum + " = 1;\n", at);
    if (!c.nearest.upper || c.nearest.lower > truth * (1 + 1e-9) || *c.nearest.upper < truth * (1 - 1e-9)) ++lost;
    if (!c.nearest.complete) ++imprecise;
  }
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(imprecise, 0);
}

TEST(Nearest, TellsASetThatResistsProofFromOneThatIsFound) {
  // A double circle: every point is degenerate, so nothing can be proven, and the lower bound holds all the same.
  const Clearance c = nearest_to("[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\n[SYSTEM EQS]\n(x^2 + y^2 - 4)^2 = 0;\n",
                                 {{"x", 1}, {"y", 0}}, 0.05);
  EXPECT_FALSE(c.nearest.upper);
  EXPECT_FALSE(c.nearest.complete);
  EXPECT_LE(c.nearest.lower, 1);
  EXPECT_FALSE(c.nearest.empty);
}

TEST(Ball, RefusesWhatMakesNoSense) {
  const std::string circle = "[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\n[SYSTEM EQS]\nx^2 + y^2 = 4;\n";
  EXPECT_THROW(nearest_to(circle, {{"z", 0}}), symbolic::ModelError);
  EXPECT_THROW(nearest_to(circle, {{"x", 4}}), symbolic::ModelError);
  EXPECT_THROW(nearest_to(circle, {}), symbolic::ModelError);
  EXPECT_THROW(nearest_to(circle, {{"x", 0}}, 0.01, {{"y", 2, 1}}), symbolic::ModelError);
  EXPECT_THROW(nearest_to(circle, {{"x", 0}}, 0.01, {{"y", 4, 5}}), symbolic::ModelError);
}

TEST(Rotation, ReadsAProductOfTurns) {
  const Rotation r = parse_rotation("Rz(pi/2) * Rx(pi/2)");
  std::map<std::string, double> none;
  // x → y, y → z, z → x.
  const double expected[3][3] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(symbolic::evaluate(r[i][j], none), expected[i][j], 1e-15) << i << j;
  for (const char* wrong : {"", "Rw(1)", "Rx(1)Ry(2)", "Rx(1)*", "Rx 1", "Rx(1"})
    EXPECT_THROW(parse_rotation(wrong), symbolic::ModelError) << wrong;
}

}  // namespace
}  // namespace corank::analyze
