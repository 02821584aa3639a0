// Robots from their parts on the command line: .cuik with [LINKS], .world, URDF with --loops.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "corank/tests/app/solved.h"

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// Lengths and angles of the robots here are our own choice.

// Two bars on a base, sides 3, 4, 5: a structure whose tip is at (3, ±4).
constexpr const char* kTriangle =
    "[LINKS]\nbase : point A (0, 0, 0)  point B (3, 0, 0)\nlong : point T (5, 0, 0)\nshort : point T (4, 0, 0)\n"
    "[JOINTS]\nrevolute left : base A + (0, 0, 1)  long (0, 0, 0) + (0, 0, 1)\n"
    "revolute right : base B + (0, 0, 1)  short (0, 0, 0) + (0, 0, 1)\n"
    "revolute tip : long T + (0, 0, 1)  short T + (0, 0, 1)\n";

// A spherical triangle: its axes make the angles pi/2, pi/3, pi/3.
constexpr const char* kSpherical =
    "[LINKS]\nbase : point O (0, 0, 0)\none : point O (0, 0, 0)\ntwo : point O (0, 0, 0)\n"
    "[JOINTS]\nrevolute a : base O + (0, 0, 1)  one O + (0, 0, 1)\n"
    "revolute b : one O + (sqrt(3)/2, 0, 1/2)  two O + (0, 0, 1)\n"
    "revolute c : two O + (sqrt(3)/2, 0, 1/2)  base O + (1, 0, 0)\n";

// A crank about the z axis whose end a rod ties to the ground, at a height of its own, and a hand that a universal joint
// holds and two rods: a structure in space.
constexpr const char* kSpatial =
    "[LINKS]\nbase : point S (0, 0, 0)  point A (2, 0, 1)  point B (0, 3, 1)  point C (3, 2, 1)\n"
    "crank : point S (0, 0, 0)  point E (1, 0, 1/2)\nhand : point E (0, 0, 0)  point P (1, 0, 0)  point Q (0, 1, 1)\n"
    "[JOINTS]\nrevolute turn : base S + (0, 0, 1)  crank S + (0, 0, 1)\n"
    "universal wrist : crank E + (0, 0, 1)  hand E + (0, 1, 0)\n"
    "sph_sph r1 : base A  crank E  length 3/2\nsph_sph r2 : base B  hand P  length 2\nsph_sph r3 : base C  hand Q  length "
    "2\n";

constexpr const char* kUrdf =
    "<robot name=\"triangle\"><link name=\"base\"/><link name=\"long\"/><link name=\"short\"/>\n"
    "<joint name=\"left\" type=\"continuous\"><parent link=\"base\"/><child link=\"long\"/><axis xyz=\"0 0 1\"/></joint>\n"
    "<joint name=\"right\" type=\"continuous\"><origin xyz=\"0.3 0 0\" rpy=\"0 0 1.5708\"/><parent link=\"base\"/>"
    "<child link=\"short\"/><axis xyz=\"0 0 1\"/></joint>\n</robot>\n";
constexpr const char* kLoops = "[LOOPS]\nrevolute tip : long (0.5, 0, 0)+(0, 0, 1)  short (0.4, 0, 0)+(0, 0, 1)\n";

constexpr const char* kFourBar =
    "[CONSTANTS]\nc := 0.8\n[LINKS]\nground\ncrank\ncoupler\nrocker\n"
    "[JOINTS]\nrevolute drive : ground (0, 0, 0) (0, 0, 1) crank (0, 0, 0) (0, 0, 1)\n"
    "REVOLUTE: crank (c, 0, 0) (c, 0, 1) coupler (0, 0, 0) (0, 0, 1)\n"
    "REVOLUTE: coupler (1.75, 0, 0) (1.75, 0, 1) rocker (1.5, 0, 0) (1.5, 0, 1)\n"
    "revolute swing : ground (2, 0, 0) (2, 0, 1) rocker (0, 0, 0) (0, 0, 1)\n"
    "[INPUTS] drive\n[OUTPUTS] swing : joint swing\n";

// The second axis leans by tilt.
constexpr const char* kArmOfParts =
    "[CONSTANTS]\ntilt := 0\n[LINKS]\nbase : point S (0, 0, 0)\nupper : point E (2, 0, 0)\nfore : point H (1, 0, 0)\n"
    "[JOINTS]\nrevolute shoulder : base S + (0, 0, 1)  upper (0, 0, 0) + (0, 0, 1)  actuated\n"
    "revolute elbow : upper E + (0, sin(tilt), cos(tilt))  fore (0, 0, 0) + (0, 0, 1)  actuated\n"
    "[OUTPUTS]\nhand : position of fore.H\n";

