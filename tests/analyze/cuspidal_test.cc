// Robots that are known to be cuspidal are proven to be, and those that are not are never said to be.
#include "corank/analyze/postures/cuspidal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "corank/kinematics/equations/six_joints.h"
#include "corank/result/values/claim_files.h"
#include "corank/study/model.h"

namespace corank::analyze {
namespace {

using ::testing::HasSubstr;

study::Question robot_of(const std::string& text) {
  study::Model model = study::parse_model({text, "robot.cuik"});
  return {.model = std::move(model.mechanism), .assembly = std::move(model.assembly)};
}

std::string arm(const std::string& rows) { return "[CONSTANTS]\nunit m\n[DH]\nstandard\na alpha d theta\n" + rows; }

Cuspidality asked(const study::Question& question, int poses = 10) {
  solve::Control control;
  return cuspidality(question, {.poses = poses, .progress = {}}, control);
}

// Two postures that differ, both at the pose, and a tube that the checker accepts.
void expect_proof(const Cuspidality& c) {
  ASSERT_EQ(c.cuspidal, true) << c.reason;
  ASSERT_EQ(c.from.size(), c.to.size());
  double apart = 0;
  for (std::size_t k = 0; k < c.from.size(); ++k) {
    EXPECT_LT(c.from[k].value.width(), 1e-9);
    apart = std::max(apart, std::fabs(std::remainder(c.from[k].value.mid() - c.to[k].value.mid(), 2 * M_PI)));
  }
  EXPECT_GT(apart, 1e-3);
  EXPECT_GT(c.path->tube->radius(), 1e-6);
  const check::TubeReport report = result::verify(to_file(*c.finder, *c.path));
  EXPECT_TRUE(report.verified()) << result::to_table(report, to_file(*c.finder, *c.path));
}

TEST(Cuspidal, ArmsWithoutASphericalWristAreProvenToBe) {
  const Cuspidality crx = asked(robot_of(arm("0 -90deg 0 q1\n0.71 0 0 q2\n0 -90deg 0 q3\n0 90deg 0.54 q4\n"
                                             "0 -90deg 0.15 q5\n0 0 0.16 q6\n"))),
                    gofa = asked(robot_of(arm("0 90deg 0.265 q1\n0.444 0 0 q2\n0.11 -90deg 0 q3\n0 90deg 0.47 q4\n"
                                              "0.08 -90deg 0 q5\n0 0 0.101 q6\n")));
  expect_proof(crx);
  expect_proof(gofa);
  EXPECT_THAT(to_json(gofa, "gofa", "path.h5"), HasSubstr("\"certificate\": \"path.h5\""));
  EXPECT_THAT(to_text(gofa, "gofa"), HasSubstr("gofa: cuspidal, proven: two postures joined without inverse singularities"));
}

TEST(Cuspidal, AnOrthogonalArmOfThreeJointsAndAPlatformOnThreeLegsAreProvenToBe) {
  // Wenger's example: d2 = 1, d3 = 2, d4 = 3/2, r2 = 1.
  expect_proof(asked(robot_of(arm("1 -90deg 0 q1\n2 90deg 1 q2\n1.5 0 0 q3\n"))));
  study::Model rpr = study::read_model(CORANK_SOURCE_DIR "/models/planar/3rpr.cuik");
  const Cuspidality platform = asked({.model = std::move(rpr.mechanism), .assembly = std::move(rpr.assembly)}, 20);
  EXPECT_EQ(platform.of, Avoid::forward);
  expect_proof(platform);
}

const char* const kPuma =
    "0 90deg 0 q1\n0.4318 0 0 q2\n0.0203 -90deg 0.15005 q3\n0 90deg 0.4318 q4\n0 -90deg 0 q5\n0 0 0 q6\n";
const char* const kUr5 =
    "0 90deg 0.089159 q1\n-0.425 0 0 q2\n-0.39225 0 0 q3\n0 90deg 0.10915 q4\n0 -90deg 0.09465 q5\n0 0 0.0823 q6\n";

bool is_signed(const std::string& rows) {
  const study::Question question = robot_of(arm(rows));
  const kinematics::Robot& robot = *question.assembly->robot;
  return kinematics::signed_arm(robot, robot.links.size() - 1).has_value();
}

TEST(Cuspidal, IndustrialArmsAreProvenNotToBe) {
  const std::string shoulder = "0.15 90deg 0.4 q1\n0.6 0 0 q2\n0.2 90deg 0 q3\n",  // an offset of axis 2
      oblique_wrist = "0 50deg 0.7 q4\n0 -50deg 0 q5\n0 0 0.1 q6\n";
  for (const std::string& rows : {std::string(kPuma), std::string(kUr5), shoulder + oblique_wrist}) {
    const Cuspidality c = asked(robot_of(arm(rows)));
    EXPECT_EQ(c.cuspidal, false) << rows;
    EXPECT_FALSE(c.path);
    EXPECT_THAT(to_json(c, "arm", "path.h5"), HasSubstr("\"certificate\": null"));
    EXPECT_THAT(to_text(c, "arm"), HasSubstr("arm: not cuspidal, proven: "));
  }
}

// What a theorem says of arms is not said of those next to them, a length or an angle off.
TEST(Cuspidal, OtherArmsAreNotClaimedNotToBe) {
  struct Change {
    const char *arm, *from, *to;
  };
  const std::vector<Change> changes{{kPuma, "0 90deg 0 q1", "0 80deg 0 q1"},
                                    {kPuma, "0.4318 0 0 q2", "0.4318 5deg 0 q2"},
                                    {kPuma, "0 90deg 0.4318 q4", "0.01 90deg 0.4318 q4"},
                                    {kPuma, "0 -90deg 0 q5", "0 -90deg 0.01 q5"},
                                    {kPuma, "0 -90deg 0 q5", "0.01 -90deg 0 q5"},
                                    {kUr5, "-0.39225 0 0 q3", "-0.39225 1deg 0 q3"},
                                    {kUr5, "0 -90deg 0.09465 q5", "0.01 -90deg 0.09465 q5"},
                                    {kUr5, "0 90deg 0.10915 q4", "0 89deg 0.10915 q4"},
                                    {kUr5, "0 90deg 0.089159 q1", "0 91deg 0.089159 q1"}};
  for (const Change& change : changes) {
    std::string rows = change.arm;
    EXPECT_TRUE(is_signed(rows));
    rows.replace(rows.find(change.from), std::string(change.from).size(), change.to);
    EXPECT_FALSE(is_signed(rows)) << change.to;
  }
}

TEST(Cuspidal, RobotsWhosePosturesSignsTellApartStayOpen) {
  study::Model dextar = study::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik");
  const Cuspidality c = asked({.model = std::move(dextar.mechanism)});
  EXPECT_FALSE(c.cuspidal);
  EXPECT_EQ(c.same_sign, 0u);
  EXPECT_THAT(c.reason, HasSubstr("tell all postures apart"));
}

TEST(Cuspidal, IsAskedOfWholeRobotsAndOneKindOfSingularity) {
  study::Model locked = study::read_model(CORANK_SOURCE_DIR "/models/serial/orthogonal_3r.cuik");
  const study::Question question{.model = std::move(locked.mechanism), .assembly = std::move(locked.assembly)};
  try {
    asked(question);
    ADD_FAILURE() << "a locked joint";
  } catch (const symbolic::ModelError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the range of 'theta1' has one value"));
  }
  solve::Control control;
  EXPECT_THROW(cuspidality(question, {.of = Avoid::both, .progress = {}}, control), symbolic::ModelError);
}

}  // namespace
}  // namespace corank::analyze
