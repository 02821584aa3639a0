// Arms by rows of Denavit and Hartenberg: forward kinematics of the assembled robot against products of the rows' matrices.
#include "corank/kinematics/language/part_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "corank/kinematics/language/part_file.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/unit_vectors.h"
#include "corank/symbolic/writing/printer.h"
#include "corank/tests/kinematics/assembled.h"
#include "corank/tests/kinematics/read_robot.h"

namespace corank::kinematics {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Row {
  double a, alpha, d, theta;
  char varies;  ///< 't', 'd', or '-'
  int sense = 1;
};

/// The textbook's matrices, in numbers: standard Rz Tz Tx Rx, modified Rx Tx Rz Tz.
Transform matrix(bool standard, const Row& row, double q) {
  const double theta = row.theta + (row.varies == 't' ? row.sense * q : 0),
               d = row.d + (row.varies == 'd' ? row.sense * q : 0);
  const double ct = std::cos(theta), st = std::sin(theta), ca = std::cos(row.alpha), sa = std::sin(row.alpha);
  if (standard) return {{{{ct, -st * ca, st * sa}, {st, ct * ca, -ct * sa}, {0, sa, ca}}}, {row.a * ct, row.a * st, d}};
  return {{{{ct, -st, 0}, {st * ca, ct * ca, -sa}, {st * sa, ct * sa, ca}}}, {row.a, -sa * d, ca * d}};
}

std::string decimal(double hundredths) {
  const int n = static_cast<int>(std::lround(std::abs(hundredths) * 100));
  return (hundredths < 0 ? "-" : "") + std::to_string(n / 100) + "." + std::to_string(n / 10 % 10) + std::to_string(n % 10);
}

TEST(DenavitHartenberg, RandomArmsAreTheProductsOfTheirMatrices) {
  std::mt19937 random(6);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  const auto one_of = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  const double degree = M_PI / 180;
  for (int arm = 0; arm < 24; ++arm) {
    const bool standard = arm % 2 == 0, commas = arm % 3 == 0;
    std::string text = std::string("[DH]\n") + (standard ? "standard" : "modified") + "\na alpha d theta\n";
    std::vector<Row> rows;
    const int n = 2 + one_of(4);
    int turns = 0;
    for (int i = 0; i < n; ++i) {
      Row row{};
      row.a = one_of(2) ? std::round(100 * uniform(-2, 2)) / 100 : 0;
      row.d = one_of(2) ? std::round(100 * uniform(-2, 2)) / 100 : 0;
      const int quarter_turns[] = {0, 90, -90, 180, 45, 20};
      const int alpha = quarter_turns[one_of(6)], theta = quarter_turns[one_of(6)];
      row.alpha = alpha * degree, row.theta = theta * degree;
      row.varies = i + 1 == n && turns > 0 ? '-' : one_of(4) ? 't' : 'd';
      row.sense = row.varies != '-' && one_of(4) == 0 ? -1 : 1;
      turns += row.varies == 't';
      const std::string name = "q" + std::to_string(i + 1), own = row.sense < 0 ? "-" + name : name;
      const std::string between = commas ? " , " : "  ", plus = commas ? " + " : "+";
      std::string d = decimal(row.d), turn = std::to_string(theta) + "deg";
      if (row.varies == 'd') d += (row.sense < 0 ? "" : plus) + own;
      if (row.varies == 't') turn = own + (theta < 0 ? "" : plus) + turn;
      text += decimal(row.a) + between + std::to_string(alpha) + "deg" + between + d + between + turn +
              (row.varies == 'd' ? " range [-4, 4]" : "") + "\n";
      rows.push_back(row);
    }
    if (turns == 0) continue;  // without rotations there is nothing to lay out
    Robot robot;
    ASSERT_NO_THROW(robot = parse_parts(text, "arm.cuik")) << text;
    robot.outputs.clear();
    const Assembly a = assemble(robot);
    for (int k = 0; k < 5; ++k) {
      std::map<std::string, double> q;
      Transform truth;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const double value = uniform(-3, 3);
        if (rows[i].varies != '-') q["q" + std::to_string(i + 1)] = value;
        truth = truth * matrix(standard, rows[i], value);
      }
      expect_same(pose_of(a, "tool", completed(a, q)), truth, text);
    }
  }
}