// Its elbow has a range and no coordinate, so the range is an inequality.
std::string arm_with_a_range() {
  std::string arm = kArmOfParts;
  return arm.replace(arm.rfind("  actuated\n[OUTPUTS]"), 10, "  zero (1, 0, 0) (1, 0, 0)  range [-1, 2]");
}

// Equations are made for the constants' own values: a model of them says of which terms nothing is left.
TEST(Parts, DeriveSaysWhatIsLeftOutOfAModel) {
  const TemporaryFolder folder;
  EXPECT_THAT(run_corank({"derive", folder.write("arm.cuik", kArmOfParts), "--format", "model"}).out,
              HasSubstr("% Left out, being 0 for these values of the constants: tilt\n"));
  EXPECT_THAT(run_corank({"derive", folder.write("four_bar.cuik", kFourBar), "--format", "model"}).out,
              Not(HasSubstr("Left out")));
}

// The equations of an arm have no line of their own in its author's file.
TEST(Parts, ARangeIsNamedByItsLineAndItsJointAlsoInAStoredResult) {
  const TemporaryFolder folder;
  const std::string arm = folder.write("arm.cuik", arm_with_a_range());
  const std::string whole = folder.file("whole.h5"), name = "arm.cuik:9 (range of elbow)";
  EXPECT_THAT(run_corank({"solve", arm, "--set", "cspace", "-o", whole}).out, HasSubstr(name));
  EXPECT_THAT(run_corank({"solve", "--refine", whole, "-o", folder.file("cut.h5")}).out, HasSubstr(name));
}

TEST(Parts, AWorkspaceEndsWhereARangeIsReached) {
  const TemporaryFolder folder;
  std::string arm = arm_with_a_range();
  arm.erase(arm.find("  actuated"), 10);
  const std::string file = folder.write("arm.cuik", arm);
  const json parts = solved({file, "--set", "boundary"})["parts"];
  const auto reached = std::ranges::find(parts, "range of elbow reached", [](const json& part) { return part["part"]; });
  ASSERT_NE(reached, parts.end()) << parts.dump();
  EXPECT_TRUE((*reached)["complete"]);
  EXPECT_EQ((*reached)["boxes"], (*reached)["boundary"]["barrier"]);
}

TEST(Parts, AnEmptyBoundaryOfEquationsWithoutLimitsSaysSo) {
  const TemporaryFolder folder;
  const std::string crane =
      "[SYSTEM VARS]\nr : [1, 2]\nt ~\nx :\ny :\n[SYSTEM EQS]\nx = r*cos(t);\ny = r*sin(t);\n[INPUTS] r t\n[OUTPUTS] x y\n";
  const std::string hint = "no [LIMITS] are declared, so the workspace does not end at the range of r\n";
  EXPECT_THAT(run_corank({"solve", folder.write("crane.cuik", crane), "--set", "boundary"}).out, HasSubstr(hint));
  const std::string turning = folder.write("turning.cuik", crane + "[LIMITS]\nt ~ [-1, 1]\n");
  EXPECT_THAT(run_corank({"solve", turning, "--set", "boundary"}).out, Not(HasSubstr("no [LIMITS]")));
}

TEST(Parts, ACoordinateIsNotFreeWhereItIsAtItsLimit) {
  const TemporaryFolder folder;
  const std::string carriage = folder.write(
      "carriage.cuik",
      "[LINKS]\nbase : point S (0, 0, 0)\ncarriage : point S (0, 0, 0)\narm : point H (1, 0, 0)\n"
      "[JOINTS]\nprismatic x : base S + (1, 0, 0)  carriage S + (1, 0, 0)  actuated  range [0, 1/2]\n"
      "revolute turn : carriage S + (0, 0, 1)  arm (0, 0, 0) + (0, 0, 1)  zero (1, 0, 0) (1, 0, 0)  actuated  range [1, 2]\n"
      "[OUTPUTS]\nhand : position of arm.H\n");
  const json boundary = solved({carriage, "--set", "boundary"});
  EXPECT_EQ(boundary["free_coordinates"], json::array());
  std::size_t at_a_limit = 0;
  for (const json& part : boundary["parts"]) {
    const std::string name = part["part"];
    at_a_limit += name.starts_with("x at its");
    EXPECT_EQ(part["free_coordinates"], json({name.starts_with("x at its") ? "turn" : "x"})) << name;
  }
  EXPECT_EQ(at_a_limit, 2u);
}

TEST(Parts, SetsThatARobotDoesNotHaveAreRefusedWithTheReason) {
  const TemporaryFolder folder;
  std::string free = kArmOfParts;
  free.resize(free.find("[OUTPUTS]"));
  EXPECT_THAT(run_corank({"solve", folder.write("free.cuik", free), "--set", "forward"}).err,
              HasSubstr("the robot has no loops and no outputs: every value of its joints is a configuration"));
  EXPECT_THAT(run_corank({"solve", model("spatial/agile_eye"), "--set", "boundary"}).err,
              HasSubstr("the model's outputs are rates, as of an orientation"));
}

