// What texts of the parts language mean.
#include "corank/kinematics/language/part_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <tao/pegtl/contrib/analyze.hpp>

#include "corank/kinematics/equations/assembly.h"
#include "corank/kinematics/language/part_grammar.h"
#include "corank/tests/kinematics/read_robot.h"

namespace corank::kinematics {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string text_of(const Vector& v) { return v[0].text() + ", " + v[1].text() + ", " + v[2].text(); }

Robot parse(const std::string& text) { return parse_parts(text, "r.cuik"); }

/// Links a (the ground) and b, each with a point P; a joint between them in line 5.
Robot with_joint(const std::string& joint, const std::string& file = "r.cuik") {
  return parse_parts("[CONSTANTS] l := 2\n[LINKS]\na: point P (1, 0, 0)\nb: point P (l, 0, 0) [JOINTS]\n" + joint, file);
}

// A two-link arm in the plane, with all that corank adds to the suite's language.
const char* const kWholeArm = R"(
% An arm with two links.
[CONSTANTS]
unit mm
upper_length := 300   # also a comment
[LINKS]
base : grey
  point S (0, 0, 0)
  sphere 10 S 0.5*red
upper : point S (0, 0, 0)
        point E (upper_length, 0, 0)
        cylinder 5 S E blue
fore : point E (0, 0, 0)  point H (200, 0, 0)
pen
[JOINTS]
revolute shoulder : base S + (0, 0, 1)  upper S + (0, 0, 1)  actuated  limits [-pi/2, pi/2]
REVOLUTE elbow : upper E + (0, 0, 1)  fore E + (0, 0, 1)
revolute wrist : fore H + (0, 0, 1)  pen (0, 0, 0) (0, 0, 1)
[INPUTS] elbow
[OUTPUTS]
hand : position of fore.H
turn : orientation of fore in upper
all  : pose of fore.H in base
w    : direction of fore (1, 0, 0)
t    : joint wrist
)";

TEST(PartFile, AnglesMayBeInDegrees) {
  const Robot robot = parse(
      "[CONSTANTS]\ndeg := PI/180\ntilt := 30*deg\n[LINKS]\na\nb\n[JOINTS]\n"
      "revolute t : a (0,0,0)+(0,0,1) b (0,0,0)+(0,0,1) limits [-tilt, 22.5deg]\n");
  ASSERT_EQ(robot.constants.size(), 1u);
  EXPECT_EQ(robot.constants[0].value.text(), "30*(pi/180)");
  EXPECT_EQ(robot.joints[0].ranges[0]->upper.text(), "pi/8");
}

TEST(PartFile, ReadsNamedPointsAndJointsInputsAndOutputs) {
  const Robot robot = parse(kWholeArm);
  EXPECT_EQ(robot.unit, "mm");
  EXPECT_EQ(robot.name, "r");
  ASSERT_EQ(robot.links.size(), 4u);
  EXPECT_EQ(robot.links[1].name, "upper");
  ASSERT_EQ(robot.joints.size(), 3u);
  const Joint& shoulder = robot.joints[0];
  EXPECT_EQ(shoulder.name, "shoulder");
  EXPECT_TRUE(shoulder.is_named);
  EXPECT_TRUE(shoulder.actuated);
  ASSERT_EQ(shoulder.ranges.size(), 1u);
  EXPECT_EQ(shoulder.ranges[0]->lower.text(), "-pi/2");
  EXPECT_EQ(shoulder.where.line, 16);
  const Joint& elbow = robot.joints[1];
  EXPECT_TRUE(elbow.actuated) << "[INPUTS] says so";
  EXPECT_EQ(elbow.ends[0].link, 1u);
  EXPECT_EQ(elbow.ends[1].link, 2u);
  EXPECT_EQ(text_of(elbow.ends[0].point), "upper_length, 0, 0");
  EXPECT_EQ(text_of(elbow.ends[0].axis), "0, 0, 1");
  ASSERT_EQ(robot.outputs.size(), 5u);
  EXPECT_EQ(robot.outputs[0].kind, Output::Kind::position);
  EXPECT_EQ(robot.outputs[0].link, 2u);
  EXPECT_EQ(robot.outputs[0].relative_to, 0u);
  EXPECT_EQ(text_of(robot.outputs[0].point), "200, 0, 0");
  EXPECT_EQ(robot.outputs[1].kind, Output::Kind::orientation);
  EXPECT_EQ(robot.outputs[1].relative_to, 1u);
  EXPECT_EQ(robot.outputs[2].kind, Output::Kind::pose);
  EXPECT_EQ(robot.outputs[3].kind, Output::Kind::direction);
  EXPECT_EQ(robot.outputs[4].kind, Output::Kind::joint);
  EXPECT_EQ(robot.outputs[4].joint, 2u);
  EXPECT_THAT(robot.notices, IsEmpty());
  EXPECT_THAT(robot.missing, IsEmpty());
}

