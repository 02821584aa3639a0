// From parts to equations: which class a robot is of, what its equations are, what can't be assembled.
#include "corank/kinematics/equations/assembly.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "corank/kinematics/language/part_file.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/writing/printer.h"
#include "corank/tests/kinematics/assembled.h"
#include "corank/tests/kinematics/read_robot.h"

namespace corank::kinematics {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> equations(const Assembly& a) {
  std::vector<std::string> texts;
  for (const symbolic::Constraint& c : a.mechanism.constraints()) texts.push_back(c.relation.text());
  return texts;
}

constexpr const char* kFourBar =
    "[CONSTANTS]\na := 1\nb := 3\nc := 2\nd := 5/2\n"
    "[LINKS]\nground\ncrank\ncoupler\nrocker\n[JOINTS]\n"
    "revolute t1 : ground (0,0,0)+(0,0,1) crank (0,0,0)+(0,0,1) actuated\n"
    "revolute A : crank (a,0,0)+(0,0,1) coupler (0,0,0)+(0,0,1)\n"
    "revolute B : coupler (b,0,0)+(0,0,1) rocker (c,0,0)+(0,0,1)\n"
    "revolute t2 : ground (d,0,0)+(0,0,1) rocker (0,0,0)+(0,0,1)\n"
    "[OUTPUTS]\nt : joint t2\n";

TEST(Assembly, MakesAFourBarOfThreeAnglesAndTwoEquations) {
  const Assembly a = assembled(kFourBar);
  EXPECT_EQ(a.space, Space::planar);
  EXPECT_THAT(coordinate_names(a), ElementsAre("t1", "t2", "phi_coupler"));
  EXPECT_THAT(equations(a), ElementsAre("-a*cos(t1) - b*cos(phi_coupler) + c*cos(t2) + d = 0",
                                        "-a*sin(t1) - b*sin(phi_coupler) + c*sin(t2) = 0"));
  EXPECT_EQ(a.mobility, 1);
  EXPECT_EQ(a.mobility_by_joints, 1);
  EXPECT_EQ(a.mobility_by_rank, 1);
  EXPECT_THAT(a.mechanism.inputs(), ElementsAre("t1"));
  EXPECT_THAT(a.mechanism.outputs(), ElementsAre("t2"));
}

// The same robot with its plane turned: axes along y, then along (1, 2, 2)/3.
TEST(Assembly, FindsThePlaneWhereverItIs) {
  std::string text = kFourBar;
  for (std::size_t at = 0; (at = text.find("(0,0,1)", at)) != std::string::npos;) text.replace(at, 7, "(0,3,0)");
  const Assembly a = assembled(text);
  EXPECT_EQ(a.space, Space::planar);
  EXPECT_EQ(equations(a).size(), 2u);
}

TEST(Assembly, TellsParallelAxesByTheirConstantsValues) {
  std::string text = kFourBar;
  text.replace(text.find("d := 5/2"), 8, "d := 5/2\nx := 0");
  text.replace(text.rfind("(d,0,0)+(0,0,1)"), 15, "(d,0,0)+(x,0,1)");
  EXPECT_EQ(assembled(text).space, Space::planar);
  Robot tilted = parse_parts(text, "r.cuik");
  for (symbolic::Constant& c : tilted.constants)
    if (c.name == "x") c.value = symbolic::Expression("1/10");
  EXPECT_EQ(assemble(tilted).space, Space::spatial);
}

TEST(Assembly, ReadsBackTheTextOfItsMechanism) {
  const Assembly a = assembled(kFourBar);
  const symbolic::Mechanism again = symbolic::parse_model(symbolic::to_model(a.mechanism), "again.cuik");
  ASSERT_EQ(again.constraints().size(), a.mechanism.constraints().size());
  for (std::size_t i = 0; i < again.constraints().size(); ++i)
    EXPECT_EQ(again.constraints()[i].relation.text(), equations(a)[i]);
}

TEST(Assembly, KeepsThreeSlidersAsTheirEquations) {
  const Assembly a = assembled(
      "[CONSTANTS]\nL1 := 1\nL2 := 4/5\n[LINKS]\nground\nA\nB\nC\n[JOINTS]\n"
      "prismatic y_A : ground (0,0,0)+(0,1,0) A (0,0,0)+(0,1,0) actuated\n"
      "prismatic y_B : ground (0,0,0)+(0,1,0) B (0,0,0)+(0,1,0)\n"
      "prismatic x_C : ground (0,0,0)+(1,0,0) C (0,0,0)+(1,0,0)\n"
      "sph_sph p : A (0,0,0) C (0,0,0) length L1\nsph_sph q : B (0,0,0) C (0,0,0) length L2\n[OUTPUTS]\ny : joint y_B\n");
  EXPECT_EQ(a.space, Space::planar);
  EXPECT_THAT(equations(a), ElementsAre("-L1^2 + y_A^2 + x_C^2 = 0", "-L2^2 + y_B^2 + x_C^2 = 0"));
}

TEST(Assembly, KnowsASphericalRobotByItsAxes) {
  const Assembly a = assembled(
      "[LINKS]\nground\na\nb\n c\n[JOINTS]\n"
      "revolute j1 : ground (0,0,0)+(0,0,1) a (0,0,0)+(0,0,1) actuated\n"
      "revolute j2 : a (0,0,0)+(0,3/5,4/5) b (0,0,0)+(0,0,1)\n"
      "revolute j3 : b (0,0,0)+(0,1,0) c (0,0,0)+(0,0,1)\n"
      "revolute j4 : c (0,0,0)+(3/5,0,4/5) ground (0,0,0)+(1,0,0)\n[OUTPUTS]\nt : joint j4\n");
  EXPECT_EQ(a.space, Space::spherical);
  EXPECT_EQ(a.mobility, 1);
  EXPECT_EQ(a.mobility_by_joints, 1);
}

// The same robot with its joints where they would be built, each link's frame elsewhere: axes meet in (1, 2, 3) of the
// ground, (2, 0, 0) of a, (0, 0, -1) of b and (0, 5, 0) of c, and a joint's two points are as far from there as each other.
constexpr const char* kJointsOnASphere =
    "[CONSTANTS]\nr := 1/3\n[LINKS]\nground\na\nb\nc\n[JOINTS]\n"
    "revolute j1 : ground (1,2,3+r)+(0,0,1) a (2,0,r)+(0,0,1) actuated\n"
    "revolute j2 : a (2,9/5,12/5)+(0,3/5,4/5) b (0,0,2)+(0,0,1)\n"
    "revolute j3 : b (0,-sqrt(2),-1)+(0,1,0) c (0,5,-sqrt(2))+(0,0,1)\n"
    "revolute j4 : c (3/5,5,4/5)+(3/5,0,4/5) ground (2,2,3)+(1,0,0)\n[OUTPUTS]\nt : joint j4\n";
constexpr const char* kJointsAtTheCentre =
    "[LINKS]\nground\na\nb\nc\n[JOINTS]\n"
    "revolute j1 : ground (0,0,0)+(0,0,1) a (0,0,0)+(0,0,1) actuated\n"
    "revolute j2 : a (0,0,0)+(0,3/5,4/5) b (0,0,0)+(0,0,1)\n"
    "revolute j3 : b (0,0,0)+(0,1,0) c (0,0,0)+(0,0,1)\n"
    "revolute j4 : c (0,0,0)+(3/5,0,4/5) ground (0,0,0)+(1,0,0)\n[OUTPUTS]\nt : joint j4\n";

std::vector<std::string> velocity_rows(const Assembly& a) {
  std::vector<std::string> texts;
  for (const symbolic::Constraint& row : a.mechanism.velocity_equations()) texts.push_back(row.relation.text());
  return texts;
}

TEST(Assembly, FindsTheCommonPointOfAxesWhereverTheirJointsAre) {
  const Assembly built = assembled(kJointsOnASphere), centred = assembled(kJointsAtTheCentre);
  EXPECT_EQ(built.space, Space::spherical);
  EXPECT_EQ(built.mobility, 1);
  EXPECT_EQ(built.mobility_by_joints, 1);
  EXPECT_EQ(built.mobility_by_rank, 1);
  EXPECT_EQ(equations(built), equations(centred));
  EXPECT_FALSE(velocity_rows(built).empty());
  EXPECT_EQ(velocity_rows(built), velocity_rows(centred));
}

// Each link's frame is where its axes meet: x = centre + R (x of the link − its centre).
TEST(Assembly, PutsALinkOfASphericalRobotWhereItsJointsAre) {
  const Assembly a = assembled(kJointsOnASphere);
  for (const std::size_t link : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
    const double own[4][3] = {{1, 2, 3}, {2, 0, 0}, {0, 0, -1}, {0, 5, 0}};
    std::map<std::string, double> values;  // any: the common point stays where it is
    for (const symbolic::Constant& c : a.mechanism.constants()) values[c.name] = symbolic::evaluate(c.value, values);
    double next = 0.1;
    for (const symbolic::Coordinate& c : a.mechanism.coordinates()) values[c.name] = next += 0.1;
    for (std::size_t i = 0; i < 3; ++i) {
      double at = symbolic::evaluate(a.poses[link].origin[i], values);
      for (std::size_t k = 0; k < 3; ++k) at += symbolic::evaluate(a.poses[link].rotation[i][k], values) * own[link][k];
      EXPECT_NEAR(at, own[0][i], 1e-12) << a.poses[link].link;
    }
  }
}

TEST(Assembly, TakesAxesThatMissEachOtherForARobotInSpace) {
  std::string linkage = kJointsOnASphere;
  linkage.replace(linkage.find(" actuated"), 9, "");
  linkage.erase(linkage.find("[OUTPUTS]"));
  EXPECT_EQ(assembled(linkage).space, Space::spherical);
  const auto with = [&](const std::string& place, const std::string& elsewhere) {
    std::string text = linkage;
    return text.replace(text.find(place), place.size(), elsewhere);
  };
  EXPECT_EQ(assembled(with("(2,0,r)", "(2,1/1000000000,r)")).space, Space::spatial)
      << "an axis beside the others of its link";
  EXPECT_EQ(assembled(with("(3/5,5,4/5)", "(3/5,5+1/1000000000,4/5)")).space, Space::spatial) << "two axes that do not meet";
  EXPECT_THAT(fault_of(with("(2,2,3)", "(2,2+1/1000000000,3)")), HasSubstr("can never close")) << "of the ground";
  EXPECT_THAT(fault_of(with("(0,0,2)", "(0,0,2+1/1000000000)")), HasSubstr("can never close"))
      << "a joint's two points apart";
}

TEST(Assembly, LetsAUniversalJointSayWhereTheCentreIs) {
  const std::string text =
      "[LINKS]\nground\na\nb\n[JOINTS]\n"
      "universal j1 : ground (1,0,0)+(0,0,1) a (0,0,0)+(1,0,0)\n"
      "revolute j2 : a (0,0,1)+(0,0,1) b (0,3/5,4/5)+(0,3/5,4/5)\n"
      "revolute j3 : b (1,0,0)+(1,0,0) ground (1,1,0)+(0,1,0)\n";
  EXPECT_EQ(assembled(text).space, Space::spherical);
  EXPECT_EQ(assembled(text).mobility, 1);
  std::string moved = text;
  moved.replace(moved.find("(0,0,1)+(0,0,1)"), 15, "(1,0,1)+(0,0,1)");
  EXPECT_EQ(assembled(moved).space, Space::spatial) << "an axis beside the universal joint";
}

// A spherical loop that carries another, about another point, and an arm.
TEST(Assembly, KnowsSphericalLoopsAboutSeveralPoints) {
  const Assembly a = assembled(std::string(kJointsOnASphere).substr(0, std::string(kJointsOnASphere).find("[OUTPUTS]")) +
                               "[LINKS]\nd\ne\nf\ng\n[JOINTS]\n"
                               "revolute k1 : c (0,0,1)+(0,0,1) d (0,0,1)+(0,0,1)\n"
                               "revolute k2 : d (0,3/5,4/5)+(0,3/5,4/5) e (0,0,1)+(0,0,1)\n"
                               "revolute k3 : e (0,1,0)+(0,1,0) f (0,0,1)+(0,0,1)\n"
                               "revolute k4 : f (3/5,0,4/5)+(3/5,0,4/5) c (1,0,0)+(1,0,0)\n"
                               "revolute arm : f (1,1,1)+(0,0,1) g (1,0,0)+(0,1,0)\n");
  EXPECT_EQ(a.space, Space::spherical);
  EXPECT_EQ(a.mobility_by_rank, a.mobility);
}

// Bennett 1903: sin(alpha)/a = sin(beta)/b; here a = 1, alpha = 30°, b = sqrt(3), beta = 60°.
TEST(Assembly, SeesThatABennettLinkageMovesThoughTheCountSaysNo) {
  const Assembly a = assembled(
      "[CONSTANTS]\nh := sqrt(3)/2\n[LINKS]\ng\na\nb\nc\n[JOINTS]\n"
      "revolute j1 : g (0,0,0)+(0,0,1) a (0,0,0)+(0,0,1)\n"
      "revolute j2 : a (1,0,0)+(0,-1/2,h) b (0,0,0)+(0,0,1)\n"
      "revolute j3 : b (sqrt(3),0,0)+(0,-h,1/2) c (0,0,0)+(0,0,1)\n"
      "revolute j4 : c (1,0,0)+(0,-1/2,h) g (-sqrt(3),0,0)+(0,h,1/2)\n");
  EXPECT_EQ(a.space, Space::spatial);
  EXPECT_EQ(a.mobility, -2);
  EXPECT_EQ(a.mobility_by_joints, -2);
  EXPECT_EQ(a.mobility_by_rank, 1);
}

TEST(Assembly, RefusesWhatDoesNotFitTogether) {
  const std::string chain =
      "[LINKS]\nground\na\nb\n[JOINTS]\nrevolute j1 : ground (0,0,0)+(0,0,1) a (0,0,0)+(0,0,1)\n"
      "revolute j2 : a (1,0,0)+(0,0,1) b (0,0,0)+(0,0,1)\n";
  EXPECT_THAT(fault_of(chain + "revolute j3 : b (1,0,0)+(0,0,1) ground (1,0,2)+(0,0,1)\n"),
              HasSubstr("the loop that the joint 'j2' closes leaves the plane and can never close"));
  EXPECT_THAT(fault_of(chain + "fix : a b Tx(1)\nfix : a b Tx(2)\n"),
              HasSubstr("'b' elsewhere than the fixed joints before it"));
  EXPECT_THAT(fault_of(chain + "fix : a b Rz(1)\nfix : a b Rz(2)\n"), HasSubstr("another orientation of 'b'"));
  EXPECT_THAT(fault_of(chain + "fix : a b id\n"), HasSubstr("which fixed joints make one body"));
  EXPECT_THAT(fault_of(chain + "prismatic s : b (0,0,0)+(1,0,0) ground (0,0,0)+(0,1,0)\n"), HasSubstr("prismatic"));
}

TEST(Assembly, LocksAJointByARangeOfOneValue) {
  std::string text = kFourBar;
  text.replace(text.find("actuated"), 8, "actuated limits [1, 1]");
  const Assembly a = assembled(text);
  EXPECT_EQ(a.mobility, 1);
  EXPECT_EQ(a.mobility_by_rank, 1) << "the locked joint counts as free";
}

// The prismatic joint carries the direction of its link: the tree reaches the actuated Jd with both directions known.
// Its angle gets an equation of its own.
TEST(Assembly, AnActuatedJointBetweenKnownDirectionsHasItsAngle) {
  const Assembly a = assembled(R"([LINKS]
b0
b1
b2
b3
b4
[JOINTS]
revolute Ja : b0 (0, 0, 0) + (0, 0, 1)  b1 (0, 0, 0) + (0, 0, 1) actuated
revolute Jb : b1 (1, 0, 0) + (0, 0, 1)  b2 (0, 0, 0) + (0, 0, 1)
prismatic Jc : b2 (0, 0, 0) + (0, 1, 0)  b3 (0, 0, 0) + (0, 1, 0) range [-4, 4]
revolute Jd : b3 (0, 2, 0) + (0, 0, 1)  b4 (0, 0, 0) + (0, 0, 1) actuated
revolute Je : b4 (1, 0, 0) + (0, 0, 1)  b0 (-3, 1/2, 0) + (0, 0, 1)
)");
  EXPECT_EQ(a.mobility, 2);
  EXPECT_EQ(a.mobility_by_rank, 2);
}

// A plate on two arms, by two rods each.
std::string plate_on_two_rods(const std::string& first) {
  return "[LINKS]\nbase\narm\nfore\nplate\n[JOINTS]\n" + first +
         "revolute q2 : base (5,0,0)+(0,1,0) fore (0,0,0)+(0,1,0)\n"
         "sph_sph l1 : arm (2,1,0) plate (0,1,0) length 3\nsph_sph r1 : arm (2,-1,0) plate (0,-1,0) length 4\n"
         "sph_sph l2 : fore (2,1,0) plate (1,1,0) length 3\nsph_sph r2 : plate (1,-1,0) fore (2,-1,1) length 3\n"
         "[OUTPUTS]\nT : position of plate (0,0,1)\n";
}

TEST(Assembly, TakesTwoRodsOfMovingBodiesTogether) {
  const auto vectors = [](const Assembly& a) {
    std::vector<std::string> names;
    for (const std::string& name : coordinate_names(a))
      if (name.starts_with("P_") && name.ends_with("_x")) names.push_back(name);
    return names;
  };
  const Assembly a = assembled(plate_on_two_rods("revolute q1 : base (0,0,0)+(0,1,0) arm (0,0,0)+(0,1,0) actuated\n"));
  EXPECT_THAT(vectors(a), ElementsAre("P_l1_x", "P_l2_x"));
  EXPECT_TRUE(velocity_rows(a).empty()) << "the equations' derivatives say all";
  // Of a cylindrical joint the angle is no coordinate, and drives all the same.
  const Assembly slides =
      assembled(plate_on_two_rods("cylindrical q1 : base (0,0,0)+(0,1,0) arm (0,0,0)+(0,1,0) actuated\n"));
  EXPECT_THAT(velocity_rows(slides), Contains(HasSubstr("w_q1")));
  EXPECT_THAT(velocity_rows(slides), Contains(HasSubstr("v_q1")));
  // An arm that is looked at in one position is at rest.
  const Assembly held = assembled(plate_on_two_rods(
      "revolute q1 : base (0,0,0)+(0,1,0) arm (0,0,0)+(0,1,0) zero (1,0,0) (1,0,0) range [1,1] actuated\n"));
  EXPECT_THAT(coordinate_names(a), Not(Contains("q_l1_1")));
  EXPECT_THAT(equations(held), Contains("1 + 8*w_plate_y + 4*P_l1_y + 4*q_l1_1 = 0")) << "linear";
}

// A rod from a point of the axis about which its other end turns says nothing, in space as in the plane; so does one whose
// end lies on two axes.
constexpr const char* kIdleRod =
    "[LINKS]\nbase : point A (1, 2, 0)\ncrank\narm\n[JOINTS]\n"
    "revolute drive : base A + (-2, 1, 3)  crank (0, 0, 0) + (0, 0, 1)  actuated\n"
    "revolute swing : base (0, 0, 0) + (3, -1, 1)  arm (0, 0, 0) + (0, 0, 1)\n"
    "sph_sph  r1 : crank (1, 0, 0)  arm (1, 1, 1)  length 4\n";

TEST(Assembly, LeavesOutARodWhoseEndIsOnTheAxisOfTheOther) {
  const Assembly without = assembled(kIdleRod);
  EXPECT_EQ(without.mobility, 1);
  for (const char* rod : {"base A  crank (1, 1, 1)  length sqrt(3)", "crank (0, 3, 4)  base (1, 2, 0)  length 5"}) {
    SCOPED_TRACE(rod);
    const Assembly a = assembled(std::string(kIdleRod) + "sph_sph r2 : " + rod + "\n");
    EXPECT_EQ(equations(a), equations(without));
    EXPECT_EQ(a.mobility_by_joints, 1);
    EXPECT_EQ(a.mechanism.velocity_equations().size(), without.mechanism.velocity_equations().size());
    EXPECT_GT(a.mechanism.drawing().parts.size(), without.mechanism.drawing().parts.size()) << "it is drawn";
  }
  EXPECT_THAT(fault_of(std::string(kIdleRod) + "sph_sph r2 : base A  crank (1, 1, 1)  length 2\n"),
              HasSubstr("the rod 'r2' has the length 2.000000, but the joints keep its ends at the distance 1.732051"));
}

TEST(Assembly, HoldsARodThatIsBesideTheAxis) {
  const std::string text = std::string(kIdleRod) + "sph_sph r2 : base (1, 2, 1)  crank (1, 1, 1)  length 2\n";
  EXPECT_EQ(assembled(text).mobility, 0);
}

// Three rods carry a platform in the plane.
std::string platform(const std::string& output) {
  return "[CONSTANTS]\nturn := pi/9\n[LINKS]\nbase\nplatform\n[JOINTS]\n"
         "planar P : base (0,0,0)+(0,0,1) platform (0,0,0)+(0,0,1)\n"
         "sph_prs_sph l1 : base (0,0,0) platform (0,0,0) range [1/2, 2] actuated\n"
         "sph_prs_sph l2 : base (2,0,0) platform (1,0,0) range [1/2, 2] actuated\n"
         "sph_prs_sph l3 : base (0,2,0) platform (0,1,0) range [1/2, 2] actuated\n"
         "[OUTPUTS]\n" +
         output + "\n";
}

TEST(Assembly, SlicesTheTurningOfAPlanarLink) {
  const auto range_of = [](const Assembly& a, const std::string& name) {
    const int k = a.mechanism.find_coordinate(name);
    if (k < 0) return std::string("none");
    const symbolic::Coordinate& c = a.mechanism.coordinates()[static_cast<std::size_t>(k)];
    return c.lower.text() + ", " + c.upper.text();
  };
  const Assembly pose = assembled(platform("pose : pose of platform (1/2, 0, 0) range phi [turn, turn] x [0, 1]"));
  EXPECT_EQ(range_of(pose, "pose_phi"), "turn, turn");
  EXPECT_EQ(range_of(pose, "pose_x"), "0, 1");
  EXPECT_EQ(pose.mobility, 3);
  EXPECT_EQ(equations(pose), equations(assembled(platform("pose : pose of platform (1/2, 0, 0)"))));
  EXPECT_EQ(range_of(assembled(platform("tilt : orientation of platform range phi [-15deg, 15deg]")), "tilt"),
            "-pi/12, pi/12");

  const auto crank = [](const std::string& range) {
    std::string text = kFourBar;
    text.replace(text.find("t : joint t2"), 12, "t : orientation of rocker range phi " + range);
    text.insert(text.find("\n[OUTPUTS]"), "   range [0, pi/2]");
    return text;
  };
  const Assembly rocker = assembled(crank("[pi/4, pi/3]"));
  EXPECT_EQ(range_of(rocker, "t2"), "pi/4, pi/3");
  EXPECT_EQ(rocker.mechanism.limits().size(), 0u);
  const Assembly at_limit = assembled(crank("[pi/4, pi/2]"));
  EXPECT_EQ(range_of(at_limit, "t2"), "0, pi/2");
  ASSERT_EQ(at_limit.mechanism.limits().size(), 1u);  // the joint's own, which it meets
  EXPECT_EQ(at_limit.mechanism.limits()[0].upper.text(), "pi/2");
  EXPECT_THAT(equations(at_limit).back(), HasSubstr(">= 0"));
  EXPECT_THAT(fault_of(crank("[-pi/4, pi/3]")),
              HasSubstr("the range of phi of the output 't' goes beyond that of 't2'; expected a range within"));
}

TEST(Assembly, RefusesATurningThatIsNone) {
  EXPECT_THAT(
      fault_of(platform("p : position of platform range phi [0, 1]")),
      HasSubstr("the output 'p' has a range of an angle, but no angle; expected a range of an orientation or a pose"));
  EXPECT_THAT(fault_of(platform("p : pose of platform range phi [1, 0]")),
              HasSubstr("the range of phi of the output 'p' is empty"));
  EXPECT_THAT(fault_of(platform("p : pose of platform range phi [0]")), HasSubstr("has one number"));
  EXPECT_THAT(fault_of(platform("p : pose of platform range phi [0, 1] phi [0, 1]")), HasSubstr("given twice"));
  EXPECT_THAT(fault_of(platform("p : pose of platform keeps Rz(1)")),
              HasSubstr("expected for a robot that moves in a plane: range phi [a, a]"));
  EXPECT_THAT(fault_of("[LINKS]\nbase\nplatform\n[JOINTS]\nspherical s : base (0,0,0) platform (0,0,0)\n"
                       "sph_prs_sph l : base (2,0,0) platform (1,0,0) range [1, 2] actuated\n"
                       "sph_prs_sph m : base (0,2,0) platform (0,1,0) range [1, 2] actuated\n"
                       "sph_prs_sph n : base (0,0,2) platform (0,1,1) range [1, 2] actuated\n"
                       "[OUTPUTS]\no : orientation of platform range phi [0, 1]\n"),
              HasSubstr("the output 'o' has a range of phi, but it turns in space; expected `keeps R` after it"));
}

TEST(Assembly, RefusesAPositionAtRest) {
  const std::string wrist =
      "[DH]\nstandard\na alpha d theta\n0 90deg 0.6 q1\n0 90deg 0 q2\n0 -90deg 0 q3\n[OUTPUTS]\ntip : ";
  EXPECT_THAT(fault_of(wrist + "position of tool\n"),
              HasSubstr("r.cuik:8:1: the output 'tip' does not move; expected a point"));
  EXPECT_NO_THROW(assembled(wrist + "pose of tool\n")) << "it turns";
}

TEST(Assembly, RefusesAnOutputsComponentThatCannotMove) {
  std::string text = kFourBar;
  text.erase(text.find("t : joint t2"));
  EXPECT_THAT(fault_of(text + "p : position of coupler (1, 0, 1/2) only x z\n"),
              HasSubstr("r.cuik:17:1: the component z of the output 'p' cannot move: it is always 0.5;"));
  EXPECT_THAT(fault_of(text + "p : position of coupler (1, 0, 1/2) range z [1, 2]\n"), HasSubstr("the component z"));
  EXPECT_EQ(assembled(text + "p : position of coupler (1, 0, 1/2) only x\n").mechanism.outputs().size(), 1u);
  EXPECT_EQ(assembled(text + "p : position of coupler (1, 0, 1/2)\n").mechanism.outputs().size(), 2u) << "what moves of all";
  const std::string arm =
      "[LINKS]\nbase\na\nb\n[JOINTS]\nrevolute j1 : base (0, 0, 0) + (0, 0, 1)  a (0, 0, 0) + (0, 0, 1) actuated\n"
      "revolute j2 : a (1, 0, 0) + (1, 0, 0)  b (0, 0, 0) + (1, 0, 0)\n[OUTPUTS]\n";
  EXPECT_THAT(fault_of(arm + "p : position of a (1, 0, 2) only x z\n"), HasSubstr("the component z of the output 'p'"));
  EXPECT_EQ(assembled(arm + "p : position of a (1, 0, 2)\n").space, Space::spatial);
}

// GiNaC's order of terms, in which the decisions are kept, is another in each process.
TEST(Assembly, NamesItsConditionsInAnOrderOfTheirTexts) {
  const Assembly arm = assemble(read_part_file(CORANK_SOURCE_DIR "/models/serial/puma_560.cuik"));
  std::vector<std::pair<std::size_t, std::string>> texts;
  for (const symbolic::Condition& c : arm.conditions) texts.emplace_back(c.value.text().size(), c.value.text());
  EXPECT_GT(texts.size(), 5u);
  EXPECT_TRUE(std::ranges::is_sorted(texts));
}

// Twelve numbers of a pose and a joint's value, at a configuration that is known.
TEST(Assembly, SaysWhereLinksAre) {
  const Assembly a = assembled(kFourBar);
  ASSERT_EQ(a.poses.size(), 4u);
  EXPECT_EQ(a.poses[1].link, "crank");
  EXPECT_EQ(a.poses[1].rotation[1][0].text(), "sin(t1)");
  EXPECT_EQ(a.poses[2].origin[0].text(), "a*cos(t1)");
  ASSERT_EQ(a.joint_values.size(), 4u);
  EXPECT_EQ(a.joint_values[0].value.text(), "t1");
  EXPECT_TRUE(a.joint_values[1].sine.has_value()) << "the angle of A is no coordinate";
}

}  // namespace
}  // namespace corank::kinematics
