// Cusps of a 3-RPR robot with one leg held (Innocenti and Parenti-Castelli's lengths; six for leg 1 = 17, as M. Zein, P.
// Wenger and D. Chablat found), against Newton's method from a grid of starts, in doubles.
#include <array>

#include "corank/check/checker.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/sentences.h"
#include "corank/result/values/summary.h"
#include "corank/tests/models/cusps/asking.h"

namespace corank::test {
namespace {

using Pair = std::array<double, 2>;

// Leg 1 at the angle a, the platform turned by p.
struct Robot {
  double leg1, a2 = 15.91, a3 = 10, d1 = 17.04, d2 = 16.54, d3 = 20.84;
  double u = (d1 * d1 + d3 * d3 - d2 * d2) / (2 * d1), k = std::sqrt(d3 * d3 - u * u);

  Pair end(int leg, const Pair& q) const {
    const double x = leg == 2 ? d1 : u, y = leg == 2 ? 0 : k;
    return {leg1 * std::cos(q[0]) + x * std::cos(q[1]) - y * std::sin(q[1]) - (leg == 2 ? a2 : 0),
            leg1 * std::sin(q[0]) + x * std::sin(q[1]) + y * std::cos(q[1]) - (leg == 2 ? 0 : a3)};
  }
  double length(int leg, const Pair& q) const { return std::hypot(end(leg, q)[0], end(leg, q)[1]); }
  // ½ ∂ length²/∂q.
  Pair row(int leg, const Pair& q) const {
    const double x = leg == 2 ? d1 : u, y = leg == 2 ? 0 : k;
    const Pair e = end(leg, q);
    return {leg1 * (-e[0] * std::sin(q[0]) + e[1] * std::cos(q[0])),
            e[0] * (-x * std::sin(q[1]) - y * std::cos(q[1])) + e[1] * (x * std::cos(q[1]) - y * std::sin(q[1]))};
  }
  double determinant(const Pair& q) const {
    const Pair r = row(2, q), s = row(3, q);
    return (r[0] * s[1] - r[1] * s[0]) / 1000;
  }
  // det, and its derivative along the kernel, which the longer row gives.
  Pair values(const Pair& q, int leg) const {
    constexpr double h = 1e-5;
    const Pair r = row(leg, q);
    const double by_a = (determinant({q[0] + h, q[1]}) - determinant({q[0] - h, q[1]})) / (2 * h),
                 by_p = (determinant({q[0], q[1] + h}) - determinant({q[0], q[1] - h})) / (2 * h);
    return {determinant(q), (-r[1] * by_a + r[0] * by_p) / 100};
  }
};

std::vector<Place> cusps_of(const Robot& robot, double lower2 = 1) {
  constexpr int kGrid = 30;
  constexpr double h = 1e-5;
  std::vector<Pair> found;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    Pair q{2 * M_PI * (i % kGrid) / kGrid, 2 * M_PI * (i / kGrid) / kGrid};
    const auto size = [&](int leg) { return std::hypot(robot.row(leg, q)[0], robot.row(leg, q)[1]); };
    const int leg = size(2) > size(3) ? 2 : 3;
    bool converged = false;
    for (int step = 0; step < 30 && !converged; ++step) {
      const Pair f = robot.values(q, leg), a = robot.values({q[0] + h, q[1]}, leg), b = robot.values({q[0] - h, q[1]}, leg),
                 c = robot.values({q[0], q[1] + h}, leg), d = robot.values({q[0], q[1] - h}, leg);
      const double j00 = (a[0] - b[0]) / (2 * h), j10 = (a[1] - b[1]) / (2 * h), j01 = (c[0] - d[0]) / (2 * h),
                   j11 = (c[1] - d[1]) / (2 * h), det = j00 * j11 - j01 * j10;
      if (std::fabs(det) < 1e-14) break;
      const double da = (f[0] * j11 - f[1] * j01) / det, dp = (j00 * f[1] - j10 * f[0]) / det, length = std::hypot(da, dp),
                   factor = std::min(1.0, 0.3 / std::max(length, 1e-9));
      q = {q[0] - factor * da, q[1] - factor * dp};
      converged = length < 1e-8;
    }
    if (!converged || std::hypot(robot.row(leg, q)[0], robot.row(leg, q)[1]) < 1e-3) continue;
    const auto same = [&](const Pair& other) {
      return distance(q[0], other[0], true) + distance(q[1], other[1], true) < 1e-3;
    };
    if (std::none_of(found.begin(), found.end(), same)) found.push_back(q);
  }
  std::vector<Place> places;
  for (const Pair& q : found)
    if (robot.length(2, q) > lower2 && robot.length(2, q) < 35 && robot.length(3, q) > 1 && robot.length(3, q) < 35)
      places.push_back({{"pose_phi", q[1]}, {"rho2", robot.length(2, q)}, {"rho3", robot.length(3, q)}});
  return places;
}

// With leg 1 at 14.98 one of six has rho2 = 0.8453: below the model's range.
TEST(Planar3Rpr, HasTheCuspsThatNewtonsMethodFindsInEachSlice) {
  struct Slice {
    const char *leg1, *lower2;
    std::size_t cusps;
  };
  for (const auto& [leg1, lower2, cusps] : {Slice{"17", "1", 6}, {"14.98", "1", 5}, {"14.98", "0.5", 6}}) {
    const std::vector<Place> expected = cusps_of(Robot{.leg1 = std::stod(leg1)}, std::stod(lower2));
    EXPECT_EQ(expected.size(), cusps) << leg1;
    expect_points(ask("planar/3rpr_innocenti", SingularitySet::forward_cusps, {{"leg1", leg1}, {"lower2", lower2}}),
                  expected, 1e-4);
  }
}

// The angles of leg 1 and of the platform are a torus, whose Euler characteristic is 0, and the squares of the other legs
// map it to the plane: the number of cusps is even (Thom 1956).
TEST(Planar3Rpr, HasAnEvenNumberOfCuspsWhereNoRangeCutsTheTorus) {
  for (const char* leg1 : {"14.98", "17"}) {
    const result::Result cusps =
        ask("planar/3rpr_innocenti", SingularitySet::forward_cusps,
            {{"leg1", leg1}, {"lower2", "0.05"}, {"lower3", "0.05"}, {"upper2", "60"}, {"upper3", "60"}});
    EXPECT_TRUE(cusps.cover.complete());
    EXPECT_EQ(result::proven_cusps(cusps).size(), cusps.cover.boxes.size());
    EXPECT_EQ(result::proven_cusps(cusps).size() % 2, 0u) << leg1;
  }
}

TEST(Planar3Rpr, HasTheSameCuspsInMillimetres) {
  const result::Result metres = ask("planar/3rpr_innocenti", SingularitySet::forward_cusps, {{"leg1", "17"}});
  const result::Result millimetres = ask("planar/3rpr_innocenti", SingularitySet::forward_cusps,
                                         {{"leg1", "17000"},
                                          {"a2", "15910"},
                                          {"a3", "10000"},
                                          {"d1", "17040"},
                                          {"d2", "16540"},
                                          {"d3", "20840"},
                                          {"lower2", "1000"},
                                          {"upper2", "35000"},
                                          {"lower3", "1000"},
                                          {"upper3", "35000"}});
  std::vector<Place> expected;
  for (const CoverBox& point : metres.cover.points) {
    const Place place = place_of(metres, point);
    expected.push_back({{"pose_phi", place.at("pose_phi")}, {"rho2", 1000 * place.at("rho2")}});
  }
  expect_points(millimetres, expected, 1e-3);
  EXPECT_LT(millimetres.cover.statistics.processed, 2 * metres.cover.statistics.processed);
}

TEST(Planar3Rpr, HasCrossingsWhoseConfigurationsShareTheirInputs) {
  const result::Result nodes = ask("planar/3rpr_innocenti", SingularitySet::forward_nodes, {{"leg1", "17"}});
  EXPECT_TRUE(nodes.cover.complete());
  ASSERT_EQ(nodes.cover.points.size(), 6u);
  const Robot robot{.leg1 = 17};
  for (const CoverBox& point : nodes.cover.points) {
    EXPECT_EQ(point.verdict, Verdict::isolated);
    const Place place = place_of(nodes, point);
    for (const std::string second : {"", "_2"}) {
      const Pair q{std::atan2(place.at("P_y" + second), place.at("P_x" + second)), place.at("pose_phi" + second)};
      EXPECT_NEAR(robot.determinant(q), 0, 1e-6);
      for (const int leg : {2, 3}) EXPECT_NEAR(robot.length(leg, q), place.at("rho" + std::to_string(leg)), 1e-6);
    }
  }
  EXPECT_NE(result::to_json(nodes).find("\"node_distance\": 0.05"), std::string::npos);
}

TEST(Planar3Rpr, HasCuspsThatTheCheckerConfirmsUnlessTheyWereMoved) {
  study::Question question;
  question.constants = {{"leg1", "17"}};
  question.model = study::read_model(CORANK_SOURCE_DIR "/models/planar/3rpr_innocenti.cuik", question.constants).mechanism;
  for (const SingularitySet set : {SingularitySet::forward_cusps, SingularitySet::forward_nodes}) {
    question.set = set;
    const result::Result result = study::answer(question);
    EXPECT_TRUE(result::verify(result).verified());
    result::Result other = result;
    other.set = set == SingularitySet::forward_cusps ? "inverse-cusps" : "inverse-nodes";
    EXPECT_FALSE(result::verify(other).verified());
    for (std::size_t v = 0; v < result.variables.size(); ++v) {
      result::Result moved = result;
      const Interval side = moved.cover.boxes[0].box[v];
      if (side.width() == 0) continue;  // the leg that is held
      const Interval aside(side.hi() + 1e-6, side.hi() + 1e-6 + side.width());
      moved.cover.boxes[0].box[v] = moved.cover.points[0].box[v] = aside;
      EXPECT_FALSE(result::verify(moved).verified()) << result.variables[v].name;
    }
    result::Result scaled = result;
    scaled.options.kernel_scales.back() = "7";
    EXPECT_FALSE(result::verify(scaled).verified());
  }
}

}  // namespace
}  // namespace corank::test