TEST(PartFile, CountsAnglesBetweenTheXAxesWhereBothAxesAreZ) {
  const Robot robot = parse(kWholeArm);
  for (const Joint& joint : robot.joints) {
    for (const JointEnd& end : joint.ends) {
      ASSERT_TRUE(end.zero);
      EXPECT_EQ(text_of(*end.zero), "1, 0, 0");
    }
  }
}

TEST(PartFile, ReadsShapesWithTheirColours) {
  const Robot robot = parse(kWholeArm);
  ASSERT_EQ(robot.links[0].shapes.size(), 1u);
  EXPECT_EQ(robot.links[0].shapes[0].kind, Shape::Kind::sphere);
  EXPECT_EQ(robot.links[0].shapes[0].colour, "#800000");
  EXPECT_EQ(robot.links[1].shapes[0].kind, Shape::Kind::cylinder);
  EXPECT_EQ(robot.links[1].shapes[0].colour, "#0000ff");
  EXPECT_EQ(robot.links[1].shapes[0].radius.text(), "5");
  const Robot shapes = parse(
      "[LINKS]\na: 0.5*white box (0,0,0)+(1,2,3) prism (0,0,0) (1,0,0) (0,1,0) 2 color (1,0.2,0) line (0,0,0) (1,1,1) "
      "hidden "
      "segments (0,0,0; 1,0,0; 2,0,0; 3,0,0) red+blue sphere 1 (0,0,0) granularity 5 decoration");
  const std::vector<Shape>& list = shapes.links[0].shapes;
  ASSERT_EQ(list.size(), 6u + 5u + 2u + 1u) << "six sides, five sides, nothing hidden, two lines, a sphere";
  EXPECT_EQ(list[0].colour, "#808080");
  EXPECT_EQ(text_of(list[1].points[0]), "1, 2, 3");
  EXPECT_EQ(list[6].colour, "#ff3300");
  EXPECT_EQ(list[11].points.size(), 2u);
  EXPECT_EQ(list[11].colour, "#ff00ff");
}

TEST(PartFile, ReadsAnAxisAsTwoPointsOrAsAPointAndADirection) {
  for (const char* const end : {"a (1, 0, 0) (1, 0, 1)", "a P + (0, 0, 1)", "a P (1, 0, 1)", "a (1,0,0)+(0,0,1)"}) {
    const Robot robot = with_joint(std::string("revolute: ") + end + " b (0, 0, 0) (0, 0, 1)");
    EXPECT_EQ(text_of(robot.joints[0].ends[0].point), "1, 0, 0") << end;
    EXPECT_THAT(text_of(robot.joints[0].ends[0].axis), ::testing::AnyOf("0, 0, 1")) << end;
    EXPECT_EQ(robot.joints[0].name, "J1");
    EXPECT_FALSE(robot.joints[0].is_named);
    EXPECT_FALSE(robot.joints[0].ends[0].zero) << "nobody asks for the angle";
  }
}

