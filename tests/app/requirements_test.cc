// Requirements as a user gives them: where they reach their limits, how far that is, and paths that keep from there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "corank/tests/app/program.h"
#include "corank/tests/seeds.h"

namespace corank::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const char* const kRequired = "amplification(outputs) <= 2";

void expect_verified(const std::string& file, int status = 0) {
  const auto verify = run_corank({"verify", file});
  EXPECT_EQ(verify.status, status) << verify.out << verify.err;
}

TEST(RequirementCommands, EncloseWhereOneIsAtItsLimit) {
  const TemporaryFolder folder;
  const std::string file = folder.file("r.h5");
  const auto run =
      run_corank({"solve", model("dextar"), "--set", "requirements", "--require", kRequired, "--sigma", "0.1", "-o", file});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("dextar, requirements: "));
  EXPECT_THAT(run.out, HasSubstr("complete: every solution in the search domain is in a box"));
  expect_verified(file, 4);
  const auto none = run_corank({"solve", model("dextar"), "--set", "requirements"});
  EXPECT_EQ(none.status, 1);
  EXPECT_THAT(none.err, HasSubstr("the model has no requirements"));
}

TEST(RequirementCommands, RefuseWhatHasNoEffect) {
  const auto refusal = [](std::vector<std::string> command) {
    command.insert(command.end(), {"--require", kRequired});
    const auto run = run_corank(command);
    EXPECT_EQ(run.status, 2) << run.out;
    return run.err;
  };
  EXPECT_THAT(refusal({"solve", model("dextar"), "--set", "forward"}), HasSubstr("--require: without effect"));
  EXPECT_THAT(refusal({"clearance", model("dextar"), "--set", "inverse", "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y"}),
              HasSubstr("--require: without effect"));
  EXPECT_THAT(refusal({"path", model("dextar"), "--avoid", "forward", "--from", "J3x=0.5,J3y=1", "--to", "J3x=0.5,J3y=1"}),
              HasSubstr("--require: without effect"));
  EXPECT_THAT(refusal({"report", model("dextar"), "--sets", "forward"}), HasSubstr("--require: without effect"));
  EXPECT_THAT(refusal({"map", model("three_slider"), "--over", "L1=1:2", "--over", "L2=1/2:9/10", "--count", "aspects"}),
              HasSubstr("--require"));
}

TEST(RequirementCommands, AreOnAPage) {
  const TemporaryFolder folder;
  const auto run = run_corank({"report", model("dextar"), "--require", kRequired, "-o", folder.file("page")});
  EXPECT_THAT(run.out, HasSubstr("Limits of requirements: ")) << run.err;
  EXPECT_TRUE(std::filesystem::exists(folder.file("page/requirements.h5")));
}

