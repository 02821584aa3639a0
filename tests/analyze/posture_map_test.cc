// How many postures an arm has over planes of its hand's positions: proven numbers against searches at random points.
#include "corank/analyze/postures/posture_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "corank/tests/analyze/data_sheet_arms.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using ::testing::HasSubstr;
using Kind = MapCellAnswer::Kind;

// About a position, so wide in x and z.
MapQuestion plane(const Arm& arm, const Vector3d& about, double width, const Rotation& orientation) {
  const auto side = [&](const char* name, int k) {
    return symbolic::Parameter{name, exact(about[k] - width / 2), exact(about[k] + width / 2)};
  };
  return posture_map(arm_question(arm), {side("tool_x", 0), side("tool_z", 2)}, {{"tool_y", exact(about[1])}}, orientation,
                     "");
}

TEST(PostureMap, HasTheNumbersOfSearchesAtPoints) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI), part(0, 1);
  int proven = 0, wrong = 0;
  for (const Arm& arm : arms()) {
    SCOPED_TRACE(arm.name);
    const PostureFinder finder = finder_of(arm_question(arm));
    const unsigned planes = test::seeds(2);
    for (unsigned n = 0; n < planes; ++n) {
      const Joints made_by = Joints(Joints::NullaryExpr([&] { return angle(random); }));
      const Matrix4d goal = hand(arm, made_by);
      const Pose pose = pose_of(goal);
      const Vector3d about = goal.topRightCorner<3, 1>();
      solve::Control control;
      const ParameterMap map =
          parameter_map(plane(arm, about, 0.02, pose.orientation), {.resolution = 8, .boundary = false}, control);
      EXPECT_EQ(map.set, "postures");
      EXPECT_TRUE(map.complete);
      for (std::size_t k = 0; k < map.cells.size(); k += 7) {
        const MapCellAnswer& cell = map.cells[k];
        if (cell.kind != Kind::proven) continue;
        const auto at = [&](std::size_t side) {
          return exact(cell.sides[side].lo() + part(random) * (cell.sides[side].hi() - cell.sides[side].lo()));
        };
        const Postures found = finder.find({at(0), exact(about[1]), at(1)}, pose.orientation, control);
        if (found.at_most() != found.at_least()) continue;
        ++proven;
        wrong += found.at_least() != cell.count;
      }
    }
  }
  EXPECT_GT(proven, 20);
  EXPECT_EQ(wrong, 0);
}

TEST(PostureMap, IsProvenByACertificate) {
  const Arm& gofa = arms()[3];
  const Matrix4d goal = hand(gofa, Joints{0.4, 0.9, -0.4, 0.8, 1.3, -0.5});
  const Pose pose = pose_of(goal);
  const MapQuestion question = plane(gofa, goal.topRightCorner<3, 1>(), 0.01, pose.orientation);
  solve::Control control;
  const ParameterMap map = parameter_map(question, {.resolution = 8, .boundary = false, .certificate = true}, control);
  ASSERT_GT(map.proven_share(), 0.5);
  result::MapFile file = to_file(question, map);
  EXPECT_TRUE(verify(file).failures.empty());
  for (auto& cell : file.claims.cells) cell.count += 1;
  EXPECT_FALSE(verify(file).failures.empty());
}

TEST(PostureMap, IsThereForArmsOfSixJointsOnly) {
  const study::Model model = study::parse_model(
      {"[CONSTANTS]\nunit m\n[DH]\nstandard\na alpha d theta\n1 90deg 0 q1\n1 0 0 q2\n1 0 0 q3\n", "arm.cuik"});
  const study::Question question{.model = model.mechanism, .assembly = model.assembly};
  const std::vector<symbolic::Parameter> over{{"tool_x", 0, 1}, {"tool_z", 0, 1}};
  try {
    posture_map(question, over, {{"tool_y", 0}}, parse_rotation("Rz(0.3)"), "");
    FAIL();
  } catch (const symbolic::ModelError& e) {
    EXPECT_THAT(e.what(), HasSubstr("no such link has its orientation as output"));
  }
}

}  // namespace
}  // namespace corank::analyze