// A wiper that can be assembled at the very ends of its range only.
TEST(Parts, ASearchForAConfigurationNamesNoLimitOfItsOwn) {
  const TemporaryFolder folder;
  const std::string wiper = folder.write(
      "wiper.cuik",
      "[LINKS]\nground : point O (0, 0, 0)\ncrank\ncoupler\nrocker\n[JOINTS]\n"
      "revolute drive : ground O + (0, 0, 1)  crank (0, 0, 0) + (0, 0, 1)  actuated\n"
      "revolute : crank (0, 0, 0) + (sin(20deg), 0, cos(20deg))  coupler (0, 0, 0) + (0, 0, 1)\n"
      "revolute : coupler (0, 0, 0) + (sin(70deg), 0, cos(70deg))  rocker (0, 0, 0) + (sin(80deg), 0, cos(80deg))\n"
      "revolute wipe : ground O + (1, 0, 0)  rocker (0, 0, 0) + (0, 0, 1)  zero (0, 1, 0) (0, 1, 0)  range [-90deg, 90deg]\n"
      "[OUTPUTS]\nwipe : joint wipe\n");
  EXPECT_THAT(run_corank({"solve", wiper, "--set", "forward"}).out,
              HasSubstr("assembled within its ranges: C-space is not proven to be empty, but no configuration is proven"));
}

TEST(Parts, AMapOverAConstantIsThatOfTheEquationsOrSaysWhatWouldChange) {
  const TemporaryFolder folder;
  const std::string four_bar = folder.write("four_bar.cuik", kFourBar), arm = folder.write("arm.cuik", kArmOfParts);
  const Outcome map = run_corank(
      {"map", four_bar, "--over", "c=1/2:3", "--over", "drive=-pi:pi", "--resolution", "8", "--no-boundary", "--json"});
  ASSERT_EQ(map.status, 0) << map.err;
  EXPECT_TRUE(json::parse(map.out).contains("cells"));
  const Outcome tilted =
      run_corank({"map", arm, "--over", "tilt=-1:1", "--over", "shoulder=-pi:pi", "--fix", "elbow=1", "--resolution", "8"});
  EXPECT_EQ(tilted.status, 1);
  EXPECT_THAT(tilted.err, HasSubstr("the equations leave out tilt"));
  EXPECT_THAT(tilted.err, HasSubstr("corank derive FILE --format model"));
}

TEST(Parts, AnOutputThatIsAJointGoesByTheJointsName) {
  const TemporaryFolder folder;
  std::string text = kFourBar;
  text.replace(text.find("swing : joint"), 5, "angle");
  const Outcome other = run_corank({"derive", folder.write("four_bar.cuik", text), "--format", "model"});
  EXPECT_THAT(other.err,
              HasSubstr("note: an output that is a joint has the joint's name, here and in results: angle is swing"));
  EXPECT_THAT(other.out, HasSubstr("[OUTPUTS]  swing"));
  EXPECT_EQ(run_corank({"derive", folder.write("four_bar.cuik", kFourBar), "--format", "model"}).err, "");
}

using Vector3 = std::array<double, 3>;

Vector3 image(const json& link, const Vector3& v, bool is_point = true) {
  Vector3 w{};
  for (std::size_t i = 0; i < 3; ++i) {
    w[i] = is_point ? link["position"][i].get<double>() : 0;
    for (std::size_t k = 0; k < 3; ++k) w[i] += link["rotation"][i][k].get<double>() * v[k];
  }
  return w;
}

