// Legs in one piece against their links: random platforms on universal–prismatic–universal legs, by screws that
// know nothing of corank's equations.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "corank/kinematics/equations/assembly.h"
#include "corank/symbolic/velocity/velocity_equation.h"
#include "corank/tests/robots/numeric_mechanism.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using kinematics::JointKind;
using kinematics::Robot;
using test::MatrixXd;
using test::VectorXd;

constexpr int kLegs = 3;

// Of one leg, in the frames of base and platform.
struct Leg {
  Vector3d base, platform, base_axis, platform_axis;
};

// A platform on three legs, with integer points and axes.
struct Platform {
  std::vector<Leg> legs;

  explicit Platform(unsigned seed) {
    std::mt19937 random(seed);
    const auto integer = [&] { return static_cast<double>(std::uniform_int_distribution<>(-3, 3)(random)); };
    const auto vector = [&] { return Vector3d(integer(), integer(), integer()); };
    const auto direction = [&] {
      for (;;)
        if (const Vector3d v = vector(); v.norm() > 0) return v;
    };
    for (int i = 0; i < kLegs; ++i) legs.push_back({3 * vector(), vector(), direction(), direction()});
  }

  // With a sphere on a leg's link, the leg is not in one piece.
  Robot robot(bool with_shapes) const {
    const auto exact = [](const Vector3d& v) {
      return kinematics::Vector{static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])};
    };
    Robot r;
    r.link("base");
    const std::size_t platform = r.link("platform");
    for (int i = 0; i < kLegs; ++i) {
      const Leg& leg = legs[static_cast<std::size_t>(i)];
      const std::string n = std::to_string(i + 1), lower = "lower" + n, upper = "upper" + n;
      r.join(JointKind::universal, "U" + n, "base", exact(leg.base), exact(leg.base_axis), lower, {0, 0, 0}, {1, 0, 0});
      kinematics::Joint& slide =
          r.join(JointKind::prismatic, "d" + n, lower, {0, 0, 0}, {0, 0, 1}, upper, {0, 0, 0}, {0, 0, 1});
      slide.ranges = {kinematics::Range{"1/10", 40}};
      slide.actuated = true;
      r.join(JointKind::universal, "V" + n, upper, {0, 0, 0}, {1, 0, 0}, "platform", exact(leg.platform),
             exact(leg.platform_axis));
    }
    if (with_shapes)
      for (kinematics::Link& link : r.links)
        link.shapes.push_back({kinematics::Shape::Kind::sphere, {{0, 0, 0}}, 1, "", {}});
    kinematics::Output& output = r.outputs.emplace_back();
    output.name = "P";
    output.link = platform;
    return r;
  }
};

struct Pose {
  Matrix3d rotation;
  Vector3d origin;
};

// Of the platform, the second link.
Pose pose_of(const kinematics::Assembly& assembly, const std::map<std::string, double>& values) {
  const kinematics::Assembly::LinkPose& pose = assembly.poses[1];
  Pose result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.origin[static_cast<Eigen::Index>(i)] = symbolic::evaluate(pose.origin[i], values);
    for (std::size_t k = 0; k < 3; ++k)
      result.rotation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          symbolic::evaluate(pose.rotation[i][k], values);
  }
  return result;
}

// Screws (ω, v at the origin) of the two universal joints of a leg, whose inner axes are perpendicular to both outer ones
// and to the leg. `misfit`: how far such an axis is from being there.
Eigen::Matrix<double, 6, 4> screws(const Leg& leg, const Pose& pose, double& misfit) {
  const Vector3d a = leg.base_axis.normalized(), b = (pose.rotation * leg.platform_axis).normalized();
  const Vector3d from = leg.base, to = pose.origin + pose.rotation * leg.platform, p = (to - from).normalized();
  Matrix3d rows;
  rows << a.transpose(), p.transpose(), b.transpose();
  const Eigen::JacobiSVD<Matrix3d> svd(rows, Eigen::ComputeFullV);
  misfit = std::max(misfit, svd.singularValues()[2]);
  const Vector3d u = svd.matrixV().col(2);
  Eigen::Matrix<double, 6, 4> result;
  result << a, u, u, b, from.cross(a), from.cross(u), to.cross(u), to.cross(b);
  return result;
}

