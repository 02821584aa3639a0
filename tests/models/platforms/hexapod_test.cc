// A 6-6 platform in real lengths: its forward singularities at one height against the determinant of its legs' lines.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "corank/solve/search/solve.h"
#include "corank/study/model.h"
#include "corank/study/question.h"
#include "corank/tests/models/platforms/solved.h"

namespace corank {
namespace {

using Eigen::Vector3d;
constexpr double kHeight = 800, kShortest = 700, kLongest = 1700;

Solved solved(symbolic::SingularitySet set, const std::vector<result::ConstantOverride>& constants) {
  const study::Model model = study::read_model(CORANK_SOURCE_DIR "/models/platforms/hexapod.cuik", constants);
  Solved result{study::system({.model = model.mechanism, .set = set, .assembly = model.assembly}), {}};
  result.cover = solve::solve(result.system, {});
  return result;
}

// Of the legs' lines, moments in metres; nothing out of the legs' reach.
std::optional<double> determinant(double x, double y, double yaw) {
  const Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * Eigen::AngleAxisd(std::numbers::pi / 18, Vector3d::UnitY()) *
       Eigen::AngleAxisd(std::numbers::pi / 12, Vector3d::UnitX()))
          .toRotationMatrix();
  Eigen::Matrix<double, 6, 6> lines;
  for (int i = 0; i < 6; ++i) {
    // Base joints 8 degrees beside 0, 120, 240; platform joints 12 degrees beside 60, 180, 300.
    const double at = ((i + 1) / 2 * 120 + (i % 2 == 0 ? 8 : -8)) * std::numbers::pi / 180;
    const double on = (60 + i / 2 * 120 + (i % 2 == 0 ? -12 : 12)) * std::numbers::pi / 180;
    const Vector3d a = 900 * Vector3d(std::cos(at), std::sin(at), 0), b = 600 * Vector3d(std::cos(on), std::sin(on), 0);
    const Vector3d d = Vector3d(x, y, kHeight) + rotation * b - a;
    if (d.norm() < kShortest || d.norm() > kLongest) return std::nullopt;
    lines.row(i) << d.normalized().transpose(), (a / 1000).cross(d.normalized()).transpose();
  }
  return lines.determinant();
}

TEST(Hexapod, TurnedByAQuarterHasACurveOfSingularitiesThatIsProven) {
  const Solved s = solved(symbolic::SingularitySet::forward, {});
  EXPECT_TRUE(s.cover.complete());
  EXPECT_EQ(s.cover.count(Verdict::undecided), 0u);
  ASSERT_GT(s.cover.boxes.size(), 50u);
  const auto x = static_cast<std::size_t>(s.system.find("P_x")), y = static_cast<std::size_t>(s.system.find("P_y"));
  std::mt19937 random(1);
  std::uniform_real_distribution<> place(-300, 300);
  std::size_t found = 0, lost = 0;
  while (found < 100) {
    double p[2] = {place(random), place(random)}, q[2] = {place(random), place(random)};
    auto at_p = determinant(p[0], p[1], std::numbers::pi / 2), at_q = determinant(q[0], q[1], std::numbers::pi / 2);
    if (!at_p || !at_q || (*at_p > 0) == (*at_q > 0)) continue;
    bool within = true;
    for (int step = 0; step < 60 && within; ++step) {
      const double middle[2] = {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2};
      const auto value = determinant(middle[0], middle[1], std::numbers::pi / 2);
      within = value.has_value();
      if (within) std::copy_n(middle, 2, (*value > 0) == (*at_p > 0) ? p : q);
    }
    if (!within) continue;
    ++found;
    lost += std::none_of(s.cover.boxes.begin(), s.cover.boxes.end(), [&](const CoverBox& b) {
      return b.box[x].lo() - 1e-6 <= p[0] && p[0] <= b.box[x].hi() + 1e-6 && b.box[y].lo() - 1e-6 <= p[1] &&
             p[1] <= b.box[y].hi() + 1e-6;
    });
  }
  EXPECT_EQ(lost, 0u) << "of " << found;
}

TEST(Hexapod, NotTurnedHasNoSingularityInItsReach) {
  const Solved forward = solved(symbolic::SingularitySet::forward, {{"yaw", "0"}});
  EXPECT_TRUE(forward.cover.complete());
  EXPECT_TRUE(forward.cover.boxes.empty());
  std::size_t positive = 0, negative = 0;
  for (int i = -20; i <= 20; ++i)
    for (int j = -20; j <= 20; ++j)
      if (const auto value = determinant(50 * i, 50 * j, 0)) ++(*value > 0 ? positive : negative);
  EXPECT_GT(positive, 500u);
  EXPECT_EQ(negative, 0u);
  EXPECT_FALSE(solved(symbolic::SingularitySet::cspace, {{"yaw", "0"}}).cover.boxes.empty());
}

}  // namespace
}  // namespace corank