TEST(PartFile, ReadsTheRangeOfARevoluteJointWithItsReferences) {
  const Robot robot = with_joint("revolute: a (1,0,0) (2,0,0) b (0,0,0) (0,1,0) range [0, pi/2] (1,0,1) + (1,0,0)");
  const Joint& joint = robot.joints[0];
  EXPECT_EQ(text_of(*joint.ends[0].zero), "0, 0, 1") << "from the end's point to the reference";
  EXPECT_EQ(text_of(*joint.ends[1].zero), "1, 0, 0");
  EXPECT_EQ(joint.ranges[0]->upper.text(), "pi/2");
  const Robot unlimited = with_joint("revolute: a (1,0,0) (2,0,0) b (0,0,0) (0,1,0) reference (1,0,1) +(1,0,0)");
  EXPECT_THAT(unlimited.joints[0].ranges, IsEmpty());
  EXPECT_EQ(text_of(*unlimited.joints[0].ends[0].zero), "0, 0, 1");
  const Robot zero = with_joint("revolute: a P+(1,0,0) b P+(0,1,0) zero (0,0,1) (1,0,0) limits [0,1] velocity 2 torque 1");
  EXPECT_EQ(text_of(*zero.joints[0].ends[0].zero), "0, 0, 1");
  EXPECT_THAT(zero.notices, ElementsAre(HasSubstr("dynamics")));
  EXPECT_THAT(zero.notices[0], HasSubstr(": 2 times"));
}

TEST(PartFile, ReadsReferencesThatAreNamedPoints) {
  for (const char* const option : {"reference R S", "range [0, pi/2] R S"}) {
    const Robot robot =
        parse(std::string("[LINKS]\na: point P (1,0,0) point Q (2,0,0) point R (1,0,1)\nb: point S (1,0,0)\n[JOINTS]\n"
                          "revolute: a P Q b (0,0,0) (0,1,0) ") +
              option);
    EXPECT_EQ(text_of(*robot.joints[0].ends[0].zero), "0, 0, 1") << option;
    EXPECT_EQ(text_of(*robot.joints[0].ends[1].zero), "1, 0, 0") << option;
    EXPECT_EQ(text_of(robot.joints[0].ends[1].axis), "0, 1, 0") << option;
  }
}

TEST(PartFile, ReadsEveryKindOfJoint) {
  const Robot universal =
      with_joint("UNIVERSAL: a (0,0,0) (1,0,0) b (0,0,0) (0,1,0) range [-1,1] (0,0,1) [-2,2] (0,0,-1) avoid limits 0.5");
  EXPECT_EQ(universal.joints[0].kind, JointKind::universal);
  ASSERT_EQ(universal.joints[0].ranges.size(), 2u);
  EXPECT_EQ(universal.joints[0].ranges[1]->upper.text(), "2");
  EXPECT_EQ(text_of(*universal.joints[0].ends[1].zero), "0, 0, -1");
  EXPECT_THAT(universal.notices, ElementsAre(HasSubstr("avoid limits")));

  const Robot spherical = with_joint("SPHERICAL: a (0,0,0) b P range [pi/16] (0,0,1) +(1,0,0) avoid limits");
  EXPECT_EQ(spherical.joints[0].kind, JointKind::spherical);
  EXPECT_EQ(spherical.joints[0].ranges[0]->lower.text(), "0");
  EXPECT_EQ(spherical.joints[0].ranges[0]->upper.text(), "pi/16");
  EXPECT_EQ(text_of(spherical.joints[0].ends[0].axis), "0, 0, 1");
  EXPECT_EQ(text_of(spherical.joints[0].ends[1].axis), "1, 0, 0");

  const Robot prismatic = with_joint("prismatic slide: a P+(1,0,0) b (0,0,0)+(2,0,0) range [-l, l] actuated");
  EXPECT_EQ(prismatic.joints[0].kind, JointKind::prismatic);
  EXPECT_TRUE(prismatic.joints[0].actuated);

  const Robot cylindrical = with_joint("cylindrical: a P+(1,0,0) b P+(0,1,0) range [0,1] [2,3] zero (0,0,1) (0,0,1)");
  EXPECT_EQ(cylindrical.joints[0].kind, JointKind::cylindrical);
  EXPECT_EQ(cylindrical.joints[0].ranges[1]->lower.text(), "2");

  EXPECT_EQ(with_joint("planar: a P+(0,0,1) b P+(0,0,1)").joints[0].kind, JointKind::planar);

  const Robot rod = with_joint("sph_sph leg: a P b (0,0,0) length 2*l radius 0.1 blue");
  EXPECT_EQ(rod.joints[0].kind, JointKind::distance);
  EXPECT_EQ(rod.joints[0].name, "leg");
  EXPECT_EQ(rod.joints[0].length.text(), "2*l");

  const Robot actuator = with_joint("sph_prs_sph: a P b P+(0,0,1) range [1, 3] radius 0.1 actuated");
  EXPECT_EQ(actuator.joints[0].kind, JointKind::distance_variable);
  EXPECT_EQ(text_of(actuator.joints[0].ends[1].point), "l, 0, 1");
  EXPECT_EQ(actuator.joints[0].ranges[0]->upper.text(), "3");
}