// Is the platform held, with all lengths locked, by the legs' screws? The least singular value of [1 −S₁; 1 −S₂; …].
double held(const Platform& platform, const Pose& pose, double& misfit) {
  MatrixXd m = MatrixXd::Zero(6 * kLegs, 6 + 4 * kLegs);
  for (int i = 0; i < kLegs; ++i) {
    m.block<6, 6>(6 * i, 0).setIdentity();
    m.block<6, 4>(6 * i, 6 + 4 * i) = -screws(platform.legs[static_cast<std::size_t>(i)], pose, misfit);
  }
  return singular_values(m).tail(1)[0];
}

// L without its input columns.
MatrixXd forward_matrix(const symbolic::ExpressionMatrix& l, const std::map<std::string, double>& values) {
  std::vector<std::size_t> kept;
  for (std::size_t j = 0; j < l.columns.size(); ++j)
    if (!l.columns[j].starts_with("v_d")) kept.push_back(j);
  MatrixXd m(static_cast<Eigen::Index>(l.rows.size()), static_cast<Eigen::Index>(kept.size()));
  for (std::size_t i = 0; i < l.rows.size(); ++i)
    for (std::size_t k = 0; k < kept.size(); ++k)
      m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = symbolic::evaluate(l.rows[i][kept[k]], values);
  return m;
}

TEST(LegsInOnePiece, AskForNoCoordinatesOfTheirLinks) {
  const Platform platform(1);
  const kinematics::Assembly whole = kinematics::assemble(platform.robot(true)),
                             legs = kinematics::assemble(platform.robot(false));
  EXPECT_EQ(whole.mobility, 3);
  EXPECT_EQ(legs.mobility, 3);
  EXPECT_EQ(legs.mobility_by_joints, whole.mobility_by_joints);
  EXPECT_EQ(legs.links, whole.links);
  EXPECT_LT(legs.mechanism.coordinates().size(), whole.mechanism.coordinates().size());
}

// Configurations of the legs are configurations of their links, and the other way about.
TEST(LegsInOnePiece, HaveTheConfigurationsOfTheirLinks) {
  int found = 0;
  for (unsigned seed = 1; seed <= test::seeds(6); ++seed)
    for (const bool with_shapes : {false, true}) {
      const Platform platform(seed);
      const kinematics::Assembly assembly = kinematics::assemble(platform.robot(with_shapes));
      const test::NumericMechanism numeric(assembly.mechanism);
      std::mt19937 random(seed);
      for (int k = 0; k < 4; ++k) {
        const auto x = numeric.random_configuration(random, 20);
        if (!x) continue;
        ++found;
        const auto values = numeric.named(*x);
        const Pose pose = pose_of(assembly, values);
        double misfit = 0;
        static_cast<void>(held(platform, pose, misfit));
        EXPECT_LT(misfit, 1e-6) << "seed " << seed;
        EXPECT_LT((pose.rotation.transpose() * pose.rotation - Matrix3d::Identity()).norm(), 1e-9);
        for (int i = 0; i < kLegs; ++i) {
          const Leg& leg = platform.legs[static_cast<std::size_t>(i)];
          EXPECT_NEAR((pose.origin + pose.rotation * leg.platform - leg.base).norm(),
                      std::fabs(values.at("d" + std::to_string(i + 1))), 1e-8);
        }
      }
    }
  EXPECT_GT(found, 40);
}

