// Forward singularities of platforms from their parts alone, against determinants computed here from the platforms' poses:
// of many singular configurations on random lines none is outside the boxes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "corank/solve/search/solve.h"
#include "corank/study/model.h"
#include "corank/study/question.h"
#include "corank/tests/models/platforms/solved.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const std::size_t kSamples = test::long_run() ? 2000 : 500;

Solved solved(const std::string& name) {
  study::Question question;
  const study::Model model = study::read_model(std::string(CORANK_SOURCE_DIR "/models/platforms/") + name + ".cuik");
  question.model = model.mechanism;
  question.assembly = model.assembly;
  question.set = symbolic::SingularitySet::forward;
  Solved result{study::system(question), {}};
  solve::Options options;
  options.sigma = 0.1;
  options.threads = 1;
  result.cover = solve::solve(result.system, options);
  return result;
}

// How many of the points, given by these variables, are in no box.
std::size_t count_lost(const Solved& s, const std::vector<std::string>& variables,
                       const std::vector<std::vector<double>>& points) {
  std::vector<std::size_t> at;
  for (const std::string& name : variables) {
    const int v = s.system.find(name);
    EXPECT_GE(v, 0) << name;
    if (v < 0) return points.size();
    at.push_back(static_cast<std::size_t>(v));
  }
  std::vector<std::vector<std::pair<double, double>>> boxes;
  for (const CoverBox& b : s.cover.boxes) {
    boxes.emplace_back();
    for (const std::size_t v : at) boxes.back().emplace_back(b.box[v].lo() - 1e-7, b.box[v].hi() + 1e-7);
  }
  std::size_t lost = 0;
  for (const std::vector<double>& p : points) {
    const bool held = std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) {
      for (std::size_t i = 0; i < p.size(); ++i)
        if (p[i] < box[i].first || p[i] > box[i].second) return false;
      return true;
    });
    lost += !held;
  }
  return lost;
}

// Points of random lines between a and b where f changes its sign; nothing where f is not defined.
using Function = std::function<std::optional<double>(const Vector3d&)>;
std::vector<Vector3d> zeros(const Vector3d& a, const Vector3d& b, const Function& f, std::size_t count, int lines = 40'000) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto any = [&]() -> Vector3d { return a + Vector3d(unit(random), unit(random), unit(random)).cwiseProduct(b - a); };
  std::vector<Vector3d> found;
  for (int line = 0; line < lines && found.size() < count; ++line) {
    Vector3d p = any(), q = any();
    std::optional<double> at_p = f(p), at_q = f(q);
    if (!at_p || !at_q || (*at_p > 0) == (*at_q > 0)) continue;
    const bool sign = *at_p > 0;
    bool defined = true;
    for (int step = 0; step < 35 && defined; ++step) {
      const Vector3d middle = 0.5 * (p + q);
      const std::optional<double> value = f(middle);
      defined = value.has_value();
      if (defined) ((*value > 0) == sign ? p : q) = middle;
    }
    if (defined) found.push_back(0.5 * (p + q));
  }
  return found;
}

TEST(PlatformSingularities, OfAStewartPlatformInOneOrientationAreEnclosedAndProven) {
  const Solved s = solved("stewart");
  EXPECT_TRUE(s.cover.complete());
  EXPECT_EQ(s.cover.count(Verdict::undecided), 0u);
  EXPECT_EQ(s.cover.boxes.size(), s.cover.count(Verdict::regular) + s.cover.count(Verdict::boundary));
  EXPECT_LE(s.cover.statistics.processed, 2000u);
  const std::array<int, 6> base{1, 7, 9, 15, 17, 23}, platform{3, 5, 11, 13, 19, 21};
  const Matrix3d rotation = (Eigen::AngleAxisd(0.2, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.1, Vector3d::UnitY()) *
                             Eigen::AngleAxisd(0.3, Vector3d::UnitX()))
                                .toRotationMatrix();
  const auto determinant = [&](const Vector3d& p) -> std::optional<double> {
    Eigen::Matrix<double, 6, 6> lines;
    for (std::size_t i = 0; i < 6; ++i) {
      const double a = base[i] * std::numbers::pi / 12, b = platform[i] * std::numbers::pi / 12;
      const Vector3d c = rotation * (0.6 * Vector3d(std::cos(b), std::sin(b), 0));
      const Vector3d d = p + c - Vector3d(std::cos(a), std::sin(a), 0);
      if (d.norm() < 0.1) return std::nullopt;
      lines.row(static_cast<Eigen::Index>(i)) << d.transpose(), c.cross(d).transpose();
    }
    return lines.determinant();
  };
  const auto samples = zeros({-1, -1, 0.2}, {1, 1, 2}, determinant, kSamples);
  ASSERT_EQ(samples.size(), kSamples);
  std::vector<std::vector<double>> points;
  for (const Vector3d& p : samples) points.push_back({p.x(), p.y(), p.z()});
  EXPECT_EQ(count_lost(s, {"P_x", "P_y", "P_z"}, points), 0u);
}

