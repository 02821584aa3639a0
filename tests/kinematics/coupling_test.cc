// Gears, joints that mimic others, parallelograms: planted motions against the assembled robot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "corank/kinematics/language/part_file.h"
#include "corank/kinematics/urdf/urdf.h"
#include "corank/tests/kinematics/assembled.h"

namespace corank::kinematics {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kArm =
    "[LINKS]\nbase\nupper\nfore\n[JOINTS]\n"
    "revolute a : base (0,0,0)+(0,0,1) upper (0,0,0)+(0,0,1) actuated\n"
    "revolute b : upper (3,0,0)+(0,0,1) fore (0,0,0)+(0,0,1)\n";

Transform placed_at(double x, double y, double z, const Transform& turned) {
  Transform result = turned;
  result.p = {x, y, z};
  return result;
}

// Equal links, the elbow turning back twice the shoulder's angle: Scott Russell's straight line.
TEST(Gears, LeadAlongAStraightLine) {
  const Assembly a =
      assembled(std::string(kArm) + "gear : a b ratio -2\n[OUTPUTS]\nhand : position of fore (3,0,0) only x\n");
  EXPECT_THAT(coordinate_names(a), ElementsAre("a", "hand_x"));
  EXPECT_EQ(a.mobility, 1);
  EXPECT_EQ(a.mobility_by_joints, 1);
  const auto values = completed(a, {{"a", 0.7}});
  EXPECT_NEAR(values.at("hand_x"), 6 * std::cos(0.7), 1e-12);
  const Transform fore = pose_of(a, "fore", values);
  EXPECT_NEAR(fore.p[1] + 3 * fore.r[1][0], 0, 1e-12);
}

// By 3/2 both are back where they began after two turns of a: the coordinate is the half of its angle.
TEST(Gears, OfRationalRatiosShareAPartOfTheAngle) {
  const Assembly a = assembled(std::string(kArm) + "gear train : a b ratio 3/2 offset 30deg\n");
  EXPECT_THAT(coordinate_names(a), ElementsAre("a_over_2"));
  EXPECT_THAT(a.mechanism.inputs(), ElementsAre("a_over_2"));
  const double t = 0.4;
  const auto values = completed(a, {{"a_over_2", t}});
  const Transform upper = turn({0, 0, 1}, 2 * t);
  expect_same(pose_of(a, "upper", values), upper, "upper");
  expect_same(pose_of(a, "fore", values), upper * placed_at(3, 0, 0, turn({0, 0, 1}, 3 * t + M_PI / 6)), "fore");
  ASSERT_EQ(a.joint_values.size(), 2u);
  EXPECT_NEAR(symbolic::evaluate(a.joint_values[1].value, values), 3 * t + M_PI / 6, 1e-12);
}

// Ranges are of the joints' own angles: a in [-1, 1] and b = a/2 + 1/4 in [0, 3/5] leave a/2 in [-1/4, 7/20].
TEST(Gears, LeaveWhatAllRangesLeave) {
  const Assembly a = assembled(
      "[LINKS]\nbase\nupper\nfore\n[JOINTS]\n"
      "revolute a : base (0,0,0)+(0,0,1) upper (0,0,0)+(0,0,1) range [-1, 1]\n"
      "revolute b : upper (3,0,0)+(0,0,1) fore (0,0,0)+(0,0,1) range [0, 3/5] actuated mimic a ratio 1/2 offset 1/4\n");
  ASSERT_THAT(coordinate_names(a), ElementsAre("a_over_2"));
  const symbolic::Coordinate& c = a.mechanism.coordinates()[0];
  EXPECT_NEAR(symbolic::evaluate(c.lower, {}), -0.25, 1e-12);
  EXPECT_NEAR(symbolic::evaluate(c.upper, {}), 0.35, 1e-12);
}

// In space, three joints in one train on skew axes, one of them told against the way to the ground.
TEST(Gears, InSpaceTurnAsTheProductOfTheirJoints) {
  const std::string text =
      "[LINKS]\nbase\nl1\nl2\nl3\n[JOINTS]\n"
      "revolute a : base (0,0,1)+(0,0,1) l1 (0,0,0)+(0,0,1) actuated\n"
      "revolute b : l1 (2,0,0)+(0,1,0) l2 (0,0,0)+(0,1,0) zero (1,0,0) (1,0,0)\n"
      "revolute c : l3 (0,0,0)+(1,0,0) l2 (1,0,1)+(3/5,0,4/5) zero (0,1,0) (0,1,0)\n"
      "gear : a b ratio 2\ngear : b c ratio -1/3 offset 1/5\n";
  const Robot robot = parse_parts(text, "r.cuik");
  const Assembly a = assemble(robot);
  EXPECT_EQ(a.space, Space::spatial);
  EXPECT_EQ(a.mobility, 1);
  for (const double t : {-2.0, 0.3, 1.4}) {
    const auto values = completed(a, {{"a_over_3", t}});
    Transform l1 = joint_motion(robot.joints[0], 3 * t, 0);
    Transform l2 = l1 * joint_motion(robot.joints[1], 6 * t, 0);
    Transform l3 = l2 * inverse(joint_motion(robot.joints[2], -2 * t + 0.2, 0));
    expect_same(pose_of(a, "l1", values), l1, "l1");
    expect_same(pose_of(a, "l2", values), l2, "l2");
    expect_same(pose_of(a, "l3", values), l3, "l3");
  }
}

// The twist of what is geared: w_tool = w_a (axis a + 2 axis b), by a difference quotient.
TEST(Gears, RatesFollowAsTheAnglesDo) {
  const Assembly a = assembled(
      "[LINKS]\nbase\nl1\nl2\n[JOINTS]\n"
      "revolute a : base (0,0,0)+(0,0,1) l1 (0,0,0)+(0,0,1) actuated\n"
      "revolute b : l1 (2,0,0)+(0,1,0) l2 (0,0,0)+(0,1,0) zero (1,0,0) (1,0,0)\n"
      "gear : a b ratio 2/3\n[OUTPUTS]\np : position of l2 (1,0,0)\n");
  std::vector<std::string> rates;
  for (const symbolic::Rate& r : a.mechanism.rates()) rates.push_back(r.name);
  EXPECT_THAT(rates, ElementsAre("w_a", "v_p_x", "v_p_y", "v_p_z"));
  const double t = 0.6, h = 1e-6;
  const auto before = completed(a, {{"a_over_3", t - h}}), after = completed(a, {{"a_over_3", t + h}});
  auto values = completed(a, {{"a_over_3", t}});
  values["w_a"] = 3;
  for (const char* x : {"x", "y", "z"})
    values[std::string("v_p_") + x] = (after.at(std::string("p_") + x) - before.at(std::string("p_") + x)) / (2 * h);
  ASSERT_EQ(a.mechanism.velocity_equations().size(), 3u);
  for (const symbolic::Constraint& row : a.mechanism.velocity_equations())
    EXPECT_NEAR(symbolic::evaluate(row.relation.lhs, values), symbolic::evaluate(row.relation.rhs, values), 1e-8);
}

TEST(Gears, SlidingJointsFollowByAnyRatio) {
  const Assembly a = assembled(
      "[CONSTANTS]\nk := sqrt(2)\n[LINKS]\nbase\nleft\nright\n[JOINTS]\n"
      "prismatic s : base (0,0,0)+(1,0,0) left (0,0,0)+(1,0,0) range [0, 1] actuated\n"
      "prismatic r : base (0,0,0)+(1,0,0) right (0,0,0)+(1,0,0) mimic s ratio -k offset 1/2\n");
  EXPECT_THAT(coordinate_names(a), ElementsAre("s"));
  EXPECT_NEAR(pose_of(a, "right", completed(a, {{"s", 0.3}})).p[0], 0.5 - 0.3 * std::sqrt(2), 1e-12);
}

// A four-bar whose rocker is geared to its crank: the train's joints close a loop, by an equation.
TEST(Gears, MayCloseALoop) {
  const Assembly a = assembled(
      "[LINKS]\nground\ncrank\ncoupler\nrocker\n[JOINTS]\n"
      "revolute t1 : ground (0,0,0)+(0,0,1) crank (0,0,0)+(0,0,1) actuated\n"
      "revolute e : crank (1,0,0)+(0,0,1) coupler (0,0,0)+(0,0,1)\n"
      "revolute f : coupler (3,0,0)+(0,0,1) rocker (2,0,0)+(0,0,1)\n"
      "revolute t2 : ground (5/2,0,0)+(0,0,1) rocker (0,0,0)+(0,0,1)\n"
      "gear : t1 e ratio -1\n");
  EXPECT_EQ(a.mobility, 0);
  EXPECT_EQ(a.mobility_by_joints, 0);
}

TEST(Parallelograms, KeepTheOrientationAndCircle) {
  const Assembly a = assembled(
      "[CONSTANTS]\nl := 2\n[LINKS]\nbase\ncoupler\nhand\n[JOINTS]\n"
      "parallelogram p : base (1,0,0)+(0,0,1) coupler (0,1,0)+(0,0,1) length l actuated\n"
      "revolute q : coupler (3,0,0)+(0,0,1) hand (0,0,0)+(0,0,1) actuated\n"
      "[OUTPUTS]\nh : position of hand (1,0,0)\n");
  EXPECT_EQ(a.space, Space::planar);
  EXPECT_EQ(a.mobility, 2);
  EXPECT_EQ(a.mobility_by_joints, 2);
  const auto values = completed(a, {{"p", 0.5}, {"q", -1.1}});
  const Transform coupler = placed_at(1 + 2 * std::cos(0.5), 2 * std::sin(0.5) - 1, 0, {});
  expect_same(pose_of(a, "coupler", values), coupler, "coupler");
  expect_same(pose_of(a, "hand", values), coupler * placed_at(3, 0, 0, turn({0, 0, 1}, -1.1)), "hand");
}

// A palletizer: two parallelograms behind each other on a turning column; its hand stays level.
TEST(Parallelograms, OnATurningColumnAreAPalletizer) {
  const Assembly a = assembled(
      "[CONSTANTS]\nunit mm\n[LINKS]\nbase\ncol\nbracket\nhand\n[JOINTS]\n"
      "revolute j1 : base (0,0,0)+(0,0,1) col (0,0,0)+(0,0,1) actuated\n"
      "parallelogram j2 : col (260,0,565)+(0,1,0) bracket (0,0,0)+(0,1,0) length 850 zero (0,0,1) "
      "range [-40deg, 85deg] actuated\n"
      "parallelogram j3 : bracket (0,0,0)+(0,1,0) hand (0,0,0)+(0,1,0) length 950 zero (1,0,0) actuated\n"
      "[OUTPUTS]\nW : position of hand\n");
  EXPECT_EQ(a.space, Space::spatial);
  EXPECT_EQ(a.mobility, 3);
  EXPECT_EQ(a.mechanism.velocity_equations().size(), 3u);
  const double j1 = 0.3, j2 = 0.4, j3 = -0.2, h = 1e-6;
  const auto truth = [](double q1, double q2, double q3) {  // about y: from z towards x, from x away from z
    return turn({0, 0, 1}, q1) *
           placed_at(260 + 850 * std::sin(q2) + 950 * std::cos(q3), 0, 565 + 850 * std::cos(q2) - 950 * std::sin(q3), {});
  };
  auto values = completed(a, {{"j1", j1}, {"j2", j2}, {"j3", j3}});
  expect_same(pose_of(a, "hand", values), truth(j1, j2, j3), "hand");
  const double rates[3] = {0.7, -1.2, 0.5};
  const Transform before = truth(j1 - h * rates[0], j2 - h * rates[1], j3 - h * rates[2]);
  const Transform after = truth(j1 + h * rates[0], j2 + h * rates[1], j3 + h * rates[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    values["w_j" + std::to_string(i + 1)] = rates[i];
    values[std::string("v_W_") + "xyz"[i]] = (after.p[i] - before.p[i]) / (2 * h);
  }
  for (const symbolic::Constraint& row : a.mechanism.velocity_equations())
    EXPECT_NEAR(symbolic::evaluate(row.relation.lhs, values), symbolic::evaluate(row.relation.rhs, values), 1e-4);
}

// Two of them with bars of different lengths hold one coupler that keeps its orientation.
TEST(Parallelograms, CloseLoops) {
  const Assembly a = assembled(
      "[LINKS]\nbase\ncoupler\n[JOINTS]\n"
      "parallelogram p : base (0,0,0)+(0,0,1) coupler (0,0,0)+(0,0,1) length 2 actuated\n"
      "parallelogram r : base (3,0,0)+(0,0,1) coupler (3,1,0)+(0,0,1) length 1\n[OUTPUTS]\nr : joint r\n");
  EXPECT_THAT(coordinate_names(a), ElementsAre("p", "r"));
  EXPECT_EQ(a.mechanism.constraints().size(), 2u);
  EXPECT_EQ(a.mobility, 0);
}

TEST(Couplings, FaultsSayWhereAndWhatWasExpected) {
  const std::string arm = kArm;
  const std::vector<std::array<std::string, 3>> cases{
      {arm + "gear : a b ratio sqrt(2)\n", "r.cuik:8:1: the ratio sqrt(2) by which the joint 'b' follows 'a'",
       "would never come back to where they began; expected a ratio of whole numbers"},
      {arm + "gear : a b ratio 25\n", "r.cuik:8:1: joints that follow 'a' turn too often", "at most 24 turns of each"},
      {arm + "gear : a b ratio 7/25\n", "r.cuik:8:1: joints that follow 'a' turn too often", "small numbers"},
      {arm + "gear : a b\n", "r.cuik:9:1: found the end of the text", "ratio and a number"},
      {arm + "gear : a ratio 2\n", "r.cuik:8:16: found", "ratio and a number"},
      {arm + "gear : a bb ratio 2\n", "r.cuik:8:10: there is no joint 'bb'", "the name of the joint that follows"},
      {arm + "gear : a b ratio 1-1\n", "r.cuik:8:1: the ratio by which the revolute joint 'b' follows", "a fixed joint"},
      {arm + "gear : a b ratio 2\ngear : b a ratio 1/2\n",
       "r.cuik:9:1: the revolute joint 'a' follows the revolute joint 'b', "
       "which follows it",
       "a joint that leads"},
      {arm + "actuated gear : a b ratio 2\n",
       "r.cuik:7:1: the revolute joint 'b' and the revolute joint 'a' are actuated, but turn "
       "together",
       "one of joints"},
      {arm + "gear : a b ratio 2\n[OUTPUTS]\nt : joint b\n",
       "r.cuik:10:1: the output 't' is of the revolute joint 'b', which "
       "turns with an actuated one",
       "a joint that no actuator drives"},
      {arm + "mimic c\n", "r.cuik:8:7: there is no joint 'c'", "the name of the joint that leads"},
      {arm + "range [1, 2] mimic a\nrevolute c : base (0,0,0)+(0,0,1) upper (0,0,0)+(0,0,1) mimic a ratio 2 range [-1, 0]\n",
       "r.cuik:6:1: the ranges of the joints that follow 'a' leave it no position", "ranges that agree"},
      {arm + "parallelogram : base (0,0,0)+(0,0,1) fore (0,0,0)+(0,0,1)\n", "r.cuik:8:1: the parallelogram has no length",
       "length l"},
      {arm + "parallelogram p : base (0,0,0)+(0,0,1) fore (0,0,0)+(0,0,1) length 0\n",
       "r.cuik:8:1: the length of the parallelogram joint 'p', '0', is 0", "a length above 0"}};
  for (const auto& [text, begin, expectation] : cases) {
    EXPECT_THAT(fault_of(text), testing::StartsWith(begin)) << text;
    EXPECT_THAT(fault_of(text), HasSubstr(expectation)) << text;
  }
}

TEST(Couplings, UrdfsMimicIsOne) {
  const auto robot = [](const std::string& mimic) {
    return parse_urdf(
        "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>\n"
        "<joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint>\n"
        "<joint name='k' type='continuous'><parent link='b'/><child link='c'/><axis xyz='0 0 1'/>\n"
        "<mimic joint='j' " +
            mimic + "/></joint></robot>",
        "r.urdf");
  };
  Robot r = robot("multiplier='-0.3333333' offset='1.5708'");
  ASSERT_EQ(r.couplings.size(), 1u);
  EXPECT_EQ(r.couplings[0].ratio.text(), "-1/3");
  EXPECT_EQ(r.couplings[0].offset.text(), "pi/2");
  EXPECT_THAT(r.notices, testing::Contains(HasSubstr("read as -1/3")));
  r = robot("");
  EXPECT_EQ(r.couplings[0].ratio.text(), "1");
  EXPECT_EQ(r.couplings[0].offset.text(), "0");
  r.joints[0].actuated = true;
  EXPECT_THAT(coordinate_names(assemble(r)), ElementsAre("j"));
}

}  // namespace
}  // namespace corank::kinematics