double distance(const Vector3& a, const Vector3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

struct End {
  const char* link;
  Vector3 point, axis;
};

/// Of a revolute joint: its points and its axes coincide; of a rod, which has no axes: its length.
void expect_joined(const json& links, const End& a, const End& b, double length = 0) {
  EXPECT_NEAR(distance(image(links[a.link], a.point), image(links[b.link], b.point)), length, 1e-9) << a.link << b.link;
  EXPECT_NEAR(distance(image(links[a.link], a.axis, false), image(links[b.link], b.axis, false)), 0, 1e-9);
}

void expect_rotation(const json& link) {
  const Vector3 x = image(link, {1, 0, 0}, false), y = image(link, {0, 1, 0}, false), z = image(link, {0, 0, 1}, false);
  const Vector3 product{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  EXPECT_NEAR(distance(product, z), 0, 1e-9);
  EXPECT_NEAR(std::hypot(x[0], x[1], x[2]), 1, 1e-9);
}

const Vector3 kZ{0, 0, 1}, kNone{};

TEST(Parts, PointsOfAPlanarStructureHavePosesThatFitItsJoints) {
  const TemporaryFolder folder;
  const json result = solved({folder.write("triangle.cuik", kTriangle)});
  ASSERT_EQ(result["points"].size(), 2u);
  for (const json& point : result["points"]) {
    const json& links = point["links"];
    ASSERT_EQ(links.size(), 3u);
    for (const json& link : links) expect_rotation(link);
    expect_joined(links, {"base", {0, 0, 0}, kZ}, {"long", {0, 0, 0}, kZ});
    expect_joined(links, {"base", {3, 0, 0}, kZ}, {"short", {0, 0, 0}, kZ});
    expect_joined(links, {"long", {5, 0, 0}, kZ}, {"short", {4, 0, 0}, kZ});
    const double left = point["joints"]["left"], right = point["joints"]["right"], tip = point["joints"]["tip"];
    EXPECT_NEAR(std::cos(left), 0.6, 1e-9);
    EXPECT_NEAR(std::fabs(right), std::numbers::pi / 2, 1e-9);
    EXPECT_NEAR(std::remainder(left + tip - right, 2 * std::numbers::pi), 0, 1e-9) << "the short bar's angle, both ways";
  }
}

TEST(Parts, PointsOfASphericalStructureHavePosesThatFitItsJoints) {
  const TemporaryFolder folder;
  const json result = solved({folder.write("spherical.cuik", kSpherical)});
  ASSERT_EQ(result["points"].size(), 2u);
  for (const json& point : result["points"]) {
    const json& links = point["links"];
    for (const json& link : links) expect_rotation(link);
    const Vector3 leaning{std::sqrt(3) / 2, 0, 0.5};
    expect_joined(links, {"base", kNone, kZ}, {"one", kNone, kZ});
    expect_joined(links, {"one", kNone, leaning}, {"two", kNone, kZ});
    expect_joined(links, {"two", kNone, leaning}, {"base", kNone, {1, 0, 0}});
    ASSERT_EQ(point["joints"].size(), 3u);
    const double a = point["joints"]["a"];  // turns one's second axis; base's x axis is pi/3 away from it
    EXPECT_NEAR(std::sqrt(3) / 2 * std::cos(a), 0.5, 1e-9);
  }
}

TEST(Parts, PointsOfASpatialStructureHavePosesThatFitItsJoints) {
  const TemporaryFolder folder;
  const json result = solved({folder.write("spatial.cuik", kSpatial)});
  ASSERT_GE(result["points"].size(), 2u);
  for (const json& point : result["points"]) {
    const json& links = point["links"];
    for (const json& link : links) expect_rotation(link);
    expect_joined(links, {"base", kNone, kZ}, {"crank", kNone, kZ});
    expect_joined(links, {"crank", {1, 0, 0.5}, kNone}, {"hand", kNone, kNone});
    const Vector3 first = image(links["crank"], kZ, false), second = image(links["hand"], {0, 1, 0}, false);
    EXPECT_NEAR(first[0] * second[0] + first[1] * second[1] + first[2] * second[2], 0, 1e-9);
    expect_joined(links, {"base", {2, 0, 1}, kNone}, {"crank", {1, 0, 0.5}, kNone}, 1.5);
    expect_joined(links, {"base", {0, 3, 1}, kNone}, {"hand", {1, 0, 0}, kNone}, 2);
    expect_joined(links, {"base", {3, 2, 1}, kNone}, {"hand", {0, 1, 1}, kNone}, 2);
  }
}

TEST(Parts, OfUrdfAreJoinedByTheirCompanion) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write("triangle.urdf", kUrdf), loops = folder.write("triangle.loops", kLoops);
  const json result = solved({urdf, "--loops", loops});
  ASSERT_EQ(result["points"].size(), 2u);
  for (const json& point : result["points"]) {
    const json& links = point["links"];
    expect_joined(links, {"base", kNone, kZ}, {"long", kNone, kZ});
    expect_joined(links, {"base", {0.3, 0, 0}, kZ}, {"short", kNone, kZ});
    expect_joined(links, {"long", {0.5, 0, 0}, kZ}, {"short", {0.4, 0, 0}, kZ});
    const double right = point["joints"]["right"];  // counted from the y axis
    EXPECT_NEAR(std::sin(right), 0, 1e-9);
  }
  EXPECT_THAT(run_corank({"derive", urdf, "--loops", loops}).out, HasSubstr("planar, 3 links, mobility 0"));
}

// Exit status 4: verified, but without the proof that nothing is missing.
TEST(Parts, ResultsAreVerifiedFromTheirFilesAlone) {
  const TemporaryFolder folder;
  std::string urdf = folder.write("triangle.urdf", kUrdf), loops = folder.write("triangle.loops", kLoops);
  const std::vector<std::vector<std::string>> models{
      {folder.write("triangle.cuik", kTriangle)},
      {folder.write("spherical.cuik", kSpherical)},
      {urdf, "--loops", loops},
      {folder.write("bar.world", kFourBar), "--set", "forward", "-D", "c=0.7"},
      {folder.file("bar.world"), "--set", "inverse"}};
  const std::string file = folder.file("result.h5");
  for (const std::vector<std::string>& model : models) {
    std::vector<std::string> solve{"solve"};
    solve.insert(solve.end(), model.begin(), model.end());
    solve.insert(solve.end(), {"-o", file});
    ASSERT_EQ(run_corank(solve).status, 0) << model[0];
    EXPECT_EQ(run_corank({"verify", file}).status, 4) << model[0];
    solve.emplace_back("--proof");
    ASSERT_EQ(run_corank(solve).status, 0) << model[0];
    const Outcome verified = run_corank({"verify", file});
    EXPECT_EQ(verified.status, 0) << model[0] << verified.out << verified.err;
  }
}

// Crank and coupler on one line: dead centres of the rocker's drive; rocker and coupler on one line, which a crank that
// turns round never meets.
TEST(Parts, SetsOfAWorldWithInputsAndOutputs) {
  const TemporaryFolder folder;
  const std::string file = folder.write("bar.world", kFourBar);
  EXPECT_EQ(solved({file, "--set", "forward"})["points"].size(), 0u);
  const json inverse = solved({file, "--set", "inverse"});
  ASSERT_EQ(inverse["points"].size(), 4u);
  for (const json& point : inverse["points"]) {
    const double drive = point["joints"]["drive"];
    const Vector3 crank = image(point["links"]["crank"], {0.8, 0, 0}), tip = image(point["links"]["coupler"], {1.75, 0, 0});
    EXPECT_NEAR(crank[0] * tip[1] - crank[1] * tip[0], 0, 1e-9);
    EXPECT_NEAR(crank[0], 0.8 * std::cos(drive), 1e-9);
  }
  EXPECT_EQ(solved({file, "--set", "forward", "-D", "c=1.5"})["points"].size(), 2u) << "a crank that is no crank any more";
}

TEST(Parts, ConstantsDecideWhereARobotMoves) {
  const TemporaryFolder folder;
  const std::string file = folder.write("arm.cuik", kArmOfParts);
  EXPECT_THAT(run_corank({"derive", file}).out, StartsWith("Robot: planar, 3 links, mobility 2\n"));
  EXPECT_THAT(run_corank({"derive", file, "-D", "tilt=pi/6"}).out, StartsWith("Robot: spatial, 3 links, mobility 2\n"));
  EXPECT_THAT(run_corank({"derive", file, "-D", "tilt=pi"}).out, StartsWith("Robot: planar, 3 links, mobility 2\n"));
  const Outcome text = run_corank({"derive", file, "--format", "model", "-D", "tilt=pi/6"});
  EXPECT_THAT(text.out, StartsWith("% spatial, 3 links, mobility 2\n"));
  EXPECT_THAT(text.out, HasSubstr("tilt := pi/6"));
  EXPECT_THAT(text.out, HasSubstr("[VELOCITY EQS]"));
  const Outcome unknown = run_corank({"derive", file, "-D", "tlit=1"});
  EXPECT_EQ(unknown.status, 1);
  EXPECT_THAT(unknown.err, HasSubstr("arm.cuik: there is no constant 'tlit'"));
}

// Bennett, "A new mechanism", Engineering 76, 1903: four revolute joints in space that move where opposite links are equal
// and their lengths are as the sines of their twists.
std::string bennett(const std::string& b) {
  return "[CONSTANTS]\na := 1\nb := " + b +
         "\n[LINKS]\nbase\ncrank\ncoupler\nrocker\n[JOINTS]\n"
         "revolute : base (a, 0, 0) + (0, -1/2, sqrt(3)/2)  crank (0, 0, 0) + (0, 0, 1)\n"
         "revolute : crank (b, 0, 0) + (0, -1, 0)  coupler (0, 0, 0) + (0, 0, 1)\n"
         "revolute : coupler (a, 0, 0) + (0, -1/2, sqrt(3)/2)  rocker (0, 0, 0) + (0, 0, 1)\n"
         "revolute : rocker (b, 0, 0) + (0, -1, 0)  base (0, 0, 0) + (0, 0, 1)\n";
}

TEST(Parts, AMobilityThatIsNotTheCountIsSaid) {
  const TemporaryFolder folder;
  const Outcome moves = run_corank({"derive", folder.write("bennett.cuik", bennett("2"))});
  EXPECT_EQ(moves.status, 0) << moves.err;
  EXPECT_THAT(moves.out, StartsWith("Robot: spatial, 4 links, mobility -2\n"));
  EXPECT_THAT(moves.err, HasSubstr("leave -2 degrees of freedom, but at sampled configurations they leave 1"));
  const json result = solved({folder.file("bennett.cuik")});
  EXPECT_EQ(result["system"]["dimension"], 1);
  EXPECT_GT(result["boxes"]["partial"], 0);
  EXPECT_EQ(result["boxes"]["regular"], 0) << "its equations follow from one another";
  // Other lengths, and it only lies flat, in two ways.
  const Outcome stuck = run_corank({"solve", folder.write("stuck.cuik", bennett("3")), "--json"});
  EXPECT_EQ(stuck.status, 0) << stuck.err;
  EXPECT_THAT(stuck.err, HasSubstr("but at sampled configurations they leave 0"));
  const json boxes = json::parse(stuck.out)["boxes"];
  EXPECT_EQ(boxes["partial"].get<int>() + boxes["isolated"].get<int>(), 2);
  EXPECT_EQ(boxes["undecided"], 0);
}

// A Delta with both rods of each parallelogram, in one orientation: three equations repeat others, and every search drops
// them exactly.
TEST(Parts, ARedundancyThatIsProvenIsNoNote) {
  std::string text = "[CONSTANTS]\nc := -1/2\ns := sqrt(3)/2\n[LINKS]\nbase : point A1 (4, 0, 0)";
  const std::array<std::string, 3> along{"(0, 1, 0)", "(-s, c, 0)", "(s, c, 0)"},
      out{"(1, 0, 0)", "(c, s, 0)", "(c, -s, 0)"};
  text += " point A2 (4*c, 4*s, 0) point A3 (4*c, -4*s, 0)\n";
  for (const char* arm : {"1", "2", "3"}) text += std::string("arm") + arm + " : point L (7, 1, 0) point R (7, -1, 0)\n";
  text +=
      "plat : point T (0, 0, 0) point L1 (1, 1, 0) point R1 (1, -1, 0) point L2 (c - s, s + c, 0) point R2 (c + s, s - c, 0)"
      " point L3 (c + s, -s + c, 0) point R3 (c - s, -s - c, 0)\n[JOINTS]\n";
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string k = std::to_string(i + 1);
    text += "revolute q" + k + " : base A" + k + " + " + along[i] + " arm" + k + " (0, 0, 0) + (0, 1, 0) zero " + out[i] +
            " (1, 0, 0) range [-pi/4, pi/2] actuated\nsph_sph l" + k + " : arm" + k + " L plat L" + k +
            " length 16\nsph_sph r" + k + " : arm" + k + " R plat R" + k + " length 16\n";
  }
  text += "[OUTPUTS]\nT : pose of plat.T range x [-8, 8] y [0, 0] z [-18, -18] keeps id\n";
  const TemporaryFolder folder;
  const Outcome outcome = run_corank({"solve", folder.write("delta.cuik", text), "--set", "cspace", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, Not(HasSubstr("sampled configurations")));
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result["system"]["dimension"], 1);
  EXPECT_GT(result["boxes"]["regular"], 0);
  EXPECT_EQ(result["boxes"]["partial"], 0);
}

