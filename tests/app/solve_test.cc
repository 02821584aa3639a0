// corank solve: what it prints, writes and returns. Whether the answers are right is for tests/models to check.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <tuple>

#include "corank/result/files/result_file.h"
#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::AnyOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST(Solve, PrintsATableAndNothingElse) {
  const Outcome outcome = run_corank({"solve", model("three_slider"), "--set", "forward"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("three_slider, forward: "));
  EXPECT_THAT(outcome.out, HasSubstr("8 points: 8 isolated"));
  EXPECT_EQ(outcome.err, "") << "no progress where standard error is no terminal";
}

TEST(Solve, PrintsJsonAloneWhereItIsAskedFor) {
  const std::string slider = model("three_slider");
  for (const std::vector<std::string>& args : {std::vector<std::string>{"solve", slider, "--set", "inverse", "--json"},
                                               {"solve", "--set", "inverse", "--json", slider}}) {
    const Outcome outcome = run_corank(args);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json summary = json::parse(outcome.out);
    EXPECT_EQ(summary["model"], "three_slider");
    EXPECT_EQ(summary["set"], "inverse");
    EXPECT_EQ(summary["complete"], true);
    EXPECT_EQ(summary["options"]["kernel"], "right");
    EXPECT_EQ(summary["points"].size(), 4u);
    for (const json& point : summary["points"]) EXPECT_EQ(point["verdict"], "isolated");
    EXPECT_THAT(read_text(slider), StartsWith("%")) << "the model is still there";
  }
}

TEST(Solve, WritesJsonToAFileBesideTheTable) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_corank({"solve", model("three_slider"), "--set", "forward", "--kernel", "left", "--json", folder.file("s.json")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("8 points"));
  const json summary = json::parse(read_text(folder.file("s.json")));
  EXPECT_EQ(summary["options"]["kernel"], "left");
  EXPECT_EQ(summary["points"].size(), 8u);
}

