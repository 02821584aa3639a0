// The command line: help, version, usage errors (exit 2) and bad input (exit 1), each said in one line on standard error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "corank/result/result.h"
#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

void expect_one_line(const Outcome& outcome) {
  EXPECT_THAT(outcome.err, StartsWith("corank: "));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.err.back(), '\n');
  EXPECT_EQ(outcome.out, "");
}

TEST(Help, OfTheProgramAndOfEverySubcommandHasAnExample) {
  for (const std::vector<std::string>& args : {std::vector<std::string>{"--help"},
                                               {"derive", "--help"},
                                               {"solve", "--help"},
                                               {"report", "--help"},
                                               {"sweep", "--help"}}) {
    const Outcome outcome = run_corank(args);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out, HasSubstr("Example"));
    EXPECT_THAT(outcome.out, HasSubstr("\n  corank "));
    EXPECT_EQ(outcome.err, "");
  }
}

TEST(Help, OfSolveNamesEveryOption) {
  const std::string help = run_corank({"solve", "--help"}).out;
  for (const char* option : {"FILE", "--set", "--sigma", "--kernel", "--threads", "--max-boxes", "--max-solutions",
                             "--time-limit", "--memory-limit", "--tolerance", "-D", "-o", "--json"}) {
    EXPECT_THAT(help, HasSubstr(option));
  }
}

TEST(Version, IsPrintedToStandardOutput) {
  const Outcome outcome = run_corank({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "corank " + result::version() + "\n");
}

struct Case {
  std::vector<std::string> args;
  std::string expected;  ///< part of the message
};

TEST(Usage, IsRefusedWithStatus2AndOneLine) {
  const std::string slider = model("three_slider");
  const TemporaryFolder folder;
  const std::string plain = folder.write("plain.cuik", "[SYSTEM VARS]\nx : [0, 2]\n[SYSTEM EQS]\nx^2 = 2;\n");
  const std::vector<Case> cases{
      {{}, "subcommand"},
      {{"dissolve", slider}, "subcommand"},
      {{"solve"}, "FILE"},
      {{"derive"}, "FILE"},
      {{"solve", slider, "--set", "forward", "--speed", "9"}, "--speed"},
      {{"solve", slider, "--set", "forward", slider}, "three_slider"},
      {{"solve", slider}, "--set is required"},
      {{"solve", plain, "--set", "forward"}, "plain system"},
      {{"derive", plain, "--set", "forward"}, "plain system"},
      {{"solve", slider, "--set", "sideways"}, "sideways"},
      {{"solve", slider, "--set", "forward", "--kernel", "middle"}, "middle"},
      {{"derive", slider, "--format", "pdf"}, "pdf"},
      {{"solve", slider, "--set", "forward", "--sigma", "0"}, "--sigma"},
      {{"solve", slider, "--set", "forward", "--sigma", "-1"}, "--sigma"},
      {{"solve", slider, "--set", "forward", "--sigma", "inf"}, "--sigma"},
      {{"solve", slider, "--set", "forward", "--sigma", "nan"}, "--sigma"},
      {{"solve", slider, "--set", "forward", "--sigma", "small"}, "--sigma"},
      {{"solve", slider, "--set", "forward", "--sigma"}, "--sigma"},
      {{"solve", slider, "--set", "forward", "--threads", "-1"}, "--threads"},
      {{"solve", slider, "--set", "forward", "--threads", "1.5"}, "--threads"},
      {{"solve", slider, "--set", "forward", "--max-boxes", "-1"}, "--max-boxes"},
      {{"solve", slider, "--set", "forward", "--max-boxes", "many"}, "--max-boxes"},
      {{"solve", slider, "--set", "forward", "--max-solutions", "-1"}, "--max-solutions"},
      {{"solve", slider, "--set", "forward", "--max-solutions", "few"}, "--max-solutions"},
      {{"solve", slider, "--set", "forward", "--tolerance", "-1e-6"}, "--tolerance"},
      {{"solve", slider, "--set", "forward", "--tolerance", "nan"}, "--tolerance"},
      {{"solve", slider, "--set", "forward", "--tolerance", "0.1"}, "--tolerance"},
      {{"solve", slider, "--set", "forward", "--time-limit", "-1"}, "--time-limit"},
      {{"solve", slider, "--set", "forward", "--time-limit", "nan"}, "--time-limit"},
      {{"solve", slider, "--set", "forward", "--memory-limit", "much"}, "--memory-limit"},
      {{"solve", slider, "--set", "forward", "--memory-limit", "-1G"}, "--memory-limit"},
      {{"report", slider, "--sigma", "nan"}, "--sigma"},
      {{"report", slider, "--cspace-sigma", "inf"}, "--cspace-sigma"},
      {{"report", slider, "--time-limit", "inf"}, "--time-limit"},
      {{"report", slider, "--memory-limit", "8X"}, "--memory-limit"},
      {{"report", slider, "--max-found", "-1"}, "--max-found"},
      {{"sweep", slider, "-D", "L2=0.5:1:2", "--sigma", "nan"}, "--sigma"},
      {{"sweep", slider, "-D", "L2=0.5:1:2", "--time-limit", "-1"}, "--time-limit"},
      {{"solve", slider, "--set", "forward", "-D", "L2"}, "NAME=EXPR"},
      {{"solve", slider, "--set", "forward", "-D", "=1"}, "NAME=EXPR"},
      {{"solve", slider, "--set", "forward", "-D", "L2="}, "NAME=EXPR"},
      {{"solve", slider, "--set", "forward", "--json", model("dextar")}, "looks like a model"},
      {{"solve", slider, "--set", "forward", "-o", slider}, "looks like a model"},
  };
  for (const Case& c : cases) {
    const Outcome outcome = run_corank(c.args);
    SCOPED_TRACE(testing::PrintToString(c.args));
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(c.expected));
    expect_one_line(outcome);
  }
}