// The table of Corke's mdl_puma560 is the robot of models/serial/puma_560.cuik, equation for equation.
TEST(DenavitHartenberg, ThePuma560IsTheModelBuiltFromItsLinks) {
  const std::string path = CORANK_SOURCE_DIR "/models/serial/puma_560.cuik";
  const symbolic::Mechanism by_links = assemble(read_part_file(path)).mechanism;
  std::string text = symbolic::read_text(path);
  text = text.substr(0, text.find("[LINKS]")) +
         "[DH]\nstandard\n"
         "a   alpha   d   theta\n"
         "0   90deg   0   theta1  limits [t1, t1]\n"
         "a2  0       0   theta2  limits [lo2, up2]\n"
         "a3  -90deg  d3  theta3  limits [lo3, up3]\n"
         "0   90deg   d4  theta4  limits [t4, t4]\n"
         "0   -90deg  0   theta5  limits [lo5, up5]\n"
         "0   0       0   theta6  limits [t6, t6]  link link6\n"
         "[OUTPUTS]\nhand : pose of link6\n";
  const Assembly by_rows = assemble(parse_parts(text, "puma_560.cuik"));
  EXPECT_EQ(by_rows.mobility, 6);
  const auto without_drawing = [](symbolic::Mechanism m) {
    m.drawing({});
    return symbolic::to_model(m);
  };
  EXPECT_EQ(without_drawing(by_rows.mechanism), without_drawing(by_links));
}

// The two conventions of one arm, SCARA: the same places of the tool.
TEST(DenavitHartenberg, BothConventionsOfOneArmAgree) {
  const Assembly standard = assemble(
      parse_parts("[DH] standard\n a alpha d theta\n0.4 0 0.3 q1\n0.25 180deg 0 q2\n0 0 q3 0 limits [0, 1/5]\n", "r.cuik"));
  const Assembly modified = assemble(
      parse_parts("[DH] modified\n a alpha d theta\n0 0 0.3 q1\n0.4 0 0 q2\n0.25 180deg q3 0 limits [0, 1/5]\n", "r.cuik"));
  const std::map<std::string, double> q{{"q1", 0.4}, {"q2", -1.1}, {"q3", 0.13}};
  expect_same(pose_of(standard, "tool", completed(standard, q)), pose_of(modified, "tool", completed(modified, q)), "");
  EXPECT_THAT(standard.mechanism.inputs(), ElementsAre("q1", "q2", "q3"));
  EXPECT_THAT(standard.mechanism.outputs(), ElementsAre("tool_x", "tool_y", "tool_z"));
}

TEST(DenavitHartenberg, ColumnsStandInAnyOrderAndRowsNameTheirLinks) {
  const Robot robot = parse_parts(
      "[CONSTANTS]\nl := 2   side := -90deg\n[LINKS]\nfloor\nhand : point P (1, 0, 0)\n"
      "[DH]\nModified from floor\ntheta  d  a  alpha   # as in the data sheet\n"
      "q1 0 0 0 limits [-170deg, 170deg] link shoulder actuated  % , not a column\n\n"
      "(q2 - 90deg) l (l + 1)/2 side\n"
      "0 q3+l 0 90deg link hand\n[OUTPUTS]\np : position of hand.P\n",
      "r.cuik");
  std::vector<std::string> links;
  for (const Link& link : robot.links) links.push_back(link.name);
  EXPECT_THAT(links, ElementsAre("floor", "hand", "shoulder", "link1"));
  ASSERT_EQ(robot.joints.size(), 3u);
  EXPECT_EQ(robot.joints[0].kind, JointKind::revolute);
  EXPECT_EQ(robot.joints[0].ranges[0]->lower.text(), "-17*pi/18");
  EXPECT_TRUE(robot.joints[0].actuated);
  EXPECT_FALSE(robot.joints[1].actuated);
  EXPECT_EQ(robot.joints[1].ends[0].point[0].text(), "(l + 1)/2");
  EXPECT_EQ(robot.joints[2].kind, JointKind::prismatic);
  EXPECT_EQ(robot.outputs.size(), 1u);
}

struct RowFault {
  std::string rows, place, problem, expectation;
};

