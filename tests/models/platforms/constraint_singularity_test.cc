// The constraint singularities of a 3-UPU platform along a line, against the screws of its joints.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "corank/core/dense.h"
#include "corank/solve/search/solve.h"
#include "corank/study/model.h"
#include "corank/study/question.h"
#include "corank/symbolic/model/model_file.h"

namespace corank {
namespace {

using Eigen::Vector3d;

// How many independent motions the joints of the three legs have together where the platform, in the base's orientation, is
// at p: of rates (two of each universal joint, one of each slide) those that give all legs' ends the same twist.
int mobility(const Vector3d& p) {
  Eigen::Matrix<double, 12, 15> loops = Eigen::Matrix<double, 12, 15>::Zero();
  for (int leg = 0; leg < 3; ++leg) {
    const double t = 2 * std::numbers::pi * leg / 3;
    const Vector3d out(std::cos(t), std::sin(t), 0), tangent(-std::sin(t), std::cos(t), 0);
    const Vector3d a = out, b = p + 0.5 * out, along = (b - a).normalized(), middle = tangent.cross(along).normalized();
    Eigen::Matrix<double, 6, 5> screws;
    const auto turn = [&](int k, const Vector3d& axis, const Vector3d& point) { screws.col(k) << axis, point.cross(axis); };
    turn(0, tangent, a);
    turn(1, middle, a);
    screws.col(2) << Vector3d::Zero(), along;
    turn(3, middle, b);
    turn(4, tangent, b);
    if (leg != 1) loops.block<6, 5>(0, 5 * leg) = (leg == 0 ? 1 : -1) * screws;
    if (leg != 2) loops.block<6, 5>(6, 5 * leg) = (leg == 0 ? 1 : -1) * screws;
  }
  const Eigen::VectorXd values = singular_values(loops);
  return 15 - static_cast<int>((values.array() > 1e-9).count());
}

TEST(ConstraintSingularities, OfTheScrewsLieOnACylinder) {
  for (const Vector3d& regular : {Vector3d(0, 0, 1), Vector3d(0.3, -0.4, 0.8), Vector3d(0.99, 0, 1), Vector3d(-1.2, 0.5, 1)})
    EXPECT_EQ(mobility(regular), 3) << regular.transpose();
  for (int k = 0; k < 12; ++k) EXPECT_EQ(mobility({std::cos(0.1 + k), std::sin(0.1 + k), 0.9}), 4) << k;
  EXPECT_GT(mobility({0.3, 0.2, 0}), 3) << "in the base's plane";
}

TEST(ConstraintSingularities, OfA3UpuAlongALineAreTwoPostures) {
  const study::Model model = study::read_model(CORANK_SOURCE_DIR "/models/platforms/3upu_constraint.cuik");
  const System system = study::system(
      {.model = model.mechanism, .set = symbolic::SingularitySet::cspace_singular, .assembly = model.assembly});
  const Cover cover = solve::solve(system, {});
  EXPECT_TRUE(cover.complete());
  ASSERT_EQ(cover.boxes.size(), 2u);
  for (const double x : {-1.0, 1.0}) {
    ASSERT_EQ(mobility({x, 0, 1}), 4);
    std::size_t holding = 0;
    for (const CoverBox& b : cover.boxes) {
      bool holds = true;
      const auto at = [&](const std::string& name, double value) {
        const Interval& v = b.box[static_cast<std::size_t>(system.find(name))];
        holds = holds && v.lo() - 1e-12 <= value && value <= v.hi() + 1e-12 && v.width() < 1e-4;
      };
      at("P_x", x);
      for (int leg = 0; leg < 3; ++leg) {
        const double t = 2 * std::numbers::pi * leg / 3;
        const Vector3d d = Vector3d(x, 0, 1) - 0.5 * Vector3d(std::cos(t), std::sin(t), 0);
        at("d" + std::to_string(leg + 1), d.norm());
        for (int i = 0; i < 3; ++i) at("u_leg" + std::to_string(leg + 1) + "_" + "xyz"[i], d.normalized()[i]);
      }
      holding += holds;
    }
    EXPECT_EQ(holding, 1u) << "x = " << x;
  }
}

// The same in a plane: a circle about the middle, where the legs are long enough. Its self-motion, in which the two proofs
// differ by roundings, is proven all along.
TEST(ConstraintSingularities, OfA3UpuInAPlaneAreAProvenCircle) {
  std::string text = symbolic::read_text(CORANK_SOURCE_DIR "/models/platforms/3upu.cuik");
  text.resize(text.find("[OUTPUTS]"));
  const study::Model model =
      study::parse_model({text + "[OUTPUTS]\nP : pose of platform.C range z [11/10, 11/10] keeps id\n", "3upu.cuik"});
  const System system = study::system(
      {.model = model.mechanism, .set = symbolic::SingularitySet::cspace_singular, .assembly = model.assembly});
  const Cover cover = solve::solve(system, {});
  EXPECT_TRUE(cover.complete());
  for (const CoverBox& b : cover.boxes) EXPECT_NE(b.verdict, Verdict::undecided);
  const auto x = static_cast<std::size_t>(system.find("P_x")), y = static_cast<std::size_t>(system.find("P_y"));
  int reachable = 0;
  for (int k = 0; k < 360; ++k) {
    const double t = 2 * std::numbers::pi * k / 360, px = std::cos(t), py = std::sin(t);
    bool reaches = true;
    for (int leg = 0; leg < 3; ++leg) {
      const double at = 2 * std::numbers::pi * leg / 3;
      reaches = reaches && Vector3d(px - 0.5 * std::cos(at), py - 0.5 * std::sin(at), 1.1).norm() < 2;
    }
    reachable += reaches;
    EXPECT_EQ(reaches, std::any_of(cover.boxes.begin(), cover.boxes.end(),
                                   [&](const CoverBox& b) { return b.box[x].contains(px) && b.box[y].contains(py); }))
        << k;
  }
  EXPECT_GT(reachable, 60);
}

// The pose of a platform with three freedoms, in one orientation: its position is the output. There the platform may turn
// although the motors are locked.
TEST(ConstraintSingularities, OfA3UpuInOneOrientationAreForwardSingularities) {
  std::string text = symbolic::read_text(CORANK_SOURCE_DIR "/models/platforms/3upu_constraint.cuik");
  text.resize(text.find("[OUTPUTS]"));
  const study::Model model =
      study::parse_model({text + "[OUTPUTS]\nP : pose of platform.C range y [y0, y0] z [z0, z0] keeps id\n", "3upu.cuik"});
  EXPECT_EQ(model.assembly->mobility, 3);
  EXPECT_TRUE(std::any_of(model.notices.begin(), model.notices.end(), [](const std::string& notice) {
    return notice.find("of P the position is the output, in the orientation that is kept") != std::string::npos;
  }));
  const System system =
      study::system({.model = model.mechanism, .set = symbolic::SingularitySet::forward, .assembly = model.assembly});
  const Cover cover = solve::solve(system, {});
  EXPECT_TRUE(cover.complete());
  ASSERT_EQ(cover.count(Verdict::isolated), 2u);
  ASSERT_EQ(cover.boxes.size(), 2u);
  std::vector<double> x;
  for (const CoverBox& b : cover.boxes) x.push_back(b.box[static_cast<std::size_t>(system.find("P_x"))].mid());
  std::sort(x.begin(), x.end());
  EXPECT_NEAR(x[0], -1, 1e-9);
  EXPECT_NEAR(x[1], 1, 1e-9);
}

}  // namespace
}  // namespace corank
