// Robots that are known to be cuspidal are proven to be, and those that are not are never said to be.
#include "corank/analyze/postures/cuspidal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

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

TEST(Cuspidal, ArmsWhosePosturesSignsTellApartStayOpen) {
  const Cuspidality ur5 = asked(robot_of(arm("0 90deg 0.089159 q1\n-0.425 0 0 q2\n-0.39225 0 0 q3\n0 90deg 0.10915 q4\n"
                                             "0 -90deg 0.09465 q5\n0 0 0.0823 q6\n")),
                                3);
  EXPECT_FALSE(ur5.cuspidal);
  EXPECT_EQ(ur5.same_sign, 0u);
  EXPECT_EQ(ur5.most, 8u);
  EXPECT_THAT(ur5.reason, HasSubstr("tell all postures apart"));
  study::Model dextar = study::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik");
  EXPECT_FALSE(asked({.model = std::move(dextar.mechanism)}).cuspidal);
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