TEST(PartFile, MultipliesTransformationsExactly) {
  const Robot robot = with_joint("fix: a b Txyz(1,2,3)*Rz(pi/2)*Tx(l)*id*Rx(0.3)");
  const Pose& pose = robot.joints[0].pose;
  EXPECT_EQ(robot.joints[0].kind, JointKind::fixed);
  EXPECT_EQ(text_of(pose.translation), "1, l + 2, 3") << "Rz(pi/2) turns x into y";
  EXPECT_EQ(text_of(pose.rotation[0]), "0, -cos(0.3), sin(0.3)");
  EXPECT_EQ(text_of(pose.rotation[1]), "1, 0, 0");
  EXPECT_EQ(text_of(pose.rotation[2]), "0, sin(0.3), cos(0.3)");
  const Robot inverse = with_joint("FIX: a b TR(0,-1,0,5; 1,0,0,0; 0,0,1,0)^-1");
  EXPECT_EQ(text_of(inverse.joints[0].pose.rotation[0]), "0, 1, 0");
  EXPECT_EQ(text_of(inverse.joints[0].pose.translation), "0, 5, 0");
}

TEST(PartFile, ReadsFunctionsInCapitalsAndSignsBeforeNumbers) {
  const Robot robot = parse("[CONSTANTS]\na := SIN(PI/6) + +2 - (+1)\nb := a ^ 2 PRINT a\n[LINKS] x: point P (b, -a, +1)");
  ASSERT_EQ(robot.constants.size(), 2u);
  EXPECT_EQ(robot.constants[0].value.text(), "sin(pi/6) + 2 - 1");
}

TEST(PartFile, PassesOverWhatIsNoGeometryWithOneNoticeForEachKind) {
  const Robot robot = parse(
      "[LINKS]\na: sphere 1 (0,0,0) mass 2 inertia matrix 1,0,0,1,0,1 inertial frame Tx(1)*Rz(2)\n"
      "b: body \"b.off\" red inertia matrix solid cylinder_x 1,2\n[OBSTACLES] o: sphere 1 (0,0,0) p: body \"x.off\"\n"
      "[JOINTS] revolute: a (0,0,0)+(0,0,1) b (0,0,0)+(0,0,1)\nc_spring s: a (0,0,0) b (0,0,0) radius 1 rest 1 stiffness 2\n"
      "[COLLISIONS] do not check: all  check: a,b  do not check : selfcollisions check: o");
  EXPECT_THAT(robot.notices, ElementsAre("dynamics (masses, inertia, velocities, forces …): 6 times",
                                         "bodies whose files are not there: once", "obstacles: 2 times",
                                         "springs (c_spring): once", "collision checks: 4 times"));
}

