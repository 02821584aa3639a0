// Malformed robots: each gets one line that says where, what is wrong and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "corank/kinematics/language/part_file.h"
#include "corank/tests/kinematics/read_robot.h"

namespace corank::kinematics {
namespace {

using symbolic::ModelError;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct FaultCase {
  const char* name;
  std::string text;
  const char* place;        ///< line:column
  const char* problem;      ///< the beginning of the message behind the place
  const char* expectation;  ///< in the message behind "expected"
};

std::ostream& operator<<(std::ostream& out, const FaultCase& fault) { return out << fault.name; }

/// Constants in line 2.
std::string constants(const std::string& line) { return "[CONSTANTS]\n" + line + "\n[LINKS]\na\n"; }
/// Links from line 2 on.
std::string links(const std::string& lines) { return "[LINKS]\n" + lines + "\n"; }
/// Joints from line 5 on, between the links hand, arm (with a point P) and base.
std::string joints(const std::string& lines) {
  return "[LINKS]\nbase\narm: point P (1, 0, 0)\nhand: [JOINTS]\n" + lines + "\n";
}
/// Further sections from line 6 on; the joint `turn` between base and arm, a fixed one between arm and hand.
std::string sections(const std::string& lines) {
  return joints("revolute turn: base (0,0,0)+(0,0,1) arm P+(0,0,1) fix hold: arm hand id") + lines + "\n";
}

std::vector<FaultCase> faults() {
  const std::string turn = "revolute turn: base (0,0,0)+(0,0,1) arm P+(0,0,1) ";
  return {
      // the file as a whole
      {"Empty", "", "0:0", "the robot has no links", "at least one, in [LINKS]"},
      {"TextBeforeTheFirstSection", "\nrobot", "2:1", "found 'robot' before the first section", "[LINKS]"},
      {"OpenComment", "[LINKS]\na /* one", "2:3", "the comment that begins here with /* has no end", "*/"},
      {"OpenCommentWhereTheGrammarLooksAhead", "[LINKS]\na: point /* one", "2:10",
       "the comment that begins here with /* has no end", "*/"},
      {"NotUtf8", "[LINKS] % caf\xE9\n", "1:14", "found the byte 0xE9", "plain text in UTF-8"},
      {"UnknownSection", "[LINK]\na", "1:1", "section [LINK] is unknown beside [LINKS]", "did you mean 'LINKS'?"},
      {"EquationsOfAModel", "[LINKS]\na\n[SYSTEM EQS]\nx = 1;", "3:1", "section [SYSTEM EQS] is unknown beside [LINKS]",
       "[CONSTANTS], [LINKS]"},
      // constants
      {"ConstantWithoutAssign", constants("l = 1"), "2:3", "found '='", "':=' after the constant's name"},
      {"ConstantWithAUnit", constants("l := 100 cm\nb := 1 m"), "3:1", "found 'b'",
       "':=' after the constant's name; a number has no unit behind it"},
      {"ConstantTwice", constants("l := 1\nl := 2"), "3:1", "the constant 'l' is already defined in line 2", "another name"},
      {"UnknownConstant", constants("length1 := 1\nb := lenght1"), "3:6", "the constant 'lenght1' is not defined before",
       "did you mean 'length1'?"},
      {"ReservedConstant", constants("sin := 1"), "2:1", "the name 'sin' is reserved", "another name"},
      {"DivisionByZero", constants("b := 1/0"), "2:6", "'1/0' has no real value: division by zero", "a real number"},
      {"EnormousPower", constants("b := 9^9^9^9"), "2:10", "the exponent", "at most 1000"},
      {"FunctionThatIsNotSupported", constants("b := atan2(1, 2)"), "2:6", "the function 'atan2' is not supported",
       "sin, cos"},
      {"FunctionWithoutArgument", constants("b := sin + 1"), "2:10", "found '+'", "'(' after the function sin"},
      {"TwoUnits", constants("unit mm\nunit cm"), "3:6", "the unit 'mm' is already given", "the same unit"},
      // links and shapes
      {"LinkTwice", links("a: sphere 1 (0,0,0)\na"), "3:1", "the link 'a' is already there, in line 2", "another name"},
      {"LinkWithTheNameOfAConstant", "[CONSTANTS] a := 1 [LINKS]\na", "2:1", "the link 'a' has the name of a constant",
       "another name"},
      {"UnknownColour", links("a: sphere 1 (0,0,0) rad"), "2:21", "found 'rad' in the line of the link 'a'",
       "did you mean 'red'?"},
      {"UnknownColourBehindAFactor", links("a: sphere 1 (0,0,0) 0.5*orange"), "2:25", "'orange' is not a colour",
       "red, green"},
      {"UnknownShape", links("a: sphre 1 (0,0,0)"), "2:4", "found 'sphre' in the line of the link 'a'",
       "did you mean 'sphere'?"},
      {"SphereWithoutCentre", links("a: sphere 1 red"), "2:13", "the link 'a' has no point 'red'", "(x, y, z)"},
      {"PointOfTwoNumbers", links("a: sphere 1 (0, 1)"), "2:18", "found ')'", "',' between the three numbers"},
      {"NegativeRadius", links("a: sphere -1 (0,0,0)"), "2:4", "the radius of a shape of the link 'a', '-1', is negative",
       "a positive radius"},
      {"BodyWithoutQuotes", links("a: body x.off"), "2:9", "found 'x'", "the name of the body's file, in quotes"},
      {"OpenQuotes", links("a: body \"x.off"), "2:15", "found the end of the line", "'\"' after the name of the file"},
      {"PointTwice", links("a: point P (0,0,0) point P (1,0,0)"), "2:26", "the link 'a' has already a point 'P'",
       "another name"},
      {"UnknownPointInAShape", links("a: point P (0,0,0) sphere 1 Q"), "2:29", "the link 'a' has no point 'Q'", "(x, y, z)"},
      {"LinkThatNoJointHolds", links("a\nlonely"), "3:1", "no joint connects the link 'lonely'", "joints from every link"},
      // joints
      {"UnknownKind", joints("revolut: base (0,0,0)+(0,0,1) arm P+(0,0,1)"), "5:1", "'revolut' is not a kind of joint",
       "did you mean 'revolute'?"},
      {"UnsupportedKind", joints("in_patch: base"), "5:1", "joints of the kind 'in_patch' are not supported", "revolute"},
      {"UnsupportedSpring", joints("spring s: base"), "5:1", "joints of the kind 'spring' are not supported", "revolute"},
      {"JointWithoutColon", joints("revolute turn base (0,0,0)"), "5:15", "found 'base'", "':' after the joint's name"},
      {"UnknownLink", joints("revolute: bass (0,0,0)+(0,0,1) arm P+(0,0,1)"), "5:11", "there is no link 'bass'",
       "did you mean 'base'?"},
      {"JointOfALinkWithItself", joints("revolute: arm P+(0,0,1) arm P+(0,0,1)"), "5:25",
       "the revolute joint connects the link 'arm' with itself", "two different links"},
      {"JointWithOneEnd", joints("revolute turn: base (0,0,0)+(0,0,1)"), "6:1", "the revolute joint 'turn' has one end only",
       "two links"},
      {"JointWithOneEndBeforeAnother", joints("revolute: base (0,0,0)+(0,0,1)\nfix: base arm id"), "6:1",
       "the revolute joint has one end only", "two links"},
      {"JointWithThreeEnds", joints(turn + "\nhand (0,0,0)+(0,0,1)"), "6:1",
       "found a third end of the revolute joint 'turn', on the link 'hand'", "two ends"},
      {"UnknownOption", joints(turn + "actuatd"), "5:51",
       "'actuatd' is neither a kind of joint nor an option of the revolute joint 'turn'", "did you mean 'actuated'?"},
      {"AxisOfOnePoint", joints("revolute: base (0,0,0) arm P+(0,0,1)"), "5:24",
       "the end of the revolute joint on the link 'base' has one point", "two points of the axis"},
      {"AxisWithoutItsLastPoint", joints("revolute: base (0,0,0)+(0,0,1) arm P"), "6:1",
       "the axis of the revolute joint on the link 'arm' has one point", "a second point"},
      {"UnknownPoint", joints("revolute: base (0,0,0)+(0,0,1) arm Q+(0,0,1)"), "5:36", "the link 'arm' has no point 'Q'",
       "a point named in the link: P"},
      {"AxisOfLengthZero", joints("revolute: base (0,0,0) (0,0,0) arm P+(0,0,1) fix: base hand id"), "5:1",
       "the axis of the revolute joint 'base–arm' on the link 'base' has the length 0", "a direction"},
      {"PrismaticAxesThatDiffer", joints("prismatic: base (0,0,0)+(1,0,0) arm P+(0,0,1)"), "5:1",
       "the prismatic joint has axes of different directions", "one direction"},
      {"RangeWithoutNumbers", joints(turn + "range velocity 1"), "5:57",
       "the range of the revolute joint 'turn' has no numbers", "[lower, upper]"},
      {"RangeOfOneNumber", joints(turn + "range [1]"), "5:57", "the range of the revolute joint 'turn' has one number",
       "[lower, upper]"},
      {"EmptyRange", joints(turn + "range [1, -1]"), "5:57", "the range of the revolute joint 'turn' is empty",
       "[lower, upper]"},
      {"TwoRanges", joints(turn + "range [0, 1] [0, 2]"), "5:64", "the revolute joint 'turn' has 2 ranges", "at most one"},
      {"OneRangeOfAUniversalJoint", joints("universal: base (0,0,0)+(1,0,0) arm P+(0,1,0) range [0,1] +(0,0,1)"), "5:53",
       "the universal joint has one range", "one for each angle"},
      {"RangeOfAFixedJoint", joints("fix: base arm id range [0, 1]"), "5:24", "the fix joint has one range", "none"},
      {"OneReference", joints(turn + "range [0, 1] + (1,0,0)"), "5:64", "the revolute joint 'turn' has 1 reference",
       "one for each end"},
      {"RangeWithoutReferences", joints("revolute: base (0,0,0)+(1,0,0) arm P+(0,0,1) range [0, 1]"), "5:1",
       "the range of the revolute joint has no directions from which its angle counts", "zero (u) (v)"},
      {"ReferencesOfAPrismaticJoint", joints("prismatic: base (0,0,0)+(1,0,0) arm P+(1,0,0) range [0,1] +(0,0,1) +(0,0,1)"),
       "5:59", "the prismatic joint has reference directions", "none"},
      {"ZeroAlongTheAxis", joints(turn + "zero (0,0,1) (1,0,0) fix: base hand id"), "5:1",
       "the zero direction of the revolute joint 'turn' on the link 'base' lies along the axis", "across the axis"},
      {"ZeroOfLengthZero", joints(turn + "zero (1,0,0) (0,0,0) fix: base hand id"), "5:1",
       "the zero direction of the revolute joint 'turn' on the link 'arm' has the length 0", "a direction"},
      {"HalfAngleWithoutDirections", joints("spherical: base (0,0,0) arm P range [1]"), "5:37",
       "the half angle of the spherical joint has no directions", "range [half angle] R R"},
      {"NegativeHalfAngle", joints("spherical: base (0,0,0) arm P range [-1] +(0,0,1) +(0,0,1)"), "5:37",
       "the half angle of the spherical joint is negative", "[half angle]"},
      {"RodWithoutLength", joints("sph_sph leg: base (0,0,0) arm P"), "5:1", "the sph_sph joint 'leg' has no length",
       "length l"},
      {"RodOfNegativeLength", joints("sph_sph leg: base (0,0,0) arm P length 1-2 fix: base hand id"), "5:1",
       "the length of the sph_sph joint 'leg', '1 - 2', is negative", "a length above 0"},
      {"LegOfNegativeLength", joints("sph_prs_sph leg: base (0,0,0) arm P range [-1, 2] fix: base hand id"), "5:1",
       "the range of the sph_prs_sph joint 'leg' begins with '-1', which is negative", "the range of a length"},
      {"LengthOfARevoluteJoint", joints(turn + "length 2"), "5:1", "the revolute joint 'turn' has a length", "only sph_sph"},
      {"JointTwice", joints(turn + "\n" + turn), "6:10", "the joint 'turn' is already there, in line 5", "another name"},
      {"VertexOfALinkWithoutBodies", joints("revolute: base 0 1 arm P+(0,0,1)"), "5:16", "the link 'base' has no body 0",
       "the link has no bodies"},
      {"VertexBeyondTheBody",
       "[LINKS]\nbase: cylinder 1 (0,0,0) (0,0,1)\narm [JOINTS]\nrevolute: base 0 2 arm (0,0,0)+(0,0,1)", "4:18",
       "the body 0 of the link 'base' has no vertex '2'", "a vertex from 0 to 1"},
      {"BodyBeyondTheLast",
       "[LINKS]\nbase: cylinder 1 (0,0,0) (0,0,1)\narm [JOINTS]\nrevolute: base 1:0 1:1 arm (0,0,0)+(0,0,1)", "4:16",
       "the link 'base' has no body 1", "a body from 0 to 0"},
      {"BodyThatIsNotThere", "[LINKS]\nbase: body \"b.off\"\narm [JOINTS]\nrevolute: base 0 1 arm (0,0,0)+(0,0,1)", "4:16",
       "the vertex 0 of the body 'b.off' of the link 'base' is needed, but the body's file is not there", "the file"},
      {"MatrixThatIsNoRotation", joints("fix: base arm TR(1,0,0,0; 0,0.9,0,0; 0,0,1,0) fix: base hand id"), "5:1",
       "the pose of the fix joint 'base–arm' is not a rotation and translation: row 2 does not have the length 1",
       "a rotation matrix"},
      {"RowsThatAreNotPerpendicular", joints("fix: base arm TR(1,0,0,0; 1,0,0,0; 0,0,1,0) fix: base hand id"), "5:1",
       "the pose of the fix joint 'base–arm' is not a rotation and translation: row 2 is not perpendicular to row 1",
       "rotation"},
      {"Reflection", joints("fix: base arm TR(1,0,0,0; 0,1,0,0; 0,0,-1,0) fix: base hand id"), "5:1",
       "the pose of the fix joint 'base–arm' is not a rotation and translation: the matrix is a reflection",
       "a determinant of 1"},
      {"TransformationOfTwoNumbers", joints("fix: base arm Tx(1, 2)"), "5:15", "the transformation 'tx' has 2 numbers", "1"},
      {"EndlessProductOfTransformations",
       joints("fix: base arm Rx(1)*Ry(1)*Rz(1)*Rx(1)*Ry(1)*Rz(1)*Rx(1)*Ry(1)*Rz(1)*Rx(1)*Ry(1)*Rz(1)*Rx(1)*Ry(1)"), "5:93",
       "the product of transformations has grown too long", "a shorter one"},
      {"UnknownTransformation", joints("fix: base arm Rw(1)"), "5:15", "found 'Rw'", "a transformation: Tx"},
      {"ActuatedFixedJoint", joints("fix: base arm id actuated fix: base hand id"), "5:1",
       "the fix joint 'base–arm' cannot be actuated", "revolute"},
      {"CoupledWithNothing", joints("crevolute: base (0,0,0)+(0,0,1) arm P+(0,0,1)"), "5:1",
       "the crevolute joint follows no revolute joint", "the joint with which it is coupled"},
      // inputs and outputs
      {"UnknownInput", sections("[INPUTS] trun"), "6:10", "there is no joint 'trun'", "did you mean 'turn'?"},
      {"InputTwice", sections("[INPUTS] turn, turn"), "6:16", "the joint 'turn' is an input already", "each input once"},
      {"InputThatIsFixed", sections("[INPUTS] hold"), "5:51", "the fix joint 'hold' cannot be actuated", "revolute"},
      {"OutputOfAnUnknownJoint", sections("[OUTPUTS] t : joint tarn"), "6:21", "there is no joint 'tarn'",
       "did you mean 'turn'?"},
      {"OutputOfAFixedJoint", sections("[OUTPUTS] t : joint hold"), "6:11",
       "the output 't' is of the fix joint 'hold', which has no angle or displacement of its own", "the kind revolute"},
      {"OutputOfAnActuatedJoint", sections("[INPUTS] turn [OUTPUTS] t : joint turn"), "6:25",
       "the output 't' is of the revolute joint 'turn', which is actuated", "a joint that no actuator drives"},
      {"OutputOfAnUnknownLink", sections("[OUTPUTS] p : position of harm.P"), "6:27", "there is no link 'harm'",
       "did you mean 'arm'?"},
      {"OutputOfAnUnknownPoint", sections("[OUTPUTS] p : position of arm.Q"), "6:31", "the link 'arm' has no point 'Q'",
       "a point named in the link: P"},
      {"OutputInAnUnknownLink", sections("[OUTPUTS] p : pose of arm in bass"), "6:30", "there is no link 'bass'",
       "did you mean 'base'?"},
      {"OutputInItself", sections("[OUTPUTS] p : pose of arm in arm"), "6:11",
       "the output 'p' is of the link 'arm' in itself", "two different links"},
      {"OutputTwice", sections("[OUTPUTS] p : pose of arm\np : pose of hand"), "7:1", "there are two outputs 'p'",
       "another name"},
      {"UnknownKindOfOutput", sections("[OUTPUTS] p : postion of arm"), "6:15", "'postion' cannot be an output",
       "did you mean 'position'?"},
      {"DirectionThatIsNotGiven", sections("[OUTPUTS] w : direction of arm"), "6:11", "the direction of 'w' is not given",
       "direction of link (x, y, z)"},
      {"DirectionOfLengthZero", sections("[OUTPUTS] w : direction of arm (0,0,0)"), "6:11",
       "the direction of the output 'w' has the length 0", "a direction"},
      {"OrientationOfAPoint", sections("[OUTPUTS] r : orientation of arm.P"), "6:11",
       "the orientation of 'r' is given with a point", "orientation of link"},
      {"RangeOfAnOutputWithoutItsAxis", sections("[OUTPUTS] p : position of arm range [0, 1]"), "6:37", "found '['",
       "the range of a component: x [lower, upper]"},
      {"RangeOfAnOutputOfOneNumber", sections("[OUTPUTS] p : position of arm range x [1]"), "6:39",
       "the range of x of the output 'p' has one number", "[lower, upper]"},
      {"RangeOfAnOutputGivenTwice", sections("[OUTPUTS] p : position of arm range x [0,1] x [0,1]"), "6:47",
       "the range of x of the output 'p' is given twice", "one range"},
      {"OnlyWithoutAComponent", sections("[OUTPUTS] p : position of arm only"), "7:1", "found the end",
       "x, y and z after only"},
      {"OnlyTwice", sections("[OUTPUTS] p : position of arm only x only y"), "6:38", "the output 'p' says only twice",
       "all of its components once"},
      {"OnlyOfAPose", sections("[OUTPUTS] p : pose of arm only x"), "6:11",
       "the output 'p' is asked for some components only, but is not a position", "`only` after a position"},
      {"RangeOfAComponentThatIsNotAskedFor", sections("[OUTPUTS] p : position of arm only x range y [0,1]"), "6:11",
       "there is a range of y, for which the output 'p' does not ask", "ranges of the components after only"},
      {"RangeOfAnOutputThatIsEmpty", sections("[OUTPUTS] p : position of arm range x [1,0]"), "6:11",
       "the range of x of the output 'p' is empty: '1' is above '0'", "[lower, upper]"},
      {"RangeOfAnOrientation", sections("[OUTPUTS] p : orientation of arm range x [0,1]"), "6:11",
       "the output 'p' has a range, but no components that are lengths", "a position or a pose"},
      {"KeptOrientationOfAPosition", sections("[OUTPUTS] p : position of arm keeps id"), "6:11",
       "the output 'p' keeps an orientation, but it is not an orientation or a pose", "after an orientation or a pose"},
      {"KeptOrientationWithAWay", sections("[OUTPUTS] p : pose of arm keeps Rz(1)*Tx(1)"), "6:11",
       "the output 'p' keeps more than a rotation", "a product of Rx Ry Rz"},
      {"KeptOrientationInALink", sections("[OUTPUTS] p : pose of arm in hand keeps id"), "6:11",
       "the output 'p' keeps an orientation relative to 'hand'", "one in the ground 'base'"},
      // other sections
      {"IncludeWithoutAFolder", sections("[INCLUDE] x : \"arm.world\""), "6:15",
       "the file 'arm.world' cannot be included: this text has no folder", "a robot read from a file"},
      {"IncludeWithoutAFile", sections("[INCLUDE] x : arm"), "6:15", "found 'arm'", "the name of a file, in quotes"},
      {"CheckOfNothing", sections("[COLLISIONS] check : 2"), "6:22", "found '2'", "all, selfcollisions"},
      {"ObstacleWithoutShape", sections("[OBSTACLES] o : 2"), "6:17", "found '2'", "body, box"},
      {"EquationsWithoutEqfile", sections("[EQUATIONS] x = 1;"), "6:13", "found 'x'", "EQFILE"},
  };
}

class PartFault : public ::testing::TestWithParam<FaultCase> {};

TEST_P(PartFault, GetsOneMessageWithItsPlace) {
  const FaultCase& fault = GetParam();
  const std::string place = std::string(fault.place) == "0:0" ? "r.cuik: " : std::string("r.cuik:") + fault.place + ": ";
  try {
    parse_parts(fault.text, "r.cuik");
    FAIL() << "accepted:\n" << fault.text;
  } catch (const ModelError& error) {
    const std::string message = error.what();
    EXPECT_THAT(message, StartsWith(place + fault.problem));
    const std::size_t expected = message.find("; expected ");
    ASSERT_NE(expected, std::string::npos) << message;
    EXPECT_THAT(message.substr(expected), HasSubstr(fault.expectation));
    EXPECT_THAT(message, Not(HasSubstr("\n")));
  }
}

INSTANTIATE_TEST_SUITE_P(Each, PartFault, ::testing::ValuesIn(faults()),
                         [](const auto& fault) { return std::string(fault.param.name); });

TEST(PartFaults, AreAtLeastSeventyDifferentOnes) { EXPECT_GE(faults().size(), 70u); }

// What concerns other files.
std::string message_of(const std::filesystem::path& path) {
  try {
    read_part_file(path);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PartFaults, OfIncludedFilesNameTheFile) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "part_faults";
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
  };
  write("faulty.world", "[LINKS] base\n[JOINTS] revolute: base (0,0,0)+(0,0,1) bass");
  write("off.off", "OFF\n1 0 0\n0 0 x\n");
  EXPECT_THAT(message_of(write("a.world", "[INCLUDE] x : \"faulty.world\"")),
              StartsWith((folder / "faulty.world").string() + ":2:41: there is no link 'x__bass'"));
  EXPECT_THAT(message_of(write("b.world", "[INCLUDE] x : \"b.world\"")),
              HasSubstr("b.world:1:15: the file 'b.world' includes"));
  write("c.world", "[INCLUDE] x : \"d.world\"");
  EXPECT_THAT(message_of(write("d.world", "[INCLUDE] x : \"c.world\"")),
              HasSubstr("c.world:1:15: the file 'd.world' includes itself"));
  EXPECT_THAT(message_of(write("e.world", "[INCLUDE] x : \"none.world\"")),
              HasSubstr("e.world:1:15: the included file 'none.world' is not there"));
  EXPECT_THAT(message_of(write("f.world", "[LINKS] a: body \"off.off\"")), HasSubstr("off.off:3: 'x' is not a number"));
  EXPECT_THAT(message_of(folder / "none.world"), HasSubstr("there is no such file"));
  for (int i = 0; i < 12; ++i)
    write("n" + std::to_string(i) + ".world", "[INCLUDE] x : \"n" + std::to_string(i + 1) + ".world\"");
  EXPECT_THAT(message_of(folder / "n0.world"),
              HasSubstr("n10.world:1:15: too many files are included; expected at most 100"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace corank::kinematics
