// --json [PATH] in every subcommand that gives a result: to a file beside the table, or to standard output in its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;

struct JsonCommand {
  std::vector<std::string> args;  // without the file
  std::string file;
  std::string member;  // of its JSON
};

std::vector<JsonCommand> commands(const TemporaryFolder& folder) {
  const std::string slider = model("three_slider"), result = folder.file("r.h5");
  EXPECT_EQ(run_corank({"solve", slider, "--set", "forward", "-o", result}).status, 0);
  return {
      {{"derive", "--set", "forward"}, slider, "systems"},
      {{"solve", "--set", "forward"}, slider, "points"},
      {{"solve", "--set", "cspace", "--sigma", "0.05", "--estimate"}, slider, "seconds"},
      {{"verify"}, result, "verified"},
      {{"report", "--sets", "forward,inverse", "-o", folder.file("page")}, slider, "sets"},
      {{"sweep", "-D", "L2=0.8:1:2", "--sets", "forward", "-o", folder.file("family")}, slider, "members"},
      {{"map", "--over", "L1=1:2", "--over", "L2=1:2", "--fix", "x_C=1/2", "--resolution", "8", "--no-boundary"},
       slider,
       "cells"},
      {{"clearance", "--at", "x_C=0.5", "--in", "x_C"}, slider, "radius"},
      {{"tolerance", "-D", "l=0.9±0.01", "--keep", "clearance>=0.1", "--precision", "0.5", "--at", "J3x=0.5,J3y=1", "--in",
        "J3x,J3y"},
       model("dextar"),
       "factor"},
      {{"clearance", "--best", "x_C=[0.4,0.6]", "--precision", "0.5"}, slider, "radius"},
      {{"clearance", "--map", "x_C=[0.4,0.6],y_A=[0.9,1]", "--grid", "2", "-o", folder.file("map.csv")}, slider, "cells"},
      {{"postures", "--at", "x_C=0.5"}, slider, "postures"},
      {{"cuspidal", "--poses", "2"}, slider, "cuspidal"},
      {{"topology"}, slider, "components"},
      {{"aspects"}, slider, "aspects"},
      {{"path", "--from", "x_C=0.5", "--from-mode", "1", "--to", "x_C=0.51", "--to-mode", "1"}, slider, "waypoints"},
  };
}

TEST(Json, IsWrittenToAFileBesideTheTable) {
  const TemporaryFolder folder;
  for (const JsonCommand& c : commands(folder)) {
    SCOPED_TRACE(c.args[0] + " " + c.member);
    const std::string path = folder.file("out.json");
    std::filesystem::remove(path);
    const Outcome outcome = run_corank(with(c.args, {c.file, "--json", path}));
    EXPECT_TRUE(outcome.status == 0 || (outcome.status == 4 && c.args[0] == "verify")) << outcome.err;
    ASSERT_TRUE(std::filesystem::exists(path));
    EXPECT_TRUE(json::parse(read_text(path)).contains(c.member));
    EXPECT_NE(outcome.out, "");
    EXPECT_FALSE(json::accept(outcome.out)) << outcome.out;
  }
}

TEST(Json, TakesThePlaceOfTheTableWhereverTheFileStands) {
  const TemporaryFolder folder;
  for (const JsonCommand& c : commands(folder)) {
    SCOPED_TRACE(c.args[0] + " " + c.member);
    for (const auto& last : {std::vector<std::string>{c.file, "--json"}, {"--json", c.file}}) {
      const Outcome outcome = run_corank(with(c.args, last));
      ASSERT_TRUE(json::accept(outcome.out)) << outcome.out << outcome.err;
      EXPECT_TRUE(json::parse(outcome.out).contains(c.member));
    }
  }
}

TEST(Json, GoesToStandardOutputWhereThePathIsADash) {
  const Outcome outcome = run_corank({"solve", model("three_slider"), "--set", "forward", "--json", "-"});
  EXPECT_EQ(json::parse(outcome.out)["set"], "forward");
  EXPECT_FALSE(std::filesystem::exists("-"));
}

TEST(Json, IsNotWrittenOverAModelOrWhereNoFileCanBe) {
  const TemporaryFolder folder;
  const std::string slider = model("three_slider"), copy = folder.write("copy.cuik", "");
  for (const char* command : {"topology", "aspects", "derive", "report"}) {
    const Outcome over = run_corank({command, slider, "--json", copy});
    EXPECT_EQ(over.status, 2) << command;
    EXPECT_THAT(over.err, HasSubstr("looks like a model"));
    EXPECT_EQ(run_corank({command, slider, "--json", folder.file("none/r.json")}).status, 1) << command;
    EXPECT_THAT(run_corank({command, "--json"}).err, HasSubstr("FILE is required"));
  }
  EXPECT_EQ(read_text(copy), "");
  EXPECT_THAT(run_corank({"verify", "--json"}).err, HasSubstr("RESULT is required"));
}