TEST(Parts, EquationsThatFollowFromOthersAreListedWithTheirReasons) {
  const std::string file = model("platforms/griffis_duffy");
  const json derived = json::parse(run_corank({"derive", file, "--json"}).out);
  ASSERT_EQ(derived["left_out"].size(), 1u);
  const json& left_out = derived["left_out"][0];
  EXPECT_THAT(left_out["source"].get<std::string>(), testing::ContainsRegex("griffis_duffy.cuik:[0-9]+ \\(rod\\)"));
  std::string reason = "follows from ";
  for (const json& number : left_out["follows_from"]["constraints"]) {
    EXPECT_LE(number.get<std::size_t>(), derived["constraints"].size());
    reason += (reason.ends_with(' ') ? "(" : ", (") + std::to_string(number.get<int>()) + ")";
  }
  EXPECT_TRUE(left_out["follows_from"]["velocity"].empty());
  for (const char* format : {"text", "latex", "model"}) {
    const std::string mark = format == std::string("text") ? "" : "% ",
                      out = run_corank({"derive", file, "--format", format}).out;
    EXPECT_THAT(out, HasSubstr("\n" + mark + "Left out, because it follows by an exact identity:\n")) << format;
    EXPECT_THAT(out,
                HasSubstr("\n" + mark + "    % " + left_out["source"].get<std::string>() + ": " + reason + " of Φ(q) = 0\n"))
        << format;
  }
  EXPECT_TRUE(json::parse(run_corank({"derive", model("dextar"), "--json"}).out)["left_out"].empty());
}