TEST(PartFile, SaysWhatIsMissingAndReadsTheRest) {
  const Robot robot = parse(
      "[LINKS] a b\n[JOINTS] revolute: a (0,0,0)+(0,0,1) b (0,0,0)+(0,0,1) range [0,1] +(1,0,0)+(1,0,0)\n"
      "crevolute: a (0,0,0)+(0,0,1) b (0,0,0)+(0,0,1) range [0,1] +(1,0,0)+(1,0,0)\nc_cable c: a (0,0,0) b (0,0,0) radius "
      "1\n"
      "[EQUATIONS] EQFILE: \"more.cuik\"");
  EXPECT_THAT(robot.missing, ElementsAre(HasSubstr("r.cuik:3:1: the coupling of the crevolute joint"),
                                         HasSubstr("r.cuik:4:1: a cable (c_cable)"),
                                         HasSubstr("r.cuik:5:21: the equations of 'more.cuik'")));
  EXPECT_EQ(robot.joints.size(), 2u);
  try {
    assemble(robot);
    FAIL() << "assembled";
  } catch (const symbolic::ModelError& error) {
    EXPECT_THAT(error.what(), HasSubstr("r.cuik: part of the robot is missing: r.cuik:3:1: the coupling"));
    EXPECT_THAT(error.what(), HasSubstr("and 2 more"));
  }
}

TEST(PartFile, ReadsWhatCanBeAssembled) {
  std::string text = kWholeArm;  // but for what is an input too, twice there, or an output in space only
  for (const char* const output : {"turn :", "all  :", "w    :"}) {
    const std::size_t line = text.find(output);
    text.erase(line, text.find('\n', line) - line);
  }
  const Assembly assembly = assemble(parse(text));
  EXPECT_EQ(assembly.space, Space::planar);
  EXPECT_EQ(assembly.mobility, 3);
}

TEST(PartFile, KeepsTheFramesOfAPrismaticJointParallelInAWorldFile) {
  const char* const joint = "prismatic: a (0,0,0)+(0,1,0) b (0,0,0)+(0,0,1) range [0,1]";
  const Robot robot = with_joint(joint, "r.world");
  EXPECT_EQ(text_of(robot.joints[0].ends[1].axis), "0, 1, 0");
  EXPECT_THAT(robot.notices, ElementsAre(HasSubstr("second axes of prismatic joints")));
  EXPECT_THROW(with_joint(joint), symbolic::ModelError);
}

TEST(PartFile, LeavesOutFloatingLinksOfAWorldFile) {
  const std::string text = "[LINKS] a can b [JOINTS] spherical: b (0,0,0) a (0,0,0)";
  const Robot robot = parse_parts(text, "r.world");
  ASSERT_EQ(robot.links.size(), 2u);
  EXPECT_EQ(robot.joints[0].ends[0].link, 1u);
  EXPECT_THAT(robot.notices, ElementsAre(HasSubstr("'can' is left out")));
  EXPECT_THROW(parse(text), symbolic::ModelError);
}

TEST(PartFile, ReadsLatin1InAWorldFileOnly) {
  const std::string text = "% caf\xE9\n[LINKS] a";
  EXPECT_EQ(parse_parts(text, "r.world").links.size(), 1u);
  EXPECT_THROW(parse(text), symbolic::ModelError);
}

TEST(PartFile, KnowsATextWithParts) {
  EXPECT_TRUE(has_parts(kWholeArm));
  EXPECT_TRUE(has_parts("% \"\n[ links ]"));
  EXPECT_TRUE(has_parts("[INCLUDE] a : \"b.world\""));
  EXPECT_FALSE(has_parts("% [LINKS]\n/* [LINKS] */ \"[LINKS]\" [SYSTEM VARS]"));
  EXPECT_FALSE(has_parts(""));
  EXPECT_FALSE(has_parts("/* [LINKS]"));
}

TEST(PartFile, HasAGrammarThatAlwaysMovesForward) { EXPECT_EQ(tao::pegtl::analyze<grammar::parts>(), 0u); }

// Files in a folder of their own.
class PartFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("parts_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "bodies");
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  fs::path folder_;
};