TEST(BadInput, IsRefusedWithStatus1AndOneLine) {
  const std::string slider = model("three_slider");
  const TemporaryFolder folder;
  int n = 0;
  const auto file = [&](const std::string& text) { return folder.write("bad" + std::to_string(++n) + ".cuik", text); };
  const std::string vars = "[SYSTEM VARS]\nx : [0, 2]\n", inputs = "[INPUTS] x\n[OUTPUTS] y\n";
  const std::vector<Case> cases{
      {{"solve", folder.file("missing.cuik")}, "missing.cuik"},
      {{"solve", folder.file("")}, "corank-app-"},
      {{"solve", file("")}, "bad1.cuik"},
      {{"solve", file(std::string("\0\x01\xff\xfe", 4))}, "bad2.cuik:1"},
      {{"solve", file(vars + "[SYSTEM EQS]\nx^2 = z;\n")}, "bad3.cuik:4:"},
      {{"solve", file(vars + "[SYSTEM EQS]\nx^2 = ;\n")}, "bad4.cuik:4:"},
      {{"derive", file(vars + "[SYSTEM EQS]\ntan(x) = 1;\n"), "--format", "cuik"}, "bad5.cuik:4"},
      {{"solve", file("[SYSTEM VARS]\nx : [0, 2]\ny : [0, 2]\nz : [0, 1]\n[SYSTEM EQS]\nx = y;\n" + inputs), "--set",
        "forward"},
       "bad6.cuik"},
      {{"solve", slider, "--set", "forward", "-D", "L3=1"}, "L3"},
      {{"solve", slider, "--set", "forward", "-D", "L2=1+"}, "-D L2:1:"},
      {{"solve", slider, "--set", "forward", "-D", "L2=y_A"}, "y_A"},
      {{"solve", slider, "--set", "forward", "-D", "L2=1/0"}, "L2"},
      {{"solve", slider, "--set", "cspace-singular", "--kernel", "right"}, "right"},
      {{"solve", slider, "--set", "forward", "-o", folder.file("none/r.h5")}, "none/r.h5"},
      {{"solve", slider, "--set", "forward", "-o", folder.file("")}, "cannot write"},
      {{"solve", slider, "--set", "forward", "--json", folder.file("none/r.json")}, "none/r.json"},
  };
  for (const Case& c : cases) {
    const Outcome outcome = run_corank(c.args);
    SCOPED_TRACE(testing::PrintToString(c.args));
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(c.expected));
    expect_one_line(outcome);
  }
}

TEST(BadInput, IsAFullDiskAtStandardOutput) {
  EXPECT_EQ(run_corank_into("/dev/full", {"derive", model("three_slider")}), 1);
}

}  // namespace
}  // namespace corank::app
