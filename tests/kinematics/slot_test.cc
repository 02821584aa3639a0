// Pins in slots and balls in tubes, against a slotted lever's closed form and planted poses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/tests/kinematics/assembled.h"

namespace corank::kinematics {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A quick return: the pin of a crank of length 1 about (0, 2) drives a lever about the origin.
std::string quick_return(const std::string& slot) {
  return "[LINKS]\nbase\ncrank\nlever\n[JOINTS]\nrevolute drive : base (0,2,0)+(0,0,1) crank (0,0,0)+(0,0,1) actuated\n"
         "revolute swing : base (0,0,0)+(0,0,1) lever (0,0,0)+(0,0,1)\n" +
         slot + "\n[OUTPUTS]\nswing : joint swing\n";
}

TEST(Slots, LetALeverFollowThePinOfACrank) {
  const Assembly a = assembled(quick_return("slot s : lever (1/2,0,0)+(1,0,0) crank (1,0,0) range [0, 3]"));
  EXPECT_EQ(a.space, Space::planar);
  EXPECT_EQ(a.mobility, 1);
  EXPECT_EQ(a.mobility_by_joints, 1);
  EXPECT_THAT(coordinate_names(a), ElementsAre("drive", "swing", "s"));
  for (const double drive : {0.3, 2.0, -1.2}) {
    const double x = std::cos(drive), y = 2 + std::sin(drive);
    const auto values = completed(a, {{"drive", drive}, {"swing", std::atan2(y, x)}, {"s", std::hypot(x, y) - 0.5}});
    expect_same(pose_of(a, "lever", values), turn({0, 0, 1}, std::atan2(y, x)), "lever");
  }
}

TEST(Slots, MayMoveAndCarryALinkInThePlane) {
  const Assembly a = assembled(
      "[LINKS]\nbase\nyoke\nhand\n[JOINTS]\nprismatic p : base (0,0,0)+(1,0,0) yoke (0,0,0)+(1,0,0) actuated\n"
      "slot s : yoke (1,0,0)+(0,3,0) hand (0,1,0) actuated\nrevolute : base (0,0,5)+(0,0,1) hand (0,0,5)+(0,0,1)\n");
  EXPECT_EQ(a.space, Space::planar);
  EXPECT_EQ(a.mobility_by_joints, 1);
  EXPECT_EQ(a.mobility, 1);
}

// On the ground as a block on its rail, elsewhere as a line to the pin.
TEST(Slots, AreDrawn) {
  using Kind = symbolic::DrawingPart::Kind;
  const auto drawn = [](const std::string& slot, Kind kind) {
    const Assembly a = assembled(quick_return(slot));
    return std::ranges::count(a.mechanism.drawing().parts, kind, &symbolic::DrawingPart::kind);
  };
  EXPECT_EQ(drawn("slot s : base (0,0,0)+(1,0,0) crank (1,0,0) range [0, 3]", Kind::slider), 1);
  EXPECT_EQ(drawn("slot s : lever (0,0,0)+(1,0,0) crank (1,0,0) range [0, 3]", Kind::slider), 0);
  EXPECT_EQ(drawn("slot s : lever (0,0,0)+(1,0,0) crank (1,0,0) range [0, 3]", Kind::joint), 1);
}

// Space: each joint of a chain says where the next link is; the ball is where the slot says.
TEST(Slots, HoldABallOnALineInSpace) {
  const Assembly a = assembled(
      "[LINKS]\nbase\narm\nhand\n[JOINTS]\nrevolute q : base (0,0,0)+(1,0,0) arm (0,0,0)+(1,0,0) zero (0,1,0) (0,1,0) "
      "actuated\n"
      "slot s : arm (0,1,2)+(0,2,0) hand (3,0,1) range [-1, 1] actuated\n[OUTPUTS]\nball : position of hand (3,0,1)\n");
  EXPECT_EQ(a.space, Space::spatial);
  EXPECT_EQ(a.mobility_by_joints, 5);
  EXPECT_EQ(a.mobility, 5);
  const double q = 0.7, s = -0.4;
  std::map<std::string, double> values{{"q", q}, {"s", s}};
  for (const symbolic::Coordinate& c : a.mechanism.coordinates())  // the hand as the world
    for (const std::string of : {"w_hand_x", "u_hand_y", "n_hand_z"})
      if (c.name.starts_with(of.substr(0, 6))) values.emplace(c.name, 0).first->second += c.name == of ? 1 : 0;
  const Transform ball = turn({1, 0, 0}, q) * placed_at(0, 1 + s, 2, {});
  const Numbers at = pose_of(a, "hand", completed(a, values)).p;
  const Numbers expected{ball.p[0] - 3, ball.p[1], ball.p[2] - 1};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(at[i], expected[i], 1e-9) << i;
}

TEST(Slots, FaultsSayWhereAndWhatWasExpected) {
  EXPECT_THAT(fault_of(quick_return("slot : lever (0,0,0)+(0,0,0) crank (1,0,0)")),
              HasSubstr("r.cuik:8:1: the axis of the slot joint 'lever–crank' on the link 'lever' has the length 0"));
  EXPECT_THAT(fault_of(quick_return("slot : lever (0,0,0)+(1,0,0) crank")), HasSubstr("r.cuik:9:1: found '['"));
  EXPECT_THAT(fault_of(quick_return("slot : lever (0,0,0)+(1,0,0) crank (1,0,0) zero (1,0,0) (1,0,0)")),
              HasSubstr("none: the joint has no angle of its own"));
  EXPECT_THAT(fault_of(quick_return("slot s : lever (0,0,0)+(1,0,0) crank (1,0,0)\ngear : drive s ratio 1")),
              HasSubstr("two joints that turn, revolute or parallelogram, or two prismatic ones"));
}

}  // namespace
}  // namespace corank::kinematics
