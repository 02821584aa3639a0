// Postures for tables of poses, beside somebody else's.
#include "corank/analyze/postures/posture_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "corank/tests/analyze/data_sheet_arms.h"

namespace corank::analyze {
namespace {

using ::testing::HasSubstr;

TEST(PostureTable, ComparesSomebodyElsesSolutions) {
  const Arm& ur5 = arms()[0];
  std::mt19937 random(8);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  std::string poses = "tool_x, tool_y, tool_z, qw, qx, qy, qz\n% three of them\n";
  std::vector<Joints> made_by;
  for (int n = 0; n < 3; ++n) {
    made_by.push_back(Joints::NullaryExpr([&] { return angle(random); }));
    const Matrix4d t = hand(ur5, made_by.back());
    const Eigen::Quaterniond q(Eigen::Matrix3d(t.topLeftCorner<3, 3>()));
    char line[400];
    std::snprintf(line, sizeof line, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", t(0, 3), t(1, 3), t(2, 3), q.w(), q.x(),
                  q.y(), q.z());
    poses += line;
  }
  const Table table = parse_table(poses, "poses.csv");
  const PostureFinder finder(question_of(table, arm_question(ur5), ""));
  const std::vector<PoseRow> rows = rows_of(table, "poses.csv");
  solve::Control control;
  const std::vector<Postures> found = find_all(finder, rows, 2, control);
  ASSERT_EQ(found.size(), 3u);
  const std::string csv = to_csv(finder, found);
  EXPECT_EQ(csv, to_csv(finder, find_all(finder, rows, 1, control)));
  solve::Control late({.time = 1, .clock = [now = 0.0]() mutable { return now += 1; }});
  const std::vector<Postures> none = find_all(finder, rows, 2, late);
  EXPECT_EQ(stopped_by(none), "the time limit, in the stage model");
  EXPECT_THAT(to_table(finder, none, nullptr), testing::EndsWith("\nstopped by the time limit, in the stage model\n"));
  EXPECT_EQ(stopped_by(found), "");
  std::size_t all = 0;
  for (const Postures& p : found) all += p.found.size();
  const std::string with_none = csv + "3,0,0,,,,,,,\n";  // as of a pose without postures
  const Comparison own = compare(finder, found, parse_table(with_none, "own.csv"), "own.csv", 1e-9);
  EXPECT_EQ(own.agreed, all);
  EXPECT_TRUE(own.missing.empty() && own.wrong.empty() && own.open.empty());
  // A solver that finds one posture of each pose, turned by a whole turn, and one that is none.
  std::string others = "pose,q1,q2,q3,q4,q5,q6\n";
  for (int n = 0; n < 3; ++n)
    for (const double off : {0.0, 0.01}) {
      others += std::to_string(n + 1);
      for (int k = 0; k < 6; ++k) others += "," + std::to_string(made_by[n][k] + (k == 1 ? 2 * M_PI : 0) + off);
      others += "\n";
    }
  const Comparison other = compare(finder, found, parse_table(others, "others.csv"), "others.csv", 1e-5);
  EXPECT_EQ(other.agreed, 3u);
  EXPECT_EQ(other.wrong.size(), 3u);
  EXPECT_EQ(other.missing.size(), all - 3);
  EXPECT_THAT(to_table(finder, found, &other), HasSubstr("  wrong    3\n    pose 1: q1 ="));
  EXPECT_THAT(to_json(finder, found, &other), HasSubstr("\"against\":{\"agreed\":3,"));
}

TEST(PostureTable, IsRefusedWithItsLine) {
  const auto fault = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(rows_of(parse_table(text, "t.csv"), "t.csv"));
    } catch (const symbolic::ModelError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(fault(""), HasSubstr("t.csv:1:1: the table is empty"));
  EXPECT_THAT(fault("a,b\n1,2\n\n1\n"), HasSubstr("t.csv:4:1: 1 values under 2 names"));
  EXPECT_THAT(fault("a,b,a\n1,2,3\n"), HasSubstr("the column 'a' occurs twice"));
  EXPECT_EQ(fault("\xef\xbb\xbf"
                  "a,b\n1,2\n"),
            "none")
      << "the mark of UTF-8";
  EXPECT_THAT(fault("a,qw\n1,2\n"), HasSubstr("the quaternion is not complete"));
  EXPECT_THAT(fault("qw,qx,qy,qz\n1,0,0,0\n0,0,0,0\n"), HasSubstr("t.csv:3:1: the quaternion"));
  EXPECT_THAT(fault("qw,qx,qy,qz\n1,0,0,z\n"), HasSubstr("t.csv:2:1: the quaternion"));
  EXPECT_EQ(fault("a,b\n1,pi/2\n"), "none");
}

}  // namespace
}  // namespace corank::analyze