TEST_F(PartFolder, IncludedRobotsKeepTheirNamesBehindAPrefix) {
  write("arm.world",
        "[CONSTANTS] l := 1\n[LINKS] base hand: point P (l,0,0)\n"
        "[JOINTS] revolute turn: base (0,0,0)+(0,0,1) hand P+(0,0,1)");
  const Robot robot = read_part_file(
      write("two.cuik",
            "[LINKS] floor\n[INCLUDE] left: \"arm.world\" right: \"arm.world\"\n[JOINTS] fix: floor left::base id\n"
            "fix: floor right::base Tx(left::l)\n[INPUTS] left::turn\n[OUTPUTS] p: position of right::hand.P"));
  ASSERT_EQ(robot.links.size(), 5u);
  EXPECT_EQ(robot.name, "two");
  EXPECT_EQ(robot.links[2].name, "left__hand");
  EXPECT_EQ(robot.constants[1].name, "right__l");
  EXPECT_EQ(robot.joints[0].name, "left__turn");
  EXPECT_TRUE(robot.joints[0].actuated);
  EXPECT_EQ(robot.joints[1].ends[1].link, 4u);
  EXPECT_EQ(text_of(robot.joints[1].ends[1].point), "right__l, 0, 0");
  EXPECT_EQ(text_of(robot.joints[3].pose.translation), "left__l, 0, 0");
  EXPECT_EQ(robot.outputs[0].link, 4u);
  EXPECT_EQ(robot.links[1].where.file, (folder_ / "arm.world").string());
}

TEST_F(PartFolder, JointsMayNameTheVerticesOfBodies) {
  write("bodies/t.off", "OFF # a triangle\n3 1 3\n0 0 0\n1.5 0 0\n0 -2e0 .5\n3 0 1 2 255 0 0\n");
  const Robot robot = read_part_file(write("r.world",
                                           "[LINKS] a: body \"bodies/t.off\" green\nb: cylinder 1 (0,0,0) (0,1,0) body "
                                           "\"bodies/t.off\" hidden box (0,0,0) (1,2,3)\n"
                                           "[JOINTS] revolute: a 0 1 b 1:0 1:2\nrevolute: a 1 0 b 2:6 1"));
  EXPECT_EQ(text_of(robot.joints[0].ends[0].axis), "1.5, 0, 0");
  EXPECT_EQ(text_of(robot.joints[0].ends[1].axis), "0, -2e0, 0.5");
  EXPECT_EQ(text_of(robot.joints[1].ends[1].point), "1, 2, 3") << "corner 6 of the box";
  ASSERT_EQ(robot.links[0].shapes.size(), 1u);
  EXPECT_EQ(robot.links[0].shapes[0].points.size(), 3u);
  EXPECT_EQ(robot.links[0].shapes[0].colour, "#00ff00");
  EXPECT_EQ(robot.links[1].shapes.size(), 1u + 6u);
}

TEST_F(PartFolder, LargeBodiesAreNotDrawn) {
  std::string off = "OFF\n3 65 0\n0 0 0\n1 0 0\n0 1 0\n";
  for (int i = 0; i < 65; ++i) off += "3 0 1 2\n";
  write("large.off", off);
  const Robot robot = read_part_file(write("r.world", "[LINKS] a: body \"large.off\""));
  EXPECT_THAT(robot.links[0].shapes, IsEmpty());
  EXPECT_THAT(robot.notices, ElementsAre(HasSubstr("more than 64 faces")));
}

TEST_F(PartFolder, EquationsComeFromAFileOfTheirOwn) {
  write("more.cuik", "[CONSTANTS]\nk := 2\n[SYSTEM EQS]\nsin(turn) = k/3;\n");
  const Robot robot = read_part_file(
      write("r.cuik",
            "[LINKS] a b [JOINTS] revolute turn: a (0,0,0)+(0,0,1) b (0,0,0)+(0,0,1)\n[EQUATIONS] eqfile: \"more.cuik\""));
  ASSERT_EQ(robot.equations.size(), 1u);
  EXPECT_EQ(robot.equations[0].relation.lhs.text(), "sin(turn)");
  EXPECT_EQ(robot.constants[0].name, "k");
  EXPECT_THAT(robot.missing, IsEmpty());
  write("more.cuik", "[SYSTEM VARS]\nx : [0, 1]\n[SYSTEM EQS]\nx = 0;\n");
  EXPECT_THAT(read_part_file(folder_ / "r.cuik").missing, ElementsAre(HasSubstr("variables of its own")));
}

}  // namespace
}  // namespace corank::kinematics