TEST(Json, IsTextWhateverTheModelsFileIsCalled) {
  const TemporaryFolder folder;
  const std::string slider = folder.write("\xe9.cuik", read_text(model("three_slider")));
  for (const char* command : {"derive", "topology", "aspects"}) {
    const Outcome outcome = run_corank({command, slider, "--json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(json::accept(outcome.out)) << command << outcome.out;
  }
}

TEST(Json, OfDeriveHasTheEquationsThatItPrints) {
  const json all = json::parse(run_corank({"derive", model("three_slider"), "--set", "forward", "--json"}).out);
  EXPECT_EQ(all["constraints"].size(), 2u);
  EXPECT_EQ(all["velocity"]["columns"], json({"y_A", "y_B", "x_C"}));
  EXPECT_EQ(all["inputs"], json({"y_A"}));
  ASSERT_EQ(all["systems"].size(), 1u);
  const std::string text = run_corank({"derive", model("three_slider"), "--set", "forward"}).out;
  for (const json& equation : all["systems"][0]["equations"])
    EXPECT_THAT(text, HasSubstr(equation["relation"].get<std::string>()));
  EXPECT_GT(json::parse(run_corank({"derive", model("planar/arm_2r_limits"), "--set", "boundary", "--json"}).out)["systems"]
                .size(),
            1u);
}

TEST(WithoutEffect, OptionsAreErrorsThatNameThem) {
  const TemporaryFolder folder;
  const std::string slider = model("three_slider"), dextar = model("dextar"), shape = folder.file("shape.h5"),
                    result = folder.file("r.h5");
  ASSERT_EQ(run_corank({"topology", slider, "-o", shape}).status, 0);
  ASSERT_EQ(run_corank({"solve", slider, "--set", "cspace", "-o", result}).status, 0);
  struct Case {
    std::vector<std::string> args;
    std::string expected;
  };
  const std::vector<Case> cases{
      {{"derive", slider, "--format", "model", "--set", "forward"}, "--set: without effect"},
      {{"derive", slider, "--format", "latex", "--json"}, "--format: without effect"},
      {{"derive", slider, "--kernel", "left"}, "--kernel"},
      {{"solve", slider, "--set", "cspace", "--kernel", "left"}, "--kernel"},
      {{"solve", slider, "--set", "forward", "--every", "5s"}, "--every: without effect; expected --checkpoint"},
      {{"solve", slider, "--set", "forward", "--area"}, "--area: without effect; expected --set boundary"},
      {{"report", slider, "--sets", "forward", "--cspace-sigma", "1"}, "--cspace-sigma: without effect"},
      {{"report", slider, "--sets", "cspace", "--sigma", "1"}, "--sigma: without effect"},
      {{"report", "--results", result, "--proof"}, "--proof: without effect"},
      {{"sweep", slider, "-D", "L2=1:2:2", "--sets", "cspace", "--sigma", "1"}, "--sigma: without effect"},
      {{"plot", result, "--axes", "y_A,y_B", "-o", folder.file("p.svg"), "--dpi", "99"}, "--dpi: without effect"},
      {{"plot", result, "--axes", "y_A,y_B", "-o", folder.file("p.vtp"), "--title", "T"}, "--title: without effect"},
      {{"map", slider, "--count", "aspects", "--no-boundary"}, "--no-boundary: without effect"},
      {{"clearance", dextar, "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y", "--orientation-of", "x"},
       "--orientation-of: without effect"},
      {{"clearance", dextar, "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y", "--grid", "9"}, "--grid"},
      {{"aspects", model("planar/four_bar_crank_rocker"), "--areas"}, "--areas: without effect"},
      {{"verify", shape, "--sample", "3"}, "--sample: without effect"},
  };
  for (const auto& [args, expected] : cases) {
    const Outcome outcome = run_corank_in_a_copy(args, {});
    EXPECT_EQ(outcome.status, 2) << expected;
    EXPECT_THAT(outcome.err, HasSubstr(expected));
    EXPECT_EQ(outcome.out, "");
  }
  const Outcome range =
      run_corank({"clearance", dextar, "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y", "--orientation-range", "9deg"});
  EXPECT_EQ(range.status, 1);
  EXPECT_THAT(range.err, HasSubstr("the range of the orientation has no effect"));
}

}  // namespace
}  // namespace corank::app