TEST(DenavitHartenberg, FaultsSayWhereAndWhatWasExpected) {
  const std::string head = "[DH]\nstandard\na alpha d theta\n";
  const std::vector<RowFault> cases{
      {"[DH]\na alpha d theta\n0 0 0 q", "2:1", "found 'a'", "standard or modified"},
      {"[DH]\nstandard from floor\na alpha d theta\n0 0 0 q", "2:15", "there is no link 'floor'", "is declared before"},
      {"[DH]\nstandard\na alpha a theta\n0 0 0 q", "3:9", "the column 'a' occurs twice here", "once"},
      {"[DH]\nstandard\n0 0 0 q", "3:1", "found '0'", "a alpha d theta"},
      {head, "2:1", "there is no row", "a row for each joint"},
      {head + "0 0 q1\n", "4:7", "found the end of the line where the column 'theta' of the row should be",
       "four expressions"},
      {head + "0 0 0 q1 - 90deg\n", "4:10", "found '-'", "blanks or commas separate columns"},
      {head + "0, 0, 0 q1\n", "4:9", "found 'q1'", "',' and the next column"},
      {head + "0 0 d1 q1\n", "4:8", "two names in this row, 'd1' and 'q1', are not constants", "one joint's name"},
      {head + "l1 0 0 q1\n", "4:1", "the constant 'l1' in the column 'a' is not defined before", "joints vary theta or d"},
      {head + "0 0 0 2*q1\n", "4:9", "the column 'theta' is '2*q1'", "q1 - 90deg"},
      {head + "0 0 0 q1\n0 0 0 q1\n", "5:7", "the joint 'q1' is already there, in line 4", "another name"},
      {head + "0 0 0 0 actuated\n", "4:1", "the row is actuated, but there is no joint's name in theta or d", "theta = q1"},
      {head + "0 0 0 0 limits [0, 1]\n", "4:16", "the fix joint has one range", "none for this kind"},
      {head + "0 0 0 q1 limits [1, 0]\n", "4:17", "the range of the revolute joint 'q1' is empty", "[lower, upper]"},
      {head + "0 0 0 q1 link base\n", "4:15", "the row ends at the link 'base' from which it begins", "another link"},
      {head + "0 0 0 q1 linc tool\n", "4:10", "found 'linc'", "limits [lower, upper], actuated, link"}};
  for (const RowFault& c : cases) {
    try {
      parse_parts(c.rows, "r.cuik");
      ADD_FAILURE() << c.rows;
    } catch (const symbolic::ModelError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("r.cuik:" + c.place + ": " + c.problem)) << c.rows;
      EXPECT_THAT(error.what(), HasSubstr(c.expectation)) << c.rows;
    }
  }
}

TEST(DenavitHartenberg, DegreesWithoutDegAreNoted) {
  const auto notices = [](const std::string& rows) {
    return parse_parts("[CONSTANTS]\ntwist := 90\nhalf := pi\n[DH]\nstandard\na alpha d theta\n" + rows, "r.cuik").notices;
  };
  EXPECT_THAT(notices("0 -90 0 q1\n1 0 0 q2\n"), ElementsAre("line 7: alpha = -90 is in radians; write degrees as 90deg"));
  EXPECT_THAT(notices("0 twist 0 q1-45\n"), ElementsAre(HasSubstr("alpha = twist is"), HasSubstr("theta = -45 is")));
  EXPECT_THAT(notices("0 -90deg 0 q1+half\n100 -pi/2 300 q2-1.5708\n0 6.28 d3 0\n"), testing::IsEmpty());
}

TEST(DenavitHartenberg, ASectionAloneIsARobot) {
  EXPECT_TRUE(has_parts("% an arm\n[DH]\nstandard\n"));
  EXPECT_FALSE(has_parts("[SYSTEM VARS]\nDH : [0, 1]\n"));
}

TEST(DenavitHartenberg, DirectionsInLongArmsAreUnitVectors) {
  std::mt19937 random(1);
  for (int arm = 0; arm < 6; ++arm) {
    std::string text = "[DH]\nstandard\na alpha d theta\n";
    for (int joint = 1; joint <= 9; ++joint) {
      const int twists[] = {90, -90, 90, -90, 30, -45, 180};
      text += decimal(0.1 * static_cast<int>(random() % 4)) + " " + std::to_string(twists[random() % 7]) + "deg " +
              decimal(0.1 * static_cast<int>(random() % 4)) + " q" + std::to_string(joint) + "\n";
    }
    SCOPED_TRACE(text);
    const symbolic::Mechanism mechanism =
        assemble(parse_parts(text + "[OUTPUTS]\ntip : pose of tool\n", "r.cuik")).mechanism;
    const std::set<std::string> units = symbolic::unit_vector_components(mechanism);
    std::size_t directions = 0;
    for (const symbolic::Coordinate& c : mechanism.coordinates())
      if (c.auxiliary && (c.name.starts_with("u_") || c.name.starts_with("n_"))) {
        ++directions;
        EXPECT_TRUE(units.contains(c.name)) << c.name;
      }
    EXPECT_GT(directions, 20U);
  }
}

}  // namespace
}  // namespace corank::kinematics