// Sarrus's linkage: two hinged legs at a right angle lead a plate along a line. One row of each loop is 0 by the constants
// alone and left out, and the joints' own count is told beside.
TEST(Parts, AMobilityThatTheJointsDoNotCountIsTold) {
  const TemporaryFolder folder;
  std::string text = "[LINKS]\nbase : point A (1, 0, 0)  point B (0, 1, 0)\na1\na2\nb1\nb2\nplate\n[JOINTS]\n";
  for (const auto& [leg, foot, axis] : {std::array{"a", "(1, 0, 0)", "(0, 1, 0)"}, {"b", "(0, 1, 0)", "(1, 0, 0)"}}) {
    const std::string lower = std::string(leg) + "1", upper = std::string(leg) + "2", along = std::string(" + ") + axis;
    text += "revolute : base " + (foot + along) + "  " + lower + " (0, 0, 0)" + along + "\nrevolute : " + lower +
            " (0, 0, 1)" + along + "  " + upper + " (0, 0, 0)" + along + "\nrevolute : " + upper + " (0, 0, 3/2)" + along +
            "  plate " + foot + along + "\n";
  }
  const Outcome outcome = run_corank({"derive", folder.write("sarrus.cuik", text)});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, StartsWith("Robot: spatial, 6 links, mobility 1 (0 by its joints only)\n"));
}