TEST(Solve, EnclosesASetOfCorankTwoThatVerifyAccepts) {
  const TemporaryFolder folder;
  const Outcome outcome = run_corank({"solve", model("dextar"), "--set", "inverse", "--corank", "2", "--proof", "-o",
                                      folder.file("r.h5"), "--json", folder.file("r.json")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("dextar, inverse singularities of corank 2: 18 variables, 20 equations"));
  EXPECT_THAT(outcome.out, HasSubstr("kernel: dimension 2 in 2 boxes"));
  const json summary = json::parse(read_text(folder.file("r.json")));
  EXPECT_EQ(summary["set"], "inverse");
  EXPECT_EQ(summary["corank"], 2);
  EXPECT_EQ(summary["points"].size(), 2u);
  const Outcome verified = run_corank({"verify", folder.file("r.h5")});
  EXPECT_EQ(verified.status, 0) << verified.out;
  EXPECT_THAT(verified.out, StartsWith("dextar, inverse singularities of corank 2: checked"));
  result::Result result = result::read_result(folder.file("r.h5"));
  EXPECT_EQ(result.options.corank, 2);
  result.options.corank = 1;  // another question than the boxes answer
  result::write_result(folder.file("r.h5"), result);
  EXPECT_EQ(run_corank({"verify", folder.file("r.h5")}).status, 1);
}

TEST(Solve, RefusesACorankWhereThereIsNone) {
  for (const auto& [set, corank, status] : {std::tuple{"cspace", "2", 2}, {"forward", "5", 1}}) {
    const Outcome outcome = run_corank({"solve", model("dextar"), "--set", set, "--corank", corank});
    EXPECT_EQ(outcome.status, status);
    EXPECT_THAT(outcome.err, HasSubstr("corank"));
  }
  EXPECT_EQ(run_corank({"solve", model("dextar"), "--set", "forward", "--corank", "0"}).status, 2);
}

TEST(Solve, PutsOverriddenConstantsIn) {
  const Outcome outcome =
      run_corank({"solve", "-D", "L2=1", "-D", "L1=2/2", model("three_slider"), "--set", "forward", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["points"].size(), 6u);
  EXPECT_EQ(summary["options"]["constants"], (json{{"L2", "1"}, {"L1", "2/2"}}));
}

TEST(Solve, WritesAResultThatSaysHowItWasMade) {
  const TemporaryFolder folder;
  const std::string path = folder.file("r.h5"), slider = model("three_slider");
  const Outcome outcome =
      run_corank({"solve",       slider, "--set",       "cspace",  "--sigma",         "0.25",  "-D",           "L2=1/2",
                  "--threads",   "2",    "--max-boxes", "1000000", "--max-solutions", "20000", "--time-limit", "1e6",
                  "--tolerance", "1e-9", "-o",          path});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const result::Result result = result::read_result(path);
  EXPECT_EQ(result.model, "three_slider");
  EXPECT_EQ(result.set, "cspace");
  EXPECT_EQ(result.model_text, read_text(slider));
  EXPECT_EQ(result.options, (result::RunOptions{"", {0.25, 0.25}, {}, 1e-9, 2, 1000000, 20000, 1e6, {{"L2", "1/2"}}}));
  EXPECT_EQ(result.version, result::version());
  EXPECT_EQ(result.cover.dimension, 1);
  EXPECT_TRUE(result.cover.complete());
  EXPECT_GT(result.cover.boxes.size(), 4u);
  std::vector<std::string> names;
  for (const result::ResultVariable& v : result.variables) names.push_back(v.name);
  EXPECT_THAT(names, ElementsAre("y_A", "y_B", "x_C"));
  EXPECT_THAT(result.system_text, HasSubstr("x_C"));
}

TEST(Solve, TakesAPlainSystemWithoutASet) {
  const TemporaryFolder folder;
  const std::string file = folder.write("root.cuik", "[SYSTEM VARS]\nx : [0, 2]\n[SYSTEM EQS]\nx^2 = 2;\n");
  const Outcome outcome = run_corank({"solve", file, "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["model"], "root");
  EXPECT_EQ(summary["set"], "system");
  ASSERT_EQ(summary["points"].size(), 1u);
  EXPECT_LE(summary["points"][0]["values"]["x"]["lo"].get<double>(), 1.4142135623730951);
  EXPECT_GE(summary["points"][0]["values"]["x"]["hi"].get<double>(), 1.414213562373095);
  EXPECT_EQ(summary["points"][0]["verdict"], "isolated");
}

TEST(Solve, GivesAnglesBackInRadians) {
  const TemporaryFolder folder;
  const std::string file = folder.write(
      "angle.cuik", "[SYSTEM VARS]\nt ~ [0, 2*pi]\n[SYSTEM EQS]\ncos(t - pi/3) = -1;\nsin(t) + sin(pi/3) = 0;\n");
  const Outcome outcome = run_corank({"derive", file, "--format", "cuik"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string simple = folder.write("simple.cuik", "[SYSTEM VARS]\nt ~ [0, 2*pi]\n[SYSTEM EQS]\n2*sin(t) = -1;\n");
  const json summary = json::parse(run_corank({"solve", simple, "--json"}).out);
  ASSERT_EQ(summary["points"].size(), 2u);
  std::vector<double> angles;
  for (const json& point : summary["points"]) {
    angles.push_back(point["values"]["t"]["lo"]);
    EXPECT_LT(point["values"]["t"]["hi"].get<double>() - angles.back(), 1e-6);
  }
  std::sort(angles.begin(), angles.end());
  EXPECT_NEAR(angles[0], 7 * 3.141592653589793 / 6, 1e-6);
  EXPECT_NEAR(angles[1], 11 * 3.141592653589793 / 6, 1e-6);
}

TEST(Solve, ShowsNoVariablesButTheModelsOwnInItsTable) {
  const TemporaryFolder folder;
  const std::string file = folder.write("kepler.cuik", "[SYSTEM VARS]\nE : [0, 4]\n[SYSTEM EQS]\nE - sin(2*E)*E = 1;\n");
  const Outcome outcome = run_corank({"solve", file, "-o", folder.file("r.h5")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("3 variables, 3 equations"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("\n  point  E +verdict\n"));
  const result::Result result = result::read_result(folder.file("r.h5"));
  std::vector<VariableKind> kinds;
  for (const result::ResultVariable& v : result.variables) kinds.push_back(v.kind);
  using enum VariableKind;
  EXPECT_THAT(kinds, ElementsAre(length, auxiliary, auxiliary));
  EXPECT_THAT(result.system_text, HasSubstr("s_u_E - sin(u_E) = 0;"));
}

TEST(Solve, EndsAtABoxLimitWithAnIncompleteResult) {
  const TemporaryFolder folder;
  const std::string path = folder.file("r.h5");
  const Outcome outcome =
      run_corank({"solve", model("dextar"), "--set", "cspace", "--max-boxes", "50", "-o", path, "--json"});
  EXPECT_EQ(outcome.status, 3);
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["complete"], false);
  EXPECT_GT(summary["boxes"]["pending"], 0);
  EXPECT_LE(summary["boxes"]["processed"], 60);
  EXPECT_TRUE(summary["points"].is_null());
  EXPECT_FALSE(result::read_result(path).cover.complete());
  EXPECT_THAT(outcome.err, HasSubstr("incomplete"));
}

TEST(Solve, EndsAtATimeLimitWithAnIncompleteResult) {
  const Outcome outcome =
      run_corank({"solve", model("dextar"), "--set", "cspace", "--sigma", "0.0001", "--time-limit", "0.2", "--json"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(json::parse(outcome.out)["complete"], false);
}

TEST(Solve, EndsAfterSoManySolutionsWithAnIncompleteResult) {
  // Another thread may find one more.
  const Outcome outcome =
      run_corank({"solve", model("three_slider"), "--set", "forward", "--max-solutions", "3", "--threads", "1", "--json"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("incomplete"));
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["complete"], false);
  EXPECT_EQ(summary["options"]["max_solutions"], 3);
  EXPECT_EQ(summary["points"].size(), 3u);
  EXPECT_EQ(summary["boxes"]["isolated"], 3);
  EXPECT_GT(summary["boxes"]["pending"], 0);
  const Outcome all = run_corank({"solve", model("three_slider"), "--set", "forward", "--max-solutions", "9", "--json"});
  EXPECT_EQ(all.status, 0) << "there are only eight";
  EXPECT_EQ(json::parse(all.out)["complete"], true);
}

// √3/2 with six digits: as exact numbers the equations contradict each other.
constexpr const char* kRounded =
    "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx = 0.866025;\ny = 0.5;\nx^2 + y^2 = 1;\n";

TEST(Solve, TakesTheDecimalsOfAnOverDeterminedSystemWithinTheToleranceAskedFor) {
  const TemporaryFolder folder;
  const std::string file = folder.write("rounded.cuik", kRounded), path = folder.file("r.h5");
  const json usual = json::parse(run_corank({"solve", file, "--json"}).out);
  EXPECT_EQ(usual["options"]["tolerance"], 1e-6);
  EXPECT_EQ(usual["boxes"]["partial"], 1);
  for (const char* tolerance : {"0", "1e-8"}) {
    const Outcome outcome = run_corank({"solve", file, "--tolerance", tolerance, "--json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const json none = json::parse(outcome.out);
    EXPECT_EQ(none["complete"], true);
    EXPECT_TRUE(none["points"].empty()) << "0.866025^2 + 0.5^2 is 0.9999993";
  }
  const Outcome wide = run_corank({"solve", file, "--tolerance", "1e-4", "-o", path});
  EXPECT_EQ(wide.status, 0) << wide.err;
  EXPECT_THAT(wide.out, HasSubstr("within a relative tolerance of 0.0001"));
  const result::Result result = result::read_result(path);
  EXPECT_EQ(result.options.tolerance, 1e-4);
  EXPECT_EQ(result.cover.tolerance, 1e-4 * kPartialTolerance);
  EXPECT_EQ(result.cover.count(Verdict::partial), 1u);
}

TEST(Solve, ProposesAToleranceWhereRoundedDecimalsContradictEachOther) {
  const TemporaryFolder folder;
  const Outcome outcome = run_corank({"solve", folder.write("rounded.cuik", kRounded), "--tolerance", "0"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("--tolerance 1e-06"));
  EXPECT_THAT(outcome.err, HasSubstr("warning: there are solutions if the coefficients may vary by 1e-06 of their size"));
}

TEST(Solve, TellsARobotThatCannotBeAssembledFromOneWithoutSingularities) {
  const std::string four_bar = model("planar/four_bar_crank_rocker");
  const Outcome apart = run_corank({"solve", four_bar, "--set", "forward", "-D", "d=15"});
  EXPECT_EQ(apart.status, 5);
  EXPECT_THAT(apart.out, HasSubstr("the robot cannot be assembled within its ranges: it is proven"));
  EXPECT_THAT(apart.err, HasSubstr("warning: the robot cannot be assembled"));
  const Outcome free = run_corank({"solve", four_bar, "--set", "forward", "--json"});
  EXPECT_EQ(free.status, 0);
  EXPECT_EQ(free.err, "");
  const json summary = json::parse(free.out);
  EXPECT_EQ(summary["assembled"], true);
  // Theta and psi in the sample close the loop: the coupler has its length.
  const auto middle = [&](const char* name) {
    const json& x = summary["sample"][name];
    return (x["lo"].get<double>() + x["hi"].get<double>()) / 2;
  };
  const double theta = middle("theta"), psi = middle("psi");
  EXPECT_NEAR(std::hypot(5 + 3 * std::cos(psi) - 2 * std::cos(theta), 3 * std::sin(psi) - 2 * std::sin(theta)), 4.5, 1e-6);
  EXPECT_EQ(json::parse(run_corank({"solve", four_bar, "--set", "cspace", "-D", "d=15", "--json"}).out)["assembled"], false);
}

TEST(Solve, TakesTheLengthsOfAMechanismWithinTheToleranceAskedFor) {
  const TemporaryFolder folder;
  const auto solved = [&](const std::vector<std::string>& more) {
    std::vector<std::string> args{"solve", model("three_slider"), "--set", "forward", "--json"};
    args.insert(args.end(), more.begin(), more.end());
    const Outcome outcome = run_corank(args);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(outcome.out);
  };
  const json exact = solved({}), wide = solved({"--tolerance", "1e-4"});
  EXPECT_EQ(exact["options"]["tolerance"], 0);
  EXPECT_EQ(wide["options"]["tolerance"], 1e-4);
  EXPECT_EQ(wide["points"].size(), 8u);
  // L2² = 16/25·(1 ± 10⁻⁴): the points of every such length are in the boxes.
  for (const char* l2 : {"0.79997", "4/5", "0.80003"}) {
    for (const json& point : solved({"-D", std::string("L2=") + l2})["points"]) {
      const auto holds = [&](const json& box) {
        for (const char* name : {"y_A", "y_B", "x_C"}) {
          const json &inner = point["values"][name], &outer = box["values"][name];
          if (outer["lo"] > inner["hi"] || outer["hi"] < inner["lo"]) return false;
        }
        return true;
      };
      EXPECT_EQ(std::count_if(wide["points"].begin(), wide["points"].end(), holds), 1) << l2;
    }
  }
}

std::vector<std::string> endless(const std::string& path) {
  return {"solve", model("dextar"), "--set", "cspace", "--sigma", "0.01", "-o", path, "--json"};
}

TEST(Interrupt, EndsTheSearchWithAReadableIncompleteResult) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    CorankOnTerminal program(endless(folder.file("r.h5")));
    ASSERT_TRUE(program.wait_for("excluded")) << "the progress line";
    program.signal(signal);
    const Outcome outcome = program.finish();
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, HasSubstr("corank: stopped by an interrupt, in the stage search; the result is incomplete"));
    const json summary = json::parse(outcome.out);
    EXPECT_EQ(summary["complete"], false);
    const result::Result result = result::read_result(folder.file("r.h5"));
    EXPECT_FALSE(result.cover.complete());
    EXPECT_EQ(summary["boxes"]["pending"], result.cover.count(Verdict::pending));
    EXPECT_EQ(summary["boxes"]["processed"], result.cover.statistics.processed);
  }
}

TEST(Interrupt, EndsTheProgramAtOnceWhenRepeated) {
  const TemporaryFolder folder;
  CorankOnTerminal program(endless(folder.file("r.h5")));
  ASSERT_TRUE(program.wait_for("excluded"));
  program.signal(SIGSTOP);  // both signals wait until the program goes on
  program.signal(SIGINT);
  program.signal(SIGTERM);
  program.signal(SIGCONT);
  const Outcome outcome = program.finish();
  EXPECT_THAT(outcome.status, AnyOf(128 + SIGINT, 128 + SIGTERM));
  EXPECT_EQ(outcome.out, "");
  EXPECT_FALSE(std::filesystem::exists(folder.file("r.h5")));
}

TEST(Progress, SaysWhatIsDoneAndLeftOnATerminalAndIsWipedOut) {
  CorankOnTerminal program({"solve", model("dextar"), "--set", "cspace", "--sigma", "0.01"});
  ASSERT_TRUE(program.wait_for(" s\x1b[K"));
  program.signal(SIGINT);
  const Outcome outcome = program.finish();
  EXPECT_THAT(outcome.err, testing::ContainsRegex("[0-9]+ done, [0-9]+ left, [0-9.]+ % excluded"));
  EXPECT_THAT(outcome.err, HasSubstr("\r\x1b[Kcorank: stopped by an interrupt"));
}

TEST(Progress, NamesTheStages) {
  const TemporaryFolder folder;
  CorankOnTerminal program({"solve", model("dextar"), "--set", "inverse", "--sigma", "0.2", "-o", folder.file("r.h5")});
  const Outcome outcome = program.finish();
  EXPECT_EQ(outcome.status, 0);
  std::size_t at = 0;
  for (const char* stage : {"\rreduction", "\rsearch", "\rmerging", "\rexact points", "\rkernel dimensions", "\rwriting"}) {
    at = outcome.err.find(stage, at);
    ASSERT_NE(at, std::string::npos) << stage << " in " << outcome.err;
  }
}

// A planar five-bar; RANGE is that of x and y.
std::string five_bar(const std::string& range) {
  std::string text = R"([CONSTANTS]
d := 11/10
[SYSTEM VARS]
x : RANGE
y : RANGE
t1 ~
t2 ~
p1 ~
p2 ~
[SYSTEM EQS]
x = 3/4*cos(t1) + cos(p1);
y = 3/4*sin(t1) + sin(p1);
x = d + 1/2*cos(t2) + cos(p2);
y = 1/2*sin(t2) + sin(p2);
[INPUTS] t1, t2
[OUTPUTS] x, y
)";
  for (std::size_t at = text.find("RANGE"); at != std::string::npos; at = text.find("RANGE")) text.replace(at, 5, range);
  return text;
}

TEST(Solve, NamesTheVariablesWhoseRangesCutTheSet) {
  const TemporaryFolder folder;
  const std::string narrow = folder.write("narrow.cuik", five_bar("[-1, 1]")),
                    wide = folder.write("wide.cuik", five_bar("[-9, 9]"));
  const auto solve = [](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> args = {"solve", file, "--set", "cspace", "--sigma", "0.2"};
    args.insert(args.end(), more.begin(), more.end());
    const Outcome outcome = run_corank(args);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_THAT(solve(narrow, {}),
              AllOf(ContainsRegex("reach[a-z]* the ends? of .*x"), ContainsRegex("reach[a-z]* the ends? of .*y")));
  EXPECT_THAT(solve(wide, {}), Not(HasSubstr("nothing beyond was searched")));
  const json cut = json::parse(solve(narrow, {"--json"})), whole = json::parse(solve(wide, {"--json"}));
  ASSERT_EQ(cut["range_ends"].size(), 2u);
  EXPECT_EQ(cut["range_ends"][0]["variable"], "x");
  EXPECT_EQ(whole["range_ends"].size(), 0u);
  // Every boundary box has its reason, and only the ends of x and y are reasons.
  EXPECT_GT(cut["boxes"]["boundary"], 0);
  int reasons = 0;
  for (const json& reason : cut["boundary_reasons"]) {
    EXPECT_THAT(reason["reason"].get<std::string>(),
                AnyOf("lower end of x", "upper end of x", "lower end of y", "upper end of y"));
    reasons += reason["boxes"].get<int>();
  }
  EXPECT_GE(reasons, cut["boxes"]["boundary"]);
  EXPECT_EQ(whole["boundary_reasons"].size(), 0u);
}

TEST(Solve, ReachesTheEndOfAFreeVariablesRange) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("arc.cuik", "[SYSTEM VARS]\nx : [-1/2, 1/2]\nt ~ [0, pi]\n[SYSTEM EQS]\nx = cos(t)^3;\n");
  const Outcome outcome = run_corank({"solve", file, "--sigma", "0.05", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json summary = json::parse(outcome.out);
  ASSERT_EQ(summary["range_ends"].size(), 1u) << "t stays away from 0 and pi";
  EXPECT_EQ(summary["range_ends"][0]["variable"], "x");
}

TEST(Solve, NamesALimitedAngleAndAnInequality) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("limited.cuik", "[SYSTEM VARS]\nx : \nt ~ [-1, 1]\n[SYSTEM EQS]\nx = sin(t);\nx*cos(t) <= 1/3;\n");
  const Outcome outcome = run_corank({"solve", file, "--sigma", "0.05"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("reach the end of the declared range of t; nothing beyond was searched\n"));
  EXPECT_THAT(outcome.out, HasSubstr("limited.cuik:6 ("));
  EXPECT_THAT(outcome.out, HasSubstr("ranges found from the equations: x in [-0.842, 0.617]\n"));
}

TEST(Solve, FindsTheRangesThatAModelLeavesOut) {
  const TemporaryFolder folder;
  const std::string without = folder.write("bars.cuik", five_bar("")), file = folder.file("r.h5");
  const Outcome outcome = run_corank({"solve", without, "--set", "forward", "--sigma", "0.2", "-o", file});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ranges found from the equations: x in [-0.41, 1.76], y in [-1.51, 1.51]\n"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("nothing beyond was searched")));
  EXPECT_EQ(run_corank({"verify", file}).status, 4) << "all but its completeness, of which the file has no proof";
  EXPECT_THAT(run_corank({"derive", without}).out, HasSubstr("  x : [-0.41, 1.76]   % found from the equations\n"));
  EXPECT_THAT(run_corank({"derive", without, "--format", "cuik"}).out, HasSubstr("\nx    : [-0.41, 1.76]\n"));
  const std::string open = folder.write("open.cuik", "[SYSTEM VARS]\nx :\ny :\n[SYSTEM EQS]\nx*y = 1;\n");
  const Outcome refused = run_corank({"solve", open});
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(
      refused.err,
      HasSubstr("open.cuik:2:1: corank finds no bounds in the equations for 'x', which has no range; expected a range"));
}

}  // namespace
}  // namespace corank::app
