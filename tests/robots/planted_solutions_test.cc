// Random robots, solved: the configuration about which each was built has to lie in a box, and what a box is proven to hold
// has to satisfy the joints, by their geometry alone.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <functional>
#include <iostream>

#include "corank/solve/search/solve.h"
#include "corank/study/question.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/tests/robots/planted_robot.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using kinematics::Assembly;
using kinematics::Joint;
using kinematics::JointKind;
using test::NumericMechanism;
using test::Planted;
using test::VectorXd;

using Values = std::map<std::string, double>;

Vector3d vector(const kinematics::Vector& v, const Values& values) {
  return {symbolic::evaluate(v[0], values), symbolic::evaluate(v[1], values), symbolic::evaluate(v[2], values)};
}

/// How far the joints are from being kept: the links stand where the mechanism's coordinates say, the rest is geometry.
double open_by(const kinematics::Robot& robot, const Assembly& assembly, const Values& values) {
  struct Placed {
    Matrix3d turned;
    Vector3d at;
  };
  std::vector<Placed> links;
  double gap = 0;
  for (const Assembly::LinkPose& pose : assembly.poses) {
    Placed& link = links.emplace_back();
    link.at = vector(pose.origin, values);
    for (int i = 0; i < 3; ++i) link.turned.row(i) = vector(pose.rotation[static_cast<std::size_t>(i)], values).transpose();
    gap = std::max({gap, (link.turned * link.turned.transpose() - Matrix3d::Identity()).norm(),
                    std::fabs(link.turned.determinant() - 1)});
  }
  for (const Joint& j : robot.joints) {
    std::array<Vector3d, 2> p, a;
    for (std::size_t i = 0; i < 2; ++i) {
      const Placed& link = links[j.ends[i].link];
      p[i] = link.at + link.turned * vector(j.ends[i].point, values);
      a[i] = (link.turned * vector(j.ends[i].axis, values)).normalized();
    }
    const Vector3d way = p[1] - p[0];
    const auto ask = [&](double off) { gap = std::max(gap, std::fabs(off)); };
    switch (j.kind) {
      case JointKind::revolute: ask(std::max(way.norm(), (a[1] - a[0]).norm())); break;
      case JointKind::cylindrical: ask(std::max(way.cross(a[0]).norm(), (a[1] - a[0]).norm())); break;
      case JointKind::prismatic:
        ask(std::max(way.cross(a[0]).norm(), (links[j.ends[0].link].turned - links[j.ends[1].link].turned).norm()));
        break;
      case JointKind::universal: ask(std::max(way.norm(), std::fabs(a[0].dot(a[1])))); break;
      case JointKind::spherical: ask(way.norm()); break;
      case JointKind::slot: ask(way.cross(a[0]).norm()); break;
      case JointKind::distance: ask(way.norm() - symbolic::evaluate(j.length, values)); break;
      default: ADD_FAILURE() << "an unknown joint";
    }
  }
  return gap;
}

/// The planted configuration in all variables. Where the links stand does not say all of them: one may be the angle of an
/// axis that no pose is written with. Newton's method finds such ones from the equations, with the others held.
std::optional<VectorXd> configuration(const Planted& planted, const Assembly& assembly, const NumericMechanism& numeric) {
  auto x = coordinates(planted, assembly);
  if (!x || numeric.values(*x).lpNorm<Eigen::Infinity>() < 1e-10) return x;
  const auto unsaid = test::kernel(NumericMechanism(where_planted(planted, assembly)).jacobian(*x));
  std::vector<Eigen::Index> said;
  for (Eigen::Index i = 0; i < x->size(); ++i)
    if (unsaid.row(i).norm() < 1e-6) said.push_back(i);
  std::mt19937 random(5);
  for (int attempt = 0; attempt < 20; ++attempt) {
    VectorXd start = numeric.random_point(random);
    for (const Eigen::Index i : said) start[i] = (*x)[i];
    if (const auto found = numeric.solution(start, said)) return found;
  }
  return std::nullopt;
}

struct Tally {
  int robots = 0, complete = 0, planted = 0, proven = 0, checked = 0;
};

/// Of an `isolated` or `regular` box: the solution that its proof is about, for one value of the free variables, is there.
void expect_true(const Planted& planted, const Assembly& assembly, const NumericMechanism& numeric, const Cover& cover,
                 const CoverBox& b) {
  const Box& region = b.region >= 0 ? cover.regions[static_cast<std::size_t>(b.region)] : b.box;
  VectorXd x(static_cast<Eigen::Index>(region.size()));
  for (std::size_t i = 0; i < region.size(); ++i) x[static_cast<Eigen::Index>(i)] = region[i].mid();
  std::vector<Eigen::Index> free(b.free.begin(), b.free.end());
  for (const Eigen::Index i : free) x[i] = b.box[static_cast<std::size_t>(i)].mid();
  const auto solution = numeric.solution(x, free);
  ASSERT_TRUE(solution) << "no solution near a " << to_string(b.verdict) << " box";
  for (std::size_t i = 0; i < region.size(); ++i) {
    const double value = (*solution)[static_cast<Eigen::Index>(i)];
    ASSERT_TRUE(region[i].lo() - 1e-7 <= value && value <= region[i].hi() + 1e-7)
        << numeric.system().variables[i].name << ", in a " << to_string(b.verdict) << " box";
  }
  ASSERT_LT(open_by(planted.robot, assembly, numeric.named(*solution)), 1e-8) << "a joint of a proven posture is open";
}