TEST(Parts, FaultsNameTheFileAndTheLine) {
  const TemporaryFolder folder;
  std::string text = kTriangle;
  text.replace(text.find("short T +"), 5, "shrot");
  for (const char* command : {"derive", "solve", "report"}) {
    const Outcome outcome = run_corank({command, folder.write("wrong.cuik", text)});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("wrong.cuik:8:"));
    EXPECT_THAT(outcome.err, HasSubstr("there is no link 'shrot'"));
    EXPECT_THAT(outcome.err, HasSubstr("did you mean 'short'?"));
  }
  const std::string urdf = folder.write("triangle.urdf", kUrdf);
  const std::string loops =
      folder.write("wrong.loops", "[LOOPS]\nrevolute tip : lnog (0,0,0)+(0,0,1) short (0,0,0)+(0,0,1)\n");
  const Outcome companion = run_corank({"solve", urdf, "--loops", loops});
  EXPECT_EQ(companion.status, 1);
  EXPECT_THAT(companion.err, HasSubstr("wrong.loops:2:"));
  std::string apart = kTriangle;  // a tip that cannot be reached: heights differ
  apart.replace(apart.find("short : point T (4, 0, 0)"), 25, "short : point T (4, 0, 1)");
  const Outcome open = run_corank({"derive", folder.write("apart.cuik", apart)});
  EXPECT_EQ(open.status, 1);
  EXPECT_THAT(open.err, HasSubstr("apart.cuik:8:"));
  EXPECT_THAT(open.err, HasSubstr("'tip'"));
}

TEST(Parts, ExitStatuses) {
  const TemporaryFolder folder;
  const std::string arm = folder.write("arm.cuik", kArmOfParts), bar = folder.write("bar.world", kFourBar);
  EXPECT_EQ(run_corank({"solve", arm}).status, 2) << "a mechanism has sets";
  EXPECT_EQ(run_corank({"solve", folder.write("triangle.cuik", kTriangle), "--set", "forward"}).status, 2);
  EXPECT_EQ(run_corank({"solve", bar, "--set", "cspace", "--sigma", "0.001", "--max-boxes", "3"}).status, 3);
  EXPECT_EQ(run_corank({"solve", folder.write("a.urdf", kUrdf), "--loops", folder.file("none.loops")}).status, 2);
  EXPECT_EQ(run_corank({"solve", arm, "--loops", folder.write("a.loops", kLoops)}).status, 1) << "no URDF";
  EXPECT_EQ(run_corank({"derive", folder.file("none.urdf")}).status, 1);
}

TEST(Parts, AreReported) {
  const TemporaryFolder folder;
  const std::string page = folder.file("page");
  const Outcome bar = run_corank({"report", folder.write("bar.world", kFourBar), "-o", page});
  EXPECT_EQ(bar.status, 0) << bar.err;
  EXPECT_THAT(bar.out, HasSubstr("page/index.html"));
  EXPECT_EQ(run_corank({"verify", page + "/inverse.h5"}).status, 4);
  const std::string data = std::string(CORANK_SOURCE_DIR) + "/tests/data/urdf/";
  const Outcome urdf = run_corank({"report", data + "five_bar.urdf", "--loops", data + "five_bar.loops", "--sets",
                                   "forward,inverse", "--sigma", "0.1", "-o", page});
  EXPECT_EQ(urdf.status, 0) << urdf.err;
  EXPECT_THAT(read_text(page + "/index.html"), HasSubstr("corank report five_bar.urdf --loops five_bar.loops --sigma 0.1"));
  EXPECT_EQ(run_corank({"report", "--results", page + "/forward.h5", "-o", folder.file("again")}).status, 0)
      << "a result holds the equations";
}