// The band of all robots, and the curve of the one as drawn.
TEST(ToleranceCommands, DrawTheRobotAsDrawnBesideAllRobots) {
  const TemporaryFolder folder;
  const auto run = run_corank(
      {"report", model("dextar"), "--sets", "forward", "-D", "l=0.9±0.01", "--sigma", "0.05", "-o", folder.file("page")});
  EXPECT_EQ(run.status, 0) << run.err;
  std::ifstream stream(folder.file("page/figures/output-portrait.svg"));
  const std::string picture{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(picture, HasSubstr("forward locus (every robot)"));
  EXPECT_THAT(picture, HasSubstr("forward locus (as drawn)"));
  const auto curve = run_corank({"verify", folder.file("page/forward-as-drawn.h5")});
  EXPECT_THAT(curve.out, Not(HasSubstr("every robot"))) << "it is one robot's";
  EXPECT_THAT(curve.out, HasSubstr("verified"));
}

TEST(RequirementCommands, BoundHowFarThatIs) {
  const TemporaryFolder folder;
  const auto run = run_corank({"clearance", model("dextar"), "--require", kRequired, "--at", "J3x=0.59,J3y=0.55", "--in",
                               "J3x,J3y", "--proof", folder.file("c")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("no motion within the ball changes that\nradius in [0.066"));
  EXPECT_THAT(run.out, HasSubstr("it is proven that no limit of a requirement is nearer than the lower bound"));
  expect_verified(folder.file("c-free.h5"));
  expect_verified(folder.file("c-nearest.h5"), 4);
}

// Whether the postures at the centre meet it is examined where angles alone stand in sines; the ball needs no more.
TEST(RequirementCommands, BoundHowFarThatIsOfSinesOfLengths) {
  const TemporaryFolder folder;
  const std::string file = folder.file("sine.cuik");
  std::ofstream(file) << "[SYSTEM VARS]\nx : [-2, 2]\nu : [0, 3]\n[SYSTEM EQS]\nx = sin(u);\n[INPUTS] u\n[OUTPUTS] x\n";
  const auto run =
      run_corank({"clearance", file, "--require", "amplification(outputs) <= 1/2", "--at", "u=1.5", "--in", "u"});
  EXPECT_EQ(run.status, 0) << run.err;
  // |cos u| = 1/2 at u = pi/3, which is 0.4528 from 1.5.
  EXPECT_THAT(run.out, HasSubstr("radius in [0.44"));
}

TEST(RequirementCommands, FindPathsThatKeepFromThere) {
  const TemporaryFolder folder;
  const std::string file = folder.file("p.h5");
  const auto path = [&](const std::string& y, const std::string& mode) {
    return run_corank({"path", model("dextar"), "--require", kRequired, "--from", "J3x=0.59,J3y=0.55", "--from-mode", "1",
                       "--to", "J3x=0.59,J3y=" + y, "--to-mode", mode, "-o", file});
  };
  const auto near = path("0.52", "1");
  EXPECT_EQ(near.status, 0) << near.err;
  EXPECT_THAT(near.out, StartsWith("dextar, limits of requirements avoided\n  status      path, proven\n"));
  const auto verify = run_corank({"verify", file});
  EXPECT_EQ(verify.status, 0) << verify.out;
  EXPECT_THAT(verify.out, StartsWith("dextar: a path without limits of requirements\n"));
  EXPECT_THAT(near.out, HasSubstr("met all along the path, proven"));
  // There the end is faster in that posture.
  EXPECT_THAT(path("0.75", "3").out, HasSubstr("separated: it is proven that no such path exists"));
}

// Two curves, each without x_C <= 1/10 an arc that y_B = 0 divides.
TEST(RequirementCommands, DivideAspects) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.h5");
  const auto run = run_corank({"aspects", model("three_slider"), "--require", "x_C >= 1/10", "-o", file});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("three_slider\n  aspects         4\n  assembly modes  4\n  working modes   2\n"
                                  "  required        x_C >= 1/10\n"));
  expect_verified(file);
  EXPECT_THAT(run_corank({"verify", file}).out, HasSubstr("\n  where           x_C >= 1/10\n"));
  const auto said = run_corank({"aspects", model("three_slider"), "--require", "x_C >= 1/10", "--json"});
  EXPECT_THAT(said.out, HasSubstr("\"require\": [\n    \"x_C >= 1/10\"\n  ]"));
  const auto cusps = run_corank({"aspects", model("dextar"), "--require", kRequired, "--cusps"});
  EXPECT_EQ(cusps.status, 1);
  EXPECT_THAT(cusps.err, HasSubstr("cusps are asked for, and requirements are there"));
}

const char* const kApart = "distance(J5 J4 radius 5 mm, J2 J3 radius 5 mm) >= 0";

TEST(RequirementCommands, KeepBodiesApartAllOverCells) {
  const TemporaryFolder folder;
  const std::string file = folder.file("m.h5");
  const auto run = run_corank({"map", model("dextar"), "--over", "J3x=0:1.2", "--over", "J3y=1/10:1.3", "--resolution", "32",
                               "--require", kApart, "-o", file});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out,
              HasSubstr("\n  required              distance(J5 J4 radius 5 mm, J2 J3 radius 5 mm) >= 0\n  satisfied"));
  EXPECT_THAT(run_corank({"verify", file}).out, HasSubstr("\nverified"));
}