// Which of its two postures each arm has: the bits of `mode`.
TEST(PlatformSingularities, OfADeltaInOnePlaneAreEnclosedAndProven) {
  const Solved s = solved("delta_translation");
  EXPECT_TRUE(s.cover.complete());
  EXPECT_EQ(s.cover.count(Verdict::undecided), 0u);
  EXPECT_LE(s.cover.statistics.processed, 6000u);
  std::vector<std::vector<double>> points;
  for (unsigned mode = 0; mode < 8; ++mode) {
    std::array<double, 3> angles{};
    const auto determinant = [&](const Vector3d& p) -> std::optional<double> {
      Matrix3d rods;
      for (int i = 0; i < 3; ++i) {
        const double t = 2 * std::numbers::pi * i / 3;
        const Vector3d out(std::cos(t), std::sin(t), 0);
        // |p + (rp - rb) out - (cos a out - sin a z)|² = rod².
        const Vector3d q = p - 0.5 * out;
        const double x = q.dot(out), z = -q.z(), along = (q.squaredNorm() + 1 - 1.44) / 2, reach = std::hypot(x, z);
        if (std::fabs(along) >= reach) return std::nullopt;
        const double a =
            std::remainder(std::atan2(z, x) + (mode >> i & 1 ? 1 : -1) * std::acos(along / reach), 2 * std::numbers::pi);
        if (a < -std::numbers::pi / 3 || a > std::numbers::pi / 2) return std::nullopt;
        angles[static_cast<std::size_t>(i)] = a;
        rods.row(i) = (q - std::cos(a) * out + std::sin(a) * Vector3d::UnitZ()).transpose();
      }
      return rods.determinant();
    };
    const Vector3d low(-1.2, -1.2, -0.5), high(1.2, 1.2, -0.5);
    if (zeros(low, high, determinant, 1, 20'000).empty()) continue;
    for (const Vector3d& p : zeros(low, high, determinant, kSamples, 200'000)) {
      if (!determinant(p)) continue;
      std::vector<double> point{p.x(), p.y()};
      for (const double angle : angles) point.insert(point.end(), {std::cos(angle), std::sin(angle)});
      points.push_back(point);
    }
  }
  EXPECT_GE(points.size(), kSamples);
  EXPECT_EQ(count_lost(s, {"x", "y", "c_a1", "s_a1", "c_a2", "s_a2", "c_a3", "s_a3"}, points), 0u);
}

// The tilt and the direction in which it goes, and the turn, are found by Newton's method: the balls stay in their hinges'
// planes, t_i · B_i = 0.
TEST(PlatformSingularities, OfA3RpsAtOneHeightAreEnclosedAndProven) {
  const Solved s = solved("3rps");
  EXPECT_TRUE(s.cover.complete());
  EXPECT_EQ(s.cover.count(Verdict::undecided), 0u);
  struct Pose {
    Matrix3d rotation;
    Vector3d at;
  };
  // With the platform's z axis at (sin e cos d, sin e sin d, cos e): R = Rz(d) Ry(e) Rz(-d) Rz(g), and g = 0 (or π) from the
  // sum of the three conditions; then x and y from two of them.
  const auto pose = [](double tilt, double way) {
    Pose p;
    p.rotation = (Eigen::AngleAxisd(way, Vector3d::UnitZ()) * Eigen::AngleAxisd(tilt, Vector3d::UnitY()) *
                  Eigen::AngleAxisd(-way, Vector3d::UnitZ()))
                     .toRotationMatrix();
    Matrix3d m;
    Vector3d right;
    for (int i = 0; i < 3; ++i) {
      const double t = 2 * std::numbers::pi * i / 3;
      const Vector3d tangent(-std::sin(t), std::cos(t), 0);
      m.row(i) << tangent.x(), tangent.y(), 1;
      right[i] = -tangent.dot(p.rotation * (0.6 * Vector3d(std::cos(t), std::sin(t), 0)));
    }
    const Vector3d solution = m.inverse() * right;
    EXPECT_NEAR(solution.z(), 0, 1e-12);  // the three conditions agree
    p.at = {solution.x(), solution.y(), 1};
    return p;
  };
  const auto determinant = [&](const Vector3d& q) -> std::optional<double> {
    const Pose p = pose(q.x(), q.y());
    if (std::fabs(p.at.x()) > 0.5 || std::fabs(p.at.y()) > 0.5 || std::cos(q.x()) < std::cos(0.8 * std::numbers::pi))
      return std::nullopt;
    Eigen::Matrix<double, 6, 6> lines;
    for (int i = 0; i < 3; ++i) {
      const double t = 2 * std::numbers::pi * i / 3;
      const Vector3d out(std::cos(t), std::sin(t), 0), tangent(-std::sin(t), std::cos(t), 0);
      const Vector3d b = p.at + p.rotation * (0.6 * out), leg = b - out;
      if (leg.norm() < 0.5 || leg.norm() > 2) return std::nullopt;
      // The slide points along the leg, its angle about the tangent counts from the z axis.
      if (std::fabs(std::atan2(leg.dot(out), leg.z())) > std::numbers::pi / 3) return std::nullopt;
      lines.row(2 * i) << leg.transpose(), b.cross(leg).transpose();
      lines.row(2 * i + 1) << tangent.transpose(), b.cross(tangent).transpose();
    }
    return lines.determinant();
  };
  const auto samples = zeros({0, -std::numbers::pi, 0}, {std::numbers::pi, std::numbers::pi, 0}, determinant, kSamples);
  EXPECT_GE(samples.size(), kSamples);
  std::vector<std::vector<double>> points;
  for (const Vector3d& q : samples) {
    const Pose p = pose(q.x(), q.y());
    points.push_back({p.at.x(), p.at.y()});
    for (int i = 0; i < 3; ++i) {
      const double t = 2 * std::numbers::pi * i / 3;
      const Vector3d out(std::cos(t), std::sin(t), 0);
      points.back().push_back((p.at + p.rotation * (0.6 * out) - out).norm());
    }
  }
  EXPECT_EQ(count_lost(s, {"P_x", "P_y", "d1", "d2", "d3"}, points), 0u);
}

}  // namespace
}  // namespace corank