// Along random ways det L_y changes its sign where the legs' screws let the platform go, and nowhere else.
TEST(LegsInOnePiece, AreSingularWhereTheirScrewsAre) {
  int crossings = 0, regular = 0;
  for (unsigned seed = 1; seed <= test::seeds(10); ++seed) {
    const Platform platform(seed);
    const kinematics::Assembly assembly = kinematics::assemble(platform.robot(false));
    const test::NumericMechanism numeric(assembly.mechanism);
    const symbolic::ExpressionMatrix l = symbolic::derive(assembly.mechanism).velocity.matrix;
    std::mt19937 random(seed);
    const auto determinant = [&](const VectorXd& x) { return forward_matrix(l, numeric.named(x)).determinant(); };
    const auto hold = [&](const VectorXd& x) {
      double misfit = 0;
      return held(platform, pose_of(assembly, numeric.named(x)), misfit);
    };
    for (int way = 0; way < 4; ++way) {
      auto x = numeric.random_configuration(random, 20);
      if (!x) continue;
      const MatrixXd motions = test::kernel(numeric.jacobian(*x));
      VectorXd step = 0.02 * motions.col(way % motions.cols());
      double at_x = determinant(*x);
      for (int k = 0; k < 60; ++k) {
        const auto next = numeric.solution(*x + step);
        if (!next || (*next - *x).norm() > 0.1) break;
        const double at_next = determinant(*next);
        if (at_x * at_next < 0) {
          VectorXd from = *x, to = *next;
          for (int halving = 0; halving < 30; ++halving) {
            const auto middle = numeric.solution(0.5 * (from + to));
            if (!middle) break;
            (at_x * determinant(*middle) < 0 ? to : from) = *middle;
          }
          if ((to - from).norm() < 1e-8) {
            ++crossings;
            EXPECT_LT(hold(from), 1e-5) << "seed " << seed;
          }
        } else if (std::fabs(at_x) > 1e-3) {
          ++regular;
          EXPECT_GT(hold(*x), 1e-9);
        }
        step = 0.02 * (*next - *x).normalized();
        x = next;
        at_x = at_next;
      }
    }
  }
  EXPECT_GE(crossings, 5);
  EXPECT_GT(regular, 300);
  std::cout << crossings << " crossings, " << regular << " regular configurations\n";
}

// Each reason for which a leg stays in its links. Links have a pose each, legs in one piece have none.
TEST(LegsInOnePiece, StayLinksWhereSomethingIsAskedOfThem) {
  const auto poses = [](auto&& change) {
    Robot robot = Platform(1).robot(false);
    change(robot);
    return kinematics::assemble(robot).poses.size();
  };
  const auto joint = [](Robot& r, const std::string& name) -> kinematics::Joint& {
    return r.joints[static_cast<std::size_t>(r.find_joint(name))];
  };
  EXPECT_EQ(poses([](Robot&) {}), 2u);
  EXPECT_EQ(poses([&](Robot& r) { joint(r, "d1").ranges = {kinematics::Range{0, 40}}; }), 4u) << "length 0";
  EXPECT_EQ(poses([&](Robot& r) { joint(r, "V1").ends[0].point = {0, 1, 0}; }), 4u) << "beside the line";
  EXPECT_EQ(poses([&](Robot& r) { joint(r, "V1").ends[0].axis = {0, 1, 0}; }), 4u) << "inner axes askew";
  EXPECT_EQ(poses([&](Robot& r) { r.outputs[0].link = static_cast<std::size_t>(r.find_link("upper1")); }), 4u)
      << "an output of its link";
  EXPECT_EQ(poses([&](Robot& r) {
              r.links[static_cast<std::size_t>(r.find_link("lower1"))].shapes.push_back(
                  {kinematics::Shape::Kind::sphere, {{0, 0, 0}}, 1, "", {}});
            }),
            4u)
      << "a shape";
  EXPECT_EQ(poses([&](Robot& r) {
              kinematics::Joint& u = joint(r, "U1");
              u.ends[0].axis = {0, 1, 0};
              u.ends[0].zero = kinematics::Vector{1, 0, 0};
              u.ends[1].zero = kinematics::Vector{0, 0, 1};
              u.ranges = {kinematics::Range{-1, 1}, kinematics::Range{-1, 1}};
            }),
            4u)
      << "limits of a universal joint";
}

}  // namespace
}  // namespace corank