void check(const Planted& planted, Tally& tally) {
  const Assembly assembly = kinematics::assemble(planted.robot);
  const System system = study::system({.model = assembly.mechanism, .assembly = assembly});
  const NumericMechanism numeric(assembly.mechanism);
  ++tally.robots;
  solve::Options options;
  options.max_boxes = 20000;
  options.sigma = 0.1;
  const Cover cover = solve::solve(system, options);
  tally.complete += cover.complete();

  // Where it was built.
  const auto x = configuration(planted, assembly, numeric);
  ASSERT_TRUE(x) << "the coordinates do not put the links where they were planted";
  ASSERT_LT(open_by(planted.robot, assembly, numeric.named(*x)), 1e-9);
  const auto held = std::find_if(cover.boxes.begin(), cover.boxes.end(), [&](const CoverBox& b) {
    for (std::size_t i = 0; i < b.box.size(); ++i) {
      const double value = (*x)[static_cast<Eigen::Index>(i)];
      if (value < b.box[i].lo() - 1e-9 || value > b.box[i].hi() + 1e-9) return false;
    }
    return true;
  });
  ASSERT_NE(held, cover.boxes.end()) << "the configuration in which it was built is in none of " << cover.boxes.size()
                                     << " boxes";
  ++tally.planted;

  // What is proven, of many boxes some.
  const auto is_proven = [](const CoverBox& b) { return b.verdict == Verdict::isolated || b.verdict == Verdict::regular; };
  tally.proven += is_proven(*held);
  for (std::size_t i = 0, step = cover.boxes.size() / 8 + 1; i < cover.boxes.size(); i += step) {
    if (!is_proven(cover.boxes[i])) continue;
    expect_true(planted, assembly, numeric, cover, cover.boxes[i]);
    ++tally.checked;
    if (testing::Test::HasFailure()) return;
  }
}

class PlantedSolutions : public testing::Test {
 protected:
  static void check_many(const std::function<Planted(unsigned)>& plant, unsigned count) {
    // CORANK_SEEDS=1000 ./robots_test --gtest_filter='PlantedSolutions.*' looks further.
    const unsigned seeds = test::seeds(count);
    Tally tally;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      try {
        check(plant(seed), tally);
      } catch (const symbolic::ModelError& error) {
        ADD_FAILURE() << error.what();
      }
    }
    std::cout << tally.robots << " robots: " << tally.complete << " solved completely, " << tally.planted
              << " planted configurations found, " << tally.proven << " of them in proven boxes; " << tally.checked
              << " proven boxes checked\n";
    EXPECT_EQ(tally.planted, tally.robots);
    EXPECT_GT(tally.complete, tally.robots * 3 / 4);
    EXPECT_GT(tally.proven, tally.robots / 2);
    EXPECT_GT(tally.checked, tally.robots);
  }
};

TEST_F(PlantedSolutions, OfPlanarRobotsAreFound) { check_many(Planted::planar, 20); }

TEST_F(PlantedSolutions, OfSphericalRobotsAreFound) { check_many(Planted::spherical, 20); }

TEST_F(PlantedSolutions, OfSpatialRobotsAreFound) { check_many(Planted::spatial, 20); }

// Too large to be solved here: the planted configuration has to keep the equations, and what keeps them the joints.
TEST(PlantedPlatforms, OnTwoRodsEachHaveTheirEquations) {
  const unsigned seeds = test::seeds(4);
  int found = 0, held = 0;
  std::mt19937 random(3);
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Planted planted = Planted::on_two_rods_each(seed);
    const Assembly assembly = kinematics::assemble(planted.robot);
    const NumericMechanism numeric(assembly.mechanism);
    const auto x = configuration(planted, assembly, numeric);
    ASSERT_TRUE(x);
    EXPECT_LT(numeric.values(*x).lpNorm<Eigen::Infinity>(), 1e-9);
    held += test::kernel(numeric.jacobian(*x)).cols() == 0;
    for (int k = 0; k < 3; ++k) {
      const auto other = numeric.random_configuration(random, 10);
      if (!other) continue;
      ++found;
      EXPECT_LT(open_by(planted.robot, assembly, numeric.named(*other)), 1e-8);
    }
  }
  EXPECT_GT(found, static_cast<int>(seeds) / 2);
  EXPECT_GE(held, static_cast<int>(seeds) * 3 / 4) << "a crank whose rod is on its axis is not held";
}

}  // namespace
}  // namespace corank