TEST(RequirementCommands, RefuseDistancesWhereTheirLimitsAreAsked) {
  const auto refusal = [](std::vector<std::string> command) {
    command.insert(command.end(), {"--require", kApart});
    const auto run = run_corank(command);
    EXPECT_EQ(run.status, 1) << run.out;
    return run.err;
  };
  const char* const said = "is one of a distance, whose limit is no single equation; expected corank map";
  EXPECT_THAT(refusal({"solve", model("dextar"), "--set", "requirements"}), HasSubstr(said));
  EXPECT_THAT(refusal({"aspects", model("dextar")}), HasSubstr(said));
  EXPECT_THAT(refusal({"clearance", model("dextar"), "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y"}), HasSubstr(said));
}

// The bodies of a robot from parts are its links, with their shapes, and its rods.
TEST(RequirementCommands, AreInFilesOfParts) {
  const TemporaryFolder folder;
  const std::string robot = folder.file("arm.cuik");
  std::ofstream(robot) << "[LINKS]\nbase : sphere 1/10 (3/5, 3/5, 0)\nupper : cylinder 1/20 (0, 0, 0) (1, 0, 0)\n"
                          "fore : point H (1, 0, 0)\n  cylinder 1/20 (0, 0, 0) (1, 0, 0)\n"
                          "[JOINTS]\nrevolute a : base (0, 0, 0) + (0, 0, 1) upper (0, 0, 0) + (0, 0, 1) actuated\n"
                          "revolute b : upper (1, 0, 0) + (0, 0, 1) fore (0, 0, 0) + (0, 0, 1) actuated\n"
                          "[OUTPUTS]\nP : position of fore.H\n[REQUIREMENTS]\n# the post in the way\n"
                          "distance(base, fore) >= 1/10;\npressure_angle(s_2 s_3, s_4 s_5) <= 80 deg;\n";
  const std::string file = folder.file("m.h5");
  const auto run =
      run_corank({"map", robot, "--over", "P_x=1/10:1", "--over", "P_y=-1/2:3/4", "--resolution", "32", "-o", file});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("\n  required              distance(base, fore) >= 1/10\n"));
  EXPECT_THAT(run.out, ::testing::ContainsRegex("\n  satisfied +[1-9]"));
  EXPECT_THAT(run.out, ::testing::ContainsRegex("\n  violated +[1-9]"));
  EXPECT_THAT(run_corank({"verify", file}).out, HasSubstr("\nverified"));
  const auto derived = run_corank({"derive", robot, "--format", "model"});
  EXPECT_THAT(derived.out, HasSubstr("cylinder fore = s_4 s_5 radius 1/20"));
  EXPECT_THAT(derived.out, HasSubstr("distance(base, fore) >= 1/10;"));
}

// D. Chablat, P. Wenger, "Architecture optimization of a 3-DOF translational parallel mechanism for machining applications,
// the Orthoglide", IEEE Trans. Robotics and Automation 19, 2003: with rods of length 1 the velocity amplification is between
// 1/2 and 2 on the cube [-1/sqrt(6), 1/(3 sqrt(2))]^3, whose corners it is 2 or 1/2 at.
TEST(RequirementCommands, KnowTheOrthoglidesCube) {
  const auto cube = [](const std::string& factor) {
    std::vector<std::string> command{"clearance", model("platforms/orthoglide"),
                                     "--require", "amplification(outputs) <= 2",
                                     "--require", "amplification(inputs) <= 2",
                                     "--at",      "x=0,y=0,z=0",
                                     "--in",      "x,y,z"};
    for (const std::string axis : {"x", "y", "z"}) {
      command.insert(command.end(), {"--range", axis + "=[-" + factor + "/sqrt(6)," + factor + "/(3*sqrt(2))]"});
      command.insert(command.end(), {"--range", "d" + std::to_string(axis[0] - 'x' + 1) + "=[1/2,2]"});
    }
    return run_corank(command).out;
  };
  EXPECT_THAT(cube(test::long_run() ? "0.99" : "0.8"), HasSubstr("it is proven that there is no limit of a requirement"));
  if (!test::long_run()) return;
  EXPECT_THAT(cube("1.01"), HasSubstr("nearest limit of a requirement found, proven to exist"));
}

}  // namespace
}  // namespace corank::app