TEST(Parts, AreSweptWhereTheirCoordinatesStayTheSame) {
  const TemporaryFolder folder;
  const std::string page = folder.file("page"), bar = folder.write("bar.world", kFourBar);
  const Outcome swept =
      run_corank({"sweep", bar, "-D", "c=0.5:0.8:2", "--sigma", "0.1", "--cspace-sigma", "0.2", "-o", page});
  EXPECT_EQ(swept.status, 0) << swept.err;
  EXPECT_THAT(swept.out, HasSubstr("c = 0.5, "));
  const Outcome other = run_corank({"sweep", folder.write("arm.cuik", kArmOfParts), "-D", "tilt=0:pi/6:2", "-o", page});
  EXPECT_EQ(other.status, 2) << other.err;
  EXPECT_THAT(other.err, HasSubstr("(spatial, 3 links, mobility 2) than at 0 (planar, 3 links, mobility 2)"));
  const std::string data = std::string(CORANK_SOURCE_DIR) + "/tests/data/urdf/";
  const Outcome urdf =
      run_corank({"sweep", data + "five_bar.urdf", "--loops", data + "five_bar.loops", "-D", "l=1:2:2", "-o", page});
  EXPECT_EQ(urdf.status, 1) << "URDF has no constants";
  EXPECT_THAT(urdf.err, HasSubstr("there is no constant 'l'"));
  std::string companion = read_text(data + "five_bar.loops");
  companion.replace(companion.find("(0.090"), 6, "(l");
  const Outcome with = run_corank({"sweep", data + "five_bar.urdf", "--loops",
                                   folder.write("l.loops", "[CONSTANTS]\nl := 0.090\n" + companion), "-D", "l=0.09:0.1:2",
                                   "--sets", "forward", "--sigma", "0.1", "-o", page});
  EXPECT_EQ(with.status, 0) << with.err;
  EXPECT_THAT(with.out, HasSubstr("l = 0.1, "));
}

// The chapter of doc/parts.md shows robots and their equations, as corank derive --format model prints them.
TEST(PartsDocumentation, ShowsTheEquationsThatAreDerived) {
  const TemporaryFolder folder;
  const std::string doc = read_text(CORANK_SOURCE_DIR "/doc/parts.md");
  std::size_t at = doc.find("\n## From parts to equations\n");
  ASSERT_NE(at, std::string::npos);
  const auto block = [&](const std::string& open) {
    const std::size_t start = doc.find(open, at);
    if (start == std::string::npos) return std::string();
    const std::size_t end = doc.find("\n```\n", start + open.size());
    at = end + 1;
    return doc.substr(start + open.size(), end + 1 - start - open.size());
  };
  int shown = 0;
  for (std::string robot = block("\n```\n[LINKS]\n"); !robot.empty(); robot = block("\n```\n[LINKS]\n")) {
    const std::string equations = block("\n```text\n");
    const std::string file = folder.write("robot.cuik", "[LINKS]\n" + robot);
    const Outcome outcome = run_corank({"derive", file, "--format", "model"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_GT(equations.size(), 100u);
    EXPECT_THAT(outcome.out, StartsWith(equations));
    ++shown;
  }
  EXPECT_EQ(shown, 4);
}

TEST(PartsDocumentation, OfTheReadmeIsWhatIsPrinted) {
  const TemporaryFolder folder;
  const std::string readme = read_text(CORANK_SOURCE_DIR "/README.md");
  std::size_t at = readme.find("<!-- readme_parts");
  ASSERT_NE(at, std::string::npos);
  std::array<std::string, 2> blocks;  // the robot, and lines of the output
  for (std::string& block : blocks) {
    at = readme.find("\n```\n", at) + 5;
    const std::size_t end = readme.find("\n```\n", at);
    block = readme.substr(at, end + 1 - at);
    at = end + 5;
  }
  const std::string file = folder.write("rssr.cuik", blocks[0]);
  const std::string out = "\n" + run_corank({"derive", file}).out + run_corank({"solve", file, "--set", "forward"}).out;
  std::istringstream lines(blocks[1]);
  int shown = 0;
  for (std::string line; std::getline(lines, line); ++shown) EXPECT_THAT(out, HasSubstr("\n" + line + "\n"));
  EXPECT_EQ(shown, 8);
}

}  // namespace
}  // namespace corank::app
