// Random spatial robots of one loop, built about a configuration that is known exactly. Their equations have to hold at it.
#include <gtest/gtest.h>

#include <iostream>

#include "corank/tests/seeds.h"

#include "corank/tests/robots/planted_robot.h"

namespace corank {
namespace {

using kinematics::Joint;
using kinematics::JointKind;
using test::coordinates;
using test::NumericMechanism;
using test::Planted;
using test::VectorXd;

const std::array<JointKind, 6> kKinds{JointKind::revolute,  JointKind::prismatic,   JointKind::universal,
                                      JointKind::spherical, JointKind::cylindrical, JointKind::slot};

TEST(PlantedRobots, SatisfyTheirEquationsWhereTheyWerePlanted) {
  const unsigned seeds = test::seeds(5);
  int checked = 0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(seed);
    std::vector<JointKind> kinds(std::uniform_int_distribution<std::size_t>(5, 7)(random));
    for (JointKind& kind : kinds)  // half of them revolute
      kind = random() % 2 == 0 ? JointKind::revolute : kKinds[random() % kKinds.size()];
    const Planted planted(seed, kinds, true);
    std::string names = "seed " + std::to_string(seed) + ":";
    for (const Joint& j : planted.robot.joints) names += std::string(" ") + to_string(j.kind) + (j.actuated ? "*" : "");
    SCOPED_TRACE(names);
    std::optional<kinematics::Assembly> assembly;
    try {
      assembly = kinematics::assemble(planted.robot);
    } catch (const symbolic::ModelError& error) {
      ADD_FAILURE() << error.what();
      continue;
    }
    const auto x = coordinates(planted, *assembly);
    if (!x) {
      ADD_FAILURE() << "the coordinates do not put the links where they were planted";
      continue;
    }
    const NumericMechanism numeric(assembly->mechanism);
    ASSERT_EQ(static_cast<Eigen::Index>(numeric.system().variables.size()), x->size());
    const VectorXd f = numeric.values(*x);
    EXPECT_LT(f.lpNorm<Eigen::Infinity>(), 1e-9);
    EXPECT_GT(numeric.least_inequality(*x), -1e-9);
    ++checked;
  }
  std::cout << checked << " robots hold at their planted configuration\n";
}

}  // namespace
}  // namespace corank
