// Random robots, in the plane and in space, of all kinds of joints, with trees and loops. What the assembly makes of them is
// compared with what the joints say: at each solution of its equations every joint fits together, and where the robot was
// planted its equations have a solution. CORANK_RANDOM_ROBOTS: how many, CORANK_RANDOM_SEED: from which one on.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <sstream>

#include "corank/symbolic/velocity/velocity_equation.h"
#include "corank/tests/robots/planted_robot.h"

namespace corank {
namespace {

using kinematics::Joint;
using kinematics::JointKind;
using test::NumericMechanism;
using test::Planted;
using test::VectorXd;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

unsigned number_from(const char* variable, unsigned otherwise) {
  const char* const text = std::getenv(variable);
  return text != nullptr && *text != '\0' ? static_cast<unsigned>(std::strtoul(text, nullptr, 10)) : otherwise;
}

std::string described(unsigned seed, const kinematics::Robot& robot) {
  std::ostringstream text;
  text << "seed " << seed << ": " << robot.links.size() << " links,";
  for (const Joint& j : robot.joints)
    text << ' ' << to_string(j.kind) << (j.actuated ? "*" : "") << (j.ranges.empty() ? "" : "[]") << '(' << j.ends[0].link
         << ',' << j.ends[1].link << ')';
  if (!robot.outputs.empty()) text << ", out";
  return text.str();
}

Vector3 numbers(const kinematics::Vector& v) {
  return {symbolic::evaluate(v[0], {}), symbolic::evaluate(v[1], {}), symbolic::evaluate(v[2], {})};
}

struct NumericPose {
  Matrix3 rotation;
  Vector3 origin;
};

std::vector<NumericPose> poses_at(const kinematics::Assembly& assembly, const std::map<std::string, double>& values) {
  std::vector<NumericPose> poses;
  for (const kinematics::Assembly::LinkPose& pose : assembly.poses) {
    NumericPose& p = poses.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      p.origin[static_cast<Eigen::Index>(i)] = symbolic::evaluate(pose.origin[i], values);
      for (std::size_t k = 0; k < 3; ++k)
        p.rotation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
            symbolic::evaluate(pose.rotation[i][k], values);
    }
  }
  return poses;
}

bool in_domain(const System& system, const VectorXd& x) {
  for (std::size_t v = 0; v < system.variables.size(); ++v) {
    const Interval& domain = system.variables[v].domain;
    const double value = x[static_cast<Eigen::Index>(v)];
    if (value < domain.lo() - 1e-9 || value > domain.hi() + 1e-9) return false;
  }
  return true;
}

double outside(double value, const std::optional<kinematics::Range>& range) {
  if (!range) return 0;
  return std::max({0.0, symbolic::evaluate(range->lower, {}) - value, value - symbolic::evaluate(range->upper, {})});
}

// How far a joint is from fitting together: 0 where its two links are as it allows.
double misfit(const Joint& joint, const std::vector<NumericPose>& poses) {
  const auto placed = [&](std::size_t i) {
    const NumericPose& pose = poses[joint.ends[i].link];
    return Vector3(pose.origin + pose.rotation * numbers(joint.ends[i].point));
  };
  const auto direction = [&](std::size_t i, const kinematics::Vector& v) {
    return Vector3(poses[joint.ends[i].link].rotation * numbers(v).normalized());
  };
  const Matrix3 &r0 = poses[joint.ends[0].link].rotation, &r1 = poses[joint.ends[1].link].rotation;
  const Vector3 gap = placed(1) - placed(0);
  const auto range = [&]() { return joint.ranges.empty() ? std::nullopt : joint.ranges[0]; };
  const auto same_axes = [&] { return (direction(0, joint.ends[0].axis) - direction(1, joint.ends[1].axis)).norm(); };
  const auto off_axis = [&] { return gap.cross(direction(0, joint.ends[0].axis)).norm(); };
  switch (joint.kind) {
    case JointKind::revolute: {
      double least = 0;
      if (range()) {
        const Vector3 w = direction(0, joint.ends[0].axis), a = direction(0, *joint.ends[0].zero),
                      b = direction(1, *joint.ends[1].zero);
        const double angle = std::atan2(w.dot(a.cross(b)), a.dot(b));
        least = std::min({outside(angle, range()), outside(angle + 2 * std::numbers::pi, range()),
                          outside(angle - 2 * std::numbers::pi, range())});
      }
      return gap.norm() + same_axes() + least;
    }
    case JointKind::prismatic:
      return (r0 - r1).norm() + off_axis() + outside(gap.dot(direction(0, joint.ends[0].axis)), range());
    case JointKind::cylindrical: return same_axes() + off_axis();
    case JointKind::universal:
      return gap.norm() + std::fabs(direction(0, joint.ends[0].axis).dot(direction(1, joint.ends[1].axis)));
    case JointKind::spherical: return gap.norm();
    case JointKind::slot: return off_axis() + outside(gap.dot(direction(0, joint.ends[0].axis)), range());
    case JointKind::planar: return same_axes() + std::fabs(gap.dot(direction(0, joint.ends[0].axis)));
    case JointKind::parallelogram:
      return (r0 - r1).norm() + std::fabs(gap.norm() - symbolic::evaluate(joint.length, {})) +
             std::fabs(gap.dot(direction(0, joint.ends[0].axis)));
    case JointKind::fixed: {
      Matrix3 kept;
      for (std::size_t i = 0; i < 3; ++i) kept.row(static_cast<Eigen::Index>(i)) = numbers(joint.pose.rotation[i]);
      const NumericPose& base = poses[joint.ends[0].link];
      const Vector3 there = base.origin + base.rotation * numbers(joint.pose.translation);
      return (r0 * kept - r1).norm() + (there - poses[joint.ends[1].link].origin).norm();
    }
    case JointKind::distance: return std::fabs(gap.norm() - symbolic::evaluate(joint.length, {}));
    case JointKind::distance_variable: return outside(gap.norm(), range());
    case JointKind::universal_rod:
      return outside(gap.norm(), range()) +
             std::fabs(gap.dot(direction(1, joint.ends[1].axis).cross(direction(0, joint.ends[0].axis))));
  }
  return 1;
}

// The mechanism's equations together with those that put its links where they were planted.
std::optional<VectorXd> planted_solution(const Planted& planted, const kinematics::Assembly& assembly) {
  symbolic::Mechanism both = assembly.mechanism.without_rates();
  for (const symbolic::Coordinate& c : assembly.mechanism.coordinates())  // which are found from the equations alone
    if (!c.has_range) both.set_range(c.name, -1000, 1000);
  const symbolic::Mechanism where = where_planted(planted, assembly);
  for (const symbolic::Constraint& c : where.constraints()) both.constrain(c.relation);
  const NumericMechanism there(both);
  std::mt19937 random(7);
  for (int attempt = 0; attempt < 60; ++attempt) {
    const auto x = there.solution(there.random_point(random));
    if (x && there.least_inequality(*x) > -1e-9 && in_domain(there.system(), *x)) return x;
  }
  return std::nullopt;
}

struct Count {
  int accepted = 0, refused = 0, open = 0, sampled = 0, planted = 0, missed = 0;
};

void examine(unsigned seed, Count& count) {
  const Planted planted = Planted::tangled(seed);
  SCOPED_TRACE(described(seed, planted.robot));
  std::optional<kinematics::Assembly> assembly;
  std::optional<NumericMechanism> polynomials;
  try {
    assembly = kinematics::assemble(planted.robot);
    if (!assembly->mechanism.constraints().empty()) polynomials.emplace(assembly->mechanism);
  } catch (const symbolic::ModelError&) {  // a sentence is an answer
    ++count.refused;
    return;
  }
  ++count.accepted;
  const symbolic::Mechanism& mechanism = assembly->mechanism;
  if (!polynomials) {
    ++count.open;
    return;
  }
  try {
    symbolic::derive(mechanism);
  } catch (const symbolic::ModelError&) {
  }
  const NumericMechanism& numeric = *polynomials;
  std::mt19937 random(seed);
  for (int k = 0; k < 20; ++k) {
    const auto x = numeric.random_configuration(random, 5);
    if (!x || !in_domain(numeric.system(), *x)) continue;
    const std::vector<NumericPose> poses = poses_at(*assembly, numeric.named(*x));
    for (const NumericPose& pose : poses)
      EXPECT_LT((pose.rotation * pose.rotation.transpose() - Matrix3::Identity()).norm(), 1e-6);
    for (const Joint& joint : planted.robot.joints) EXPECT_LT(misfit(joint, poses), 1e-6) << joint.name;
    ++count.sampled;
  }
  ++(planted_solution(planted, *assembly) ? count.planted : count.missed);
}

TEST(RandomRobots, FitTogetherWhereverTheirEquationsHoldAndAreFoundWhereTheyWerePlanted) {
  const unsigned robots = number_from("CORANK_RANDOM_ROBOTS", 20), first = number_from("CORANK_RANDOM_SEED", 1);
  Count count;
  for (unsigned seed = first; seed < first + robots; ++seed) {
    try {
      examine(seed, count);
    } catch (const std::exception& error) {
      ADD_FAILURE() << "seed " << seed << ": " << error.what();
    }
  }
  std::cout << robots << " robots from seed " << first << ": " << count.accepted << " accepted (" << count.open
            << " open chains), " << count.refused << " refused; " << count.sampled << " configurations sampled, "
            << count.planted << " found where they were planted, " << count.missed << " not\n";
  EXPECT_GT(count.accepted, count.refused);
  EXPECT_GT(count.sampled, count.accepted - count.open);
  EXPECT_EQ(count.missed, 0);
}

}  // namespace
}  // namespace corank
