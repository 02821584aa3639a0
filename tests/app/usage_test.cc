// The command line: help, version, usage errors (exit 2) and bad input (exit 1), each said in one line on standard error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "corank/result/values/result.h"
#include "corank/symbolic/model/set_definition.h"
#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;

void expect_one_line(const Outcome& outcome) {
  EXPECT_THAT(outcome.err, StartsWith("corank: "));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.err.back(), '\n');
  EXPECT_EQ(outcome.out, "");
}

std::vector<std::string> names_in_help() {
  const std::string help = run_corank({"--help"}).out;
  std::vector<std::string> names;
  std::istringstream list(help.substr(help.find("Subcommands:\n") + 13));
  for (std::string line; std::getline(list, line) && !line.empty();)
    if (line.size() > 2 && line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

TEST(Help, OfTheProgramAndOfEverySubcommandHasAnExampleAndNoLineOver100Columns) {
  std::vector<std::vector<std::string>> all{{"--help"}};
  for (const std::string& name : names_in_help()) all.push_back({name, "--help"});
  EXPECT_GE(all.size(), 13u);
  for (const std::vector<std::string>& args : all) {
    const Outcome outcome = run_corank(args);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out, HasSubstr("Example")) << args[0];
    EXPECT_THAT(outcome.out, HasSubstr("\n  corank ")) << args[0];
    EXPECT_EQ(outcome.err, "");
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; }), 100) << line;
  }
}

// A new subcommand is met by the tests below only where it is named; this one meets it anyway.
TEST(Help, OfEverySubcommandIsDescribedInTheDocumentation) {
  const std::string page = read_text(CORANK_SOURCE_DIR "/doc/command_line.md");
  for (const std::string& name : names_in_help()) EXPECT_THAT(page, HasSubstr("\n| `" + name + "` | "));
}

TEST(Help, OfEverySetIsDescribedInTheDocumentation) {
  const std::string page = read_text(CORANK_SOURCE_DIR "/doc/command_line.md");
  const std::size_t begin = page.find("\n## Sets\n"), end = page.find("\n## ", begin + 1);
  ASSERT_LT(end, page.size());
  for (const symbolic::SetDefinition& set : symbolic::set_definitions())
    EXPECT_THAT(page.substr(begin, end - begin),
                ContainsRegex("\n\\| `([a-z-]+`, `)*" + std::string(set.name) + "`[^|]* \\| "));
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
      {{"solve", slider, "--set", "forward", "--sigma", "-inf"}, "--sigma"},
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
    const Outcome outcome = run_corank_in_a_copy(c.args, {});
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
    const Outcome outcome = run_corank_in_a_copy(c.args, {});
    SCOPED_TRACE(testing::PrintToString(c.args));
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(c.expected));
    expect_one_line(outcome);
  }
}

TEST(BadInput, IsAFullDiskAtStandardOutput) {
  EXPECT_EQ(run_corank_into("/dev/full", {"derive", model("three_slider")}), 1);
}

TEST(Usage, AnOutputWithoutANameIsRefused) {
  const std::vector<std::vector<std::string>> commands{{"solve", model("three_slider"), "--set", "forward"},
                                                       {"topology", model("dextar")},
                                                       {"report", model("three_slider")}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.end(), {"-o", ""});
    const Outcome run = run_corank(words);
    EXPECT_EQ(run.status, 2) << words[0];
    EXPECT_NE(run.err.find("-o: no name given; expected the name of a file"), std::string::npos) << run.err;
  }
}

TEST(Usage, NotANumberIsNoWidth) {
  for (const std::string option : {"--width", "--dpi", "--size"}) {
    const Outcome run = run_corank({"plot", "none.h5", "--axes", "x,y", "-o", "x.svg", option, "nan"});
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find(option + ": nan given; expected a number"), std::string::npos) << run.err;
  }
}

// A pipe waits for its writer, and a device has no end: neither is opened.
TEST(BadInput, IsReadFromNoPipeAndNoDevice) {
  const TemporaryFolder folder;
  const std::string slider = model("three_slider");
  for (const char* end : {".cuik", ".h5", ".sol", ".param", ".urdf", ".world", ".loops"})
    ASSERT_EQ(mkfifo(folder.file(std::string("pipe") + end).c_str(), 0600), 0);
  const auto pipe = [&](const char* end) { return folder.file(std::string("pipe") + end); };
  std::vector<std::vector<std::string>> all{
      {"solve", slider, "--set", "forward", "--param", pipe(".param")},
      {"solve", "--resume", pipe(".h5")},
      {"solve", "--refine", pipe(".h5"), "--sigma", "0.1", "-o", folder.file("finer.h5")},
      {"derive", CORANK_SOURCE_DIR "/tests/data/urdf/five_bar.urdf", "--loops", pipe(".loops")},
      {"report", "--results", pipe(".h5")},
      {"plot", pipe(".h5"), "--axes", "x,y", "-o", folder.file("x.svg")},
      {"plot", pipe(".sol"), "--axes", "x,y", "-o", folder.file("x.svg")},
      {"plot", "/dev/zero", "--axes", "x,y", "-o", folder.file("x.svg")},
      {"angles", pipe(".sol"), "1", "2", folder.file("x.sol")},
      {"angles", "/dev/zero", "1", "2", folder.file("x.sol")},
      {"verify", pipe(".h5")},
      {"verify", "/dev/zero"},
      {"derive", pipe(".urdf")},
      {"derive", pipe(".world")},
      {"derive", "/dev/zero"},
      {"derive", pipe(".cuik")},
      {"sweep", pipe(".cuik"), "-D", "L2=0.5:1:2"},
      {"path", pipe(".cuik"), "--from", "x=0", "--to", "x=1"},
      {"clearance", pipe(".cuik"), "--at", "x=0", "--in", "x"},
      {"map", pipe(".cuik"), "--over", "x=0:1", "--over", "y=0:1"}};
  for (const char* command : {"solve", "topology", "aspects", "report"}) all.push_back({command, pipe(".cuik")});
  for (const std::vector<std::string>& args : all) {
    SCOPED_TRACE(testing::PrintToString(args));
    const Outcome outcome = run_corank_in_a_copy(args, {});
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("is not a regular file"));
    expect_one_line(outcome);
  }
}

// A limit of file size refuses what a full disk would.
TEST(Usage, AFullDiskIsSaidAndLeavesNoBrokenResult) {
  const TemporaryFolder folder;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  for (const rlim_t size : {4096, 16384}) {
    for (const std::vector<std::string>& words : {std::vector<std::string>{"solve", model("dextar"), "--set", "forward"},
                                                  {"topology", model("dextar")},
                                                  {"report", model("three_slider")}}) {
      std::vector<std::string> all = words;
      all.insert(all.end(), {"-o", folder.file(words[0] == "report" ? "page" : "x.h5")});
      const rlimit limit{size, before.rlim_max};
      ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
      const Outcome run = run_corank(all);
      ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
      EXPECT_EQ(run.status, 1) << words[0] << ": " << run.err;
      EXPECT_NE(run.err.find("cannot"), std::string::npos) << run.err;
      for (const auto& left : std::filesystem::recursive_directory_iterator(folder.file("")))
        EXPECT_TRUE(left.path().extension() != ".part" && left.path().extension() != ".h5") << left.path();
    }
  }
}

}  // namespace
}  // namespace corank::app
