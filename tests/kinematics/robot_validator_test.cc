// What Robot::validate refuses in robots that are built in C++, and what it accepts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/kinematics/robot/robot.h"
#include "corank/kinematics/robot/vectors.h"

namespace corank::kinematics {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string message_of(const Robot& robot) {
  try {
    robot.validate();
  } catch (const symbolic::ModelError& error) {
    return error.what();
  }
  return "accepted";
}

/// A crank on the ground: (0,0,1) is the axis.
Robot crank() {
  Robot robot;
  robot.link("ground");
  robot.revolute("turn", "ground", {0, 0, 0}, {0, 0, 1}, "crank", {"l", 0, 0}, {0, 0, 2});
  robot.constants = {{"l", "0.1", {}}};
  return robot;
}

TEST(RobotValidator, AcceptsARobotWithoutFaults) { EXPECT_EQ(message_of(crank()), "accepted"); }

TEST(RobotValidator, NamesTheRobotWhereNothingHasAPlace) {
  EXPECT_THAT(message_of(Robot()), StartsWith("robot: the robot has no links"));
}

TEST(RobotValidator, EvaluatesWithTheRobotsConstants) {
  Robot robot = crank();
  robot.joints[0].ends[0].axis = {0, 0, "l - 1/10"};
  EXPECT_THAT(message_of(robot), HasSubstr("the axis of the revolute joint 'turn' on the link 'ground' has the length 0"));
  robot.constants[0].value = "0.2";
  EXPECT_EQ(message_of(robot), "accepted");
  robot.constants.clear();
  EXPECT_THAT(message_of(robot), HasSubstr("the name 'l' in the axis of the revolute joint 'turn'"));
}

TEST(RobotValidator, RefusesAnAxisThatIsZeroThoughNoDecimalSaysSo) {
  Robot robot = crank();
  robot.joints[0].ends[1].axis = {"sqrt(2)*sqrt(3) - sqrt(6)", "sin(1)^2 + cos(1)^2 - 1", 0};
  EXPECT_THAT(message_of(robot), HasSubstr("has the length 0"));
  robot.joints[0].ends[1].axis = {"sqrt(2) - 1.41421356237309504880168872420969807857", 0, 0};
  EXPECT_EQ(message_of(robot), "accepted");
}

TEST(RobotValidator, RefusesLinksAndEndsThatAreNotThere) {
  Robot robot = crank();
  robot.joints[0].ends[1].link = 7;
  EXPECT_THAT(message_of(robot), HasSubstr("has an end on a link that is not there"));
  robot = crank();
  robot.joints[0].ends[1].link = 0;
  EXPECT_THAT(message_of(robot), HasSubstr("connects the link 'ground' with itself"));
  robot = crank();
  robot.links.push_back(robot.links[1]);
  EXPECT_THAT(message_of(robot), HasSubstr("there are two links 'crank'"));
  robot = crank();
  robot.joints.push_back(robot.joints[0]);
  EXPECT_THAT(message_of(robot), HasSubstr("there are two joints 'turn'"));
  robot = crank();
  robot.link("loose");
  EXPECT_THAT(message_of(robot), HasSubstr("no joint connects the link 'loose' with the first link, 'ground'"));
}

TEST(RobotValidator, RefusesTooManyOrEmptyRanges) {
  Robot robot = crank();
  robot.joints[0].ranges = {Range{0, 1}, Range{0, 1}};
  EXPECT_THAT(message_of(robot), HasSubstr("has 2 ranges; expected at most one"));
  robot.joints[0].ranges = {Range{"pi", 3}};
  EXPECT_THAT(message_of(robot), HasSubstr("is empty: 'pi' is above '3'"));
  robot.joints[0].ranges = {std::nullopt};
  EXPECT_EQ(message_of(robot), "accepted");
  robot.joints[0].ranges = {Range{"sqrt(2)*sqrt(2)", 2}};
  EXPECT_EQ(message_of(robot), "accepted") << "one value";
}

TEST(RobotValidator, TellsRotationsFromOtherMatrices) {
  Robot robot;
  robot.link("ground");
  const Pose three = rotation(0, "0.3") * rotation(1, "1.1") * rotation(2, "pi/5") * translation({1, 2, 3});
  robot.fix("ground", "hand", three);
  EXPECT_EQ(message_of(robot), "accepted") << "sin² + cos² = 1 at any angle";
  robot.joints[0].pose = inverse(three);
  EXPECT_EQ(message_of(robot), "accepted");
  robot.joints[0].pose = Pose{};
  robot.joints[0].pose.rotation = {{{"sqrt(1/2)", "-sqrt(1/2)", 0}, {"sqrt(1/2)", "sqrt(1/2)", 0}, {0, 0, 1}}};
  EXPECT_EQ(message_of(robot), "accepted");
  robot.joints[0].pose.rotation[0] = {"0.70710678118654752440", "-0.70710678118654752440", 0};
  EXPECT_THAT(message_of(robot), HasSubstr("is not a rotation and translation: row 1 does not have the length 1"));
  robot.joints[0].pose = Pose{};
  robot.joints[0].pose.rotation[2] = {0, 0, -1};
  EXPECT_THAT(message_of(robot), HasSubstr("the matrix is a reflection"));
}

TEST(RobotValidator, RefusesRodsWithoutLengthAndLegsOfNegativeLength) {
  Robot robot;
  robot.link("ground");
  robot.rod("rod", "ground", {0, 0, 0}, "hand", {0, 0, 0}, Expression("1 - 1"));
  EXPECT_THAT(message_of(robot),
              HasSubstr("the length of the sph_sph joint 'rod', '1 - 1', is 0; expected a length above 0"));
  robot.joints[0].length = "2";
  EXPECT_EQ(message_of(robot), "accepted");
  robot.rod("leg", "ground", {1, 0, 0}, "hand", {1, 0, 0}, std::nullopt).ranges = {Range{-1, 1}};
  EXPECT_THAT(message_of(robot), HasSubstr("the range of the sph_prs_sph joint 'leg' begins with '-1', which is negative"));
}

TEST(RobotValidator, RefusesWhatCannotBeDrivenOrAskedFor) {
  Robot robot = crank();
  robot.fix("crank", "hand", {}).actuated = true;
  EXPECT_THAT(message_of(robot), HasSubstr("the fix joint 'crank_hand' cannot be actuated"));
  robot.joints[1].actuated = false;
  Output output;
  output.name = "p";
  output.link = 9;
  robot.outputs = {output};
  EXPECT_THAT(message_of(robot), HasSubstr("the output 'p' is of a link that is not there"));
  robot.outputs[0].link = 0;
  EXPECT_THAT(message_of(robot), HasSubstr("the output 'p' is of the link 'ground' in itself"));
  robot.outputs[0].link = 2;
  robot.outputs[0].kind = Output::Kind::direction;
  EXPECT_THAT(message_of(robot), HasSubstr("the direction of the output 'p' has the length 0"));
  robot.outputs[0].kind = Output::Kind::joint;
  robot.outputs[0].joint = 5;
  EXPECT_THAT(message_of(robot), HasSubstr("the output 'p' is of a joint that is not there"));
  robot.outputs[0].joint = 0;
  EXPECT_EQ(message_of(robot), "accepted");
}

TEST(RobotValidator, RefusesAZeroDirectionAlongTheAxis) {
  Robot robot = crank();
  robot.joints[0].ends[0].zero = Vector{"l", 0, 1};
  EXPECT_EQ(message_of(robot), "accepted") << "what is across the axis counts";
  robot.joints[0].ends[0].zero = Vector{0, 0, -3};
  EXPECT_THAT(message_of(robot), HasSubstr("lies along the axis"));
  robot.joints[0].ends[0].zero = Vector{0, 0, 0};
  EXPECT_THAT(message_of(robot),
              HasSubstr("the zero direction of the revolute joint 'turn' on the link 'ground' has the length 0"));
}

}  // namespace
}  // namespace corank::kinematics
