// corank clearance: what it prints, writes and returns. Whether the radii are right is for tests/analyze.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kBallOfDextar = {"--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y"};

std::vector<std::string> of(const std::string& name, const std::vector<std::string>& more) {
  return with({"clearance", model(name)}, more);
}

TEST(Clearance, PrintsTheBoundsAndTheNearestSingularityOfTheManual) {
  const Outcome outcome = run_corank(of("dextar", kBallOfDextar));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("dextar, forward: ball in J3x, J3y"), HasSubstr("radius in [0.157818, 0.159413]"),
                                 HasSubstr("proven to exist"), HasSubstr("theta3 =")));
  const std::string manual = read_text(std::string(CORANK_SOURCE_DIR) + "/doc/clearance.md");
  EXPECT_THAT(manual, AllOf(HasSubstr("corank clearance models/dextar.cuik --at J3x=0.5,J3y=1 --in J3x,J3y"),
                            HasSubstr("[0.157818, 0.159413]")));
}

TEST(Clearance, WritesJson) {
  const Outcome outcome =
      run_corank(of("dextar", with(kBallOfDextar, {"--set", "inverse", "--precision", "0.001", "--json"})));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json c = json::parse(outcome.out);
  EXPECT_EQ(c["model"], "dextar");
  EXPECT_EQ(c["set"], "inverse");
  EXPECT_EQ(c["in"], json({"J3x", "J3y"}));
  EXPECT_EQ(c["at"]["J3x"], "0.5");
  const double lo = c["radius"]["lo"], hi = c["radius"]["hi"];
  // The left arm stretched: J3 on the circle of radius 1.8 about J5; the right one: about J1.
  const double truth = std::min(1.8 - std::hypot(0.5, 1), 1.8 - std::hypot(0.5 - 1.18, 1));
  EXPECT_LE(lo, truth);
  EXPECT_GE(hi, truth * (1 - 1e-12));
  EXPECT_GE(lo, 0.999 * hi * (1 - 1e-12));
  EXPECT_LE(c["nearest"]["J3x"]["lo"], c["nearest"]["J3x"]["hi"]);
  EXPECT_EQ(c["center"], "assembled");
  EXPECT_EQ(c["complete"], true);
  EXPECT_EQ(c["stopped"], nullptr);
}

TEST(Tolerance, MayGrowByTheFactorOfTheManual) {
  const Outcome outcome = run_corank({"tolerance", model("dextar"), "-D", "l=0.90±0.001", "-D", "d=1.18±0.001", "--keep",
                                      "clearance >= 0.15", "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string factor = "factor of the tolerances in [11.3125, 11.375]";
  EXPECT_THAT(outcome.out, AllOf(HasSubstr(factor), HasSubstr("within the upper bound there is a robot that does not")));
  EXPECT_THAT(read_text(std::string(CORANK_SOURCE_DIR) + "/doc/as_built.md"), HasSubstr(factor));
}

TEST(Clearance, WritesWhatVerifyConfirms) {
  const TemporaryFolder folder;
  const Outcome outcome = run_corank(of("dextar", with(kBallOfDextar, {"--proof", folder.file("c")})));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(run_corank({"verify", folder.file("c-free.h5")}).status, 0);
  const Outcome nearest = run_corank({"verify", folder.file("c-nearest.h5")});
  EXPECT_EQ(nearest.status, 4) << nearest.out << nearest.err;
}

TEST(Clearance, CallsTheNearestConfigurationOfCspaceNoSingularity) {
  const Outcome outcome = run_corank(of("dextar", with(kBallOfDextar, {"--set", "cspace"})));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("nearest configuration found"), Not(HasSubstr("singularity"))));
}

TEST(Clearance, KeepsBoundsThatHoldWhereALimitEndsIt) {
  const Outcome outcome =
      run_corank(of("dextar", with(kBallOfDextar, {"--max-boxes", "3", "--precision", "1e-5", "--json"})));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("the bounds hold"));
  const json c = json::parse(outcome.out);
  EXPECT_EQ(c["complete"], false);
  EXPECT_LE(c["radius"]["lo"].get<double>(), 0.1595);
}

TEST(Clearance, MapsNoRegionOfOneValue) {
  const TemporaryFolder folder;
  for (const char* region : {"J3x=[0,0],J3y=[0,0]", "J3x=[0,1],J3y=[1,1]", "J3x=[0,1],J3y=[5,6]", "J3x=[0,1],J3y=[1,0]"}) {
    const Outcome outcome = run_corank({"clearance", model("dextar"), "--map", region, "-o", folder.file("map.svg")});
    EXPECT_EQ(outcome.status, 1) << region << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("region")) << region;
  }
}

TEST(Clearance, SaysWhatItExpects) {
  const struct {
    std::vector<std::string> args;
    int status;
    const char* said;
  } cases[] = {
      {{"--at", "J3x", "--in", "J3x"}, 2, "expected NAME=VALUE"},
      {{"--at", "J3x=0.5", "--in", "J3x,J3y"}, 1, "'J3y' has no value"},
      {{"--at", "J3x=0.5,J3z=1", "--in", "J3x"}, 1, "there is no coordinate 'J3z'"},
      {{"--at", "J3x=5,J3y=1", "--in", "J3x,J3y"}, 1, "outside its range [-1.8, 1.8]"},
      {{"--at", "J3x=-1.5,J3y=0", "--in", "J3x,J3y"}, 1, "no configuration at the centre"},
      {{"--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y", "--mode", "theta2=3"}, 2, "expected NAME=[A,B]"},
      {{"--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y", "--orientation", "Rx(1)", "--orientation-range", "5deg"},
       1,
       "no orientation in space"},
      {{"--in", "J3x,J3y"}, 2, "--at is required"},
      {{"--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y", "--set", "boundary"}, 2, "boundary not in {cspace,forward,"},
  };
  for (const auto& [args, status, said] : cases) {
    const Outcome outcome = run_corank(of("dextar", args));
    EXPECT_EQ(outcome.status, status) << said << ": " << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(said));
  }
}

}  // namespace
}  // namespace corank::app
