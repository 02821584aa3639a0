// Command lines that make no sense, several hundred of them: each ends soon, with one sentence and the right exit status.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Words = std::vector<std::string>;

#if defined(__SANITIZE_ADDRESS__)
constexpr int kSeconds = 20;
#else
constexpr int kSeconds = 2;  // of processor time
#endif

void expect_refused(const Words& words, int status, const std::string& expected) {
  SCOPED_TRACE(testing::PrintToString(words));
  const Outcome outcome = run_corank_in_a_copy(words, {.cpu_seconds = kSeconds});
  EXPECT_EQ(outcome.status, status) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(expected));
  EXPECT_THAT(outcome.err, StartsWith("corank: "));
  EXPECT_THAT(outcome.err, Not(HasSubstr("bug in corank")));
  EXPECT_THAT(outcome.err, Not(ContainsRegex("[0-9]{30}")));  // of the largest double
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

struct Subcommand {
  Words base;  ///< that works, but for files that are not there
  Words reals, times, integers;
};

// Pages, pictures and results of those that would be accepted go nowhere.
std::vector<Subcommand> subcommands() {
  const std::string slider = model("three_slider"), dextar = model("dextar");
  const std::string nowhere = "/dev/null/at/all";
  const Words ends{"--from", "J3x=0.5,J3y=1", "--to", "J3x=0.7,J3y=1"};
  return {
      {{"solve", slider, "--set", "forward", "-o", nowhere},
       {"--sigma", "--sigma-length", "--sigma-angle", "--tolerance"},
       {"--time-limit", "--every"},
       {"--threads", "--max-boxes", "--max-found", "--max-solutions", "--digits", "--corank"}},
      {{"derive", slider, "-o", nowhere + "/x.cuik"}, {}, {}, {"--corank"}},
      {{"verify", nowhere}, {}, {"--time-limit"}, {"--threads", "--sample"}},
      {{"topology", slider, "-o", nowhere + "/x.h5"}, {}, {"--time-limit"}, {"--threads"}},
      {{"aspects", slider, "-o", nowhere + "/x.h5"}, {}, {"--time-limit"}, {"--threads"}},
      {{"gallery", "--entries", nowhere, "-o", nowhere}, {}, {"--time-limit"}, {"--threads"}},
      {with({"path", dextar, "-o", nowhere}, ends),
       {"--radius"},
       {"--time-limit"},
       {"--threads", "--max-boxes", "--from-mode", "--to-mode"}},
      {{"map", dextar, "--over", "J3x=0:1", "--over", "J3y=0:1", "-o", nowhere + "/x.svg"},
       {},
       {"--time-limit"},
       {"--threads", "--resolution", "--corank"}},
      {{"clearance", dextar, "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y", "--proof", nowhere + "/x"},
       {"--precision"},
       {"--time-limit"},
       {"--threads", "--max-boxes", "--max-found", "--corank"}},
      {{"clearance", dextar, "--map", "J3x,J3y", "-o", nowhere + "/x.svg"},
       {"--precision"},
       {"--time-limit"},
       {"--threads", "--max-boxes", "--grid"}},
      {{"report", slider, "-o", nowhere},
       {"--sigma", "--cspace-sigma"},
       {"--time-limit"},
       {"--threads", "--max-boxes", "--max-found", "--corank"}},
      {{"sweep", slider, "-D", "L2=0.5:1:2", "-o", nowhere},
       {"--sigma", "--cspace-sigma"},
       {"--time-limit"},
       {"--threads", "--max-boxes", "--max-found"}},
      {{"plot", nowhere, "--axes", "x,y", "-o", "x.svg"}, {"--width", "--dpi", "--size"}, {}, {}},
  };
}

TEST(BadCommandLines, ThatGiveNoNumberWhereOneIsExpectedAreRefused) {
  int count = 0;
  for (const Subcommand& sub : subcommands()) {
    const auto refuse = [&](const std::string& option, const Words& values) {
      for (const std::string& value : values) {
        expect_refused(with(sub.base, {option, value}), 2, option);
        ++count;
      }
      expect_refused(with(sub.base, {option}), 2, option);
      ++count;
    };
    const Words never{"nan", "-nan", "", "x", "1x", "-1", "inf", "1e999", "--", "1,2"};
    const auto may_be_infinite = [&](const std::string& option) {
      return sub.base[0] == "solve" && option.starts_with("--sigma");
    };
    for (const std::string& option : sub.reals) {
      Words values = never;
      if (may_be_infinite(option)) std::erase(values, "inf");
      refuse(option, values);
    }
    for (const std::string& option : sub.times) refuse(option, never);
    for (const std::string& option : sub.integers) refuse(option, with(never, {"1.5", "1e2", "99999999999999999999999"}));
  }
  EXPECT_GT(count, 500);
}

TEST(BadCommandLines, ThatNameNothingOrTooMuchAreRefused) {
  for (const Subcommand& sub : subcommands()) {
    const std::string& name = sub.base[0];
    expect_refused({name, "--no-such-option"}, 2, "corank " + name + " --help tells more");
    expect_refused(with(sub.base, {"--no-such-option", "3"}), 2, "not expected: --no-such-option");
    expect_refused(with(sub.base, {"-D"}), 2, "-D");
    if (name == "verify") continue;
    Words without = sub.base;
    if (const auto at = std::find(without.begin(), without.end(), "-o"); at != without.end()) without.erase(at, at + 2);
    expect_refused(with(without, {"-o"}), 2, "-o");
    if (name != "clearance") expect_refused(with(without, {"-o", ""}), 2, "-o: no name given; expected the name of a file");
  }
}

TEST(BadCommandLines, ThatContradictThemselvesAreRefused) {
  const std::string slider = model("three_slider"), dextar = model("dextar");
  struct Case {
    Words words;
    int status;
    std::string expected;
  };
  const Words at{"clearance", dextar, "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y"};
  const Words map{"map", dextar, "--over", "J3x=0:1", "--over", "J3y=0:1"};
  const Words path{"path", dextar, "--from", "J3x=0.5,J3y=1", "--to", "J3x=0.7,J3y=1"};
  const std::vector<Case> cases{
      {{"derive", slider, "-D", "L2=1/0"}, 1, "L2"},
      {{"derive", slider, "-D", "L2=0/0"}, 1, "L2"},
      {{"derive", slider, "-D", "L2=log(0)"}, 1, "L2"},
      {{"derive", slider, "-D", "L2=sqrt(-1)"}, 1, "L2"},
      {{"derive", slider, "-D", "L2=tan(pi/2)"}, 1, "L2"},
      {{"derive", slider, "-D", "L2=asin(2)"}, 1, "L2"},
      {{"derive", slider, "-D", "L2=2^2^2^2^9"}, 1, "L2"},
      {{"derive", slider, "-D", "L2=nan"}, 1, "nan"},
      {{"derive", slider, "-D", "L2=inf"}, 1, "inf"},
      {{"derive", slider, "-D", "L2=L2"}, 1, "L2"},
      {{"derive", slider, "-D", "L2=1)"}, 1, "-D L2"},
      {{"derive", slider, "-D", "L2=(1"}, 1, "-D L2"},
      {{"derive", slider, "-D", "=1"}, 2, "NAME=EXPR"},
      {{"derive", slider, "-D", "L2="}, 2, "NAME=EXPR"},
      {{"derive", slider, "-D", "L2"}, 2, "NAME=EXPR"},
      {{"derive", slider, "-D", ""}, 2, "-D"},
      {{"derive", slider, "-D", "x y=1"}, 1, "x y"},
      {{"derive", model("serial/ur5"), "-D", "no=1"}, 1, "no"},
      {{"derive", ""}, 2, "FILE"},
      {{"derive", "/"}, 1, "directory"},
      {{"derive", "/nowhere/at/all"}, 1, "no such file"},
      {{"derive", slider, "--loops", slider}, 1, "URDF"},
      {{"derive", slider, "--loops", "/nowhere"}, 2, "--loops"},
      {{"derive", slider, "-o", slider}, 2, "not overwritten"},
      {{"solve", slider, "--set", ""}, 2, "--set"},
      {{"solve", slider, "--set", "forward", "--outputs", "y_A"}, 2, "--outputs"},
      {{"solve", slider, "--set", "forward", "--proof"}, 2, "--proof"},
      {{"solve", slider, "--set", "forward", "--corank", "99"}, 1, "corank"},
      {{"solve", slider, "--set", "forward", "--every", "-1s"}, 2, "--every"},
      {{"solve", slider, "--set", "forward", "--every", "s"}, 2, "--every"},
      {{"solve", slider, "--set", "forward", "--memory-limit", "nan"}, 2, "--memory-limit"},
      {{"solve", slider, "--set", "forward", "--memory-limit", ""}, 2, "--memory-limit"},
      {{"solve", slider, "--set", "forward", "--param", "/nowhere"}, 1, "/nowhere"},
      {{"solve", "--resume", "/nowhere"}, 1, "/nowhere"},
      {{"solve", "--resume", slider}, 1, "three_slider"},
      {{"solve", "--refine", slider, "--sigma", "1"}, 2, "-o NEW.h5"},
      {{"solve", "--refine", slider, "--resume", slider, "-o", "x.h5"}, 2, "--resume"},
      {{"solve", "--refine", slider, "--set", "forward", "-o", "x.h5"}, 2, "--set"},
      {{"solve", "--refine", slider, "-o", "x.h5"}, 1, "three_slider"},
      {{"verify", slider}, 1, "three_slider"},
      {{"verify", "/"}, 1, "/"},
      {{"verify"}, 2, "RESULT"},
      {{"verify", "a", "b"}, 2, "b"},
      {{"verify", "a", "--sample", "2", "--require-proof"}, 2, "--sample"},
      {{"topology", slider, "-o", "x.txt"}, 2, ".h5"},
      {{"aspects", slider, "-o", "x.txt"}, 2, ".h5"},
      {{"gallery", "no_robot"}, 2, "no_robot: no entry of the gallery"},
      {{"gallery", "--entries", "/nowhere"}, 1, "/nowhere: no entry is there"},
      {{"gallery", "spider_4", "--quick"}, 2, "no entry is left"},
      {with(at, {"--range", "J3x"}), 2, "--range"},
      {with(at, {"--range", "J3x=[0]"}), 2, "--range"},
      {with(at, {"--range", "J3x=[0,1"}), 2, "--range"},
      {with(at, {"--range", "J3x=[1/0,1]"}), 1, "'1/0' has no value"},
      {with(at, {"--map", "J3x,J3y"}), 2, "--map"},
      {with(at, {"--grid", "3"}), 2, "--grid"},
      {with(at, {"-o", "x.svg"}), 2, "-o"},
      {{"clearance", dextar}, 2, "--at"},
      {{"clearance", dextar, "--at", "J3x=0.5,J3y=1"}, 2, "--in"},
      {{"clearance", dextar, "--at", "J3x=1/0,J3y=1", "--in", "J3x,J3y"}, 1, "'1/0' has no value"},
      {{"clearance", dextar, "--at", "no=1", "--in", "J3x,J3y"}, 1, "no"},
      {{"clearance", dextar, "--at", "J3x", "--in", "J3x,J3y"}, 2, "NAME=VALUE"},
      {{"clearance", dextar, "--at", "J3x=0.5,J3y=1,J3x=0.4", "--in", "J3x,J3y"}, 2, "'J3x' is given twice"},
      {{"clearance", dextar, "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y", "--range", "theta2=[0,1],theta2=[0,2]"},
       2,
       "'theta2' is given twice"},
      {{"clearance", dextar, "--at", "", "--in", "J3x,J3y"}, 2, "--at"},
      {{"tolerance", dextar, "--keep", "clearance>=0.1", "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y"}, 1, "has a tolerance"},
      {{"tolerance", dextar, "--keep", "clearance>=0.1", "--at", "J3x=0.5,J3y=1"}, 2, "--in"},
      {{"tolerance", dextar, "--keep", "path /no/such.h5"}, 1, "/no/such.h5"},
      {{"postures", dextar}, 2, "--at"},
      {{"postures", dextar, "--at", "theta2"}, 2, "NAME=VALUE"},
      {{"postures", dextar, "--at", "theta2=1"}, 1, "leave 1 degree of freedom"},
      {{"postures", dextar, "--at", "theta2=1", "--orientation-of", "x"}, 2, "--orientation beside it"},
      {{"postures", dextar, "--at", "theta2=1", "-o", "x.csv"}, 2, "--table beside it"},
      {{"postures", dextar, "--table", "/no/such.csv"}, 2, "/no/such.csv"},
      {{"cuspidal", dextar, "--poses", "0"}, 2, "--poses"},
      {{"cuspidal", dextar, "--of", "both"}, 2, "--of"},
      {{"tolerance", dextar, "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y"}, 2, "--keep"},
      {{"tolerance", dextar, "--keep", "clearance>0.1", "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y"}, 2, "clearance>=R"},
      {{"tolerance", dextar, "--keep", "clearance>=-1", "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y"}, 2, "clearance>=R"},
      {{"tolerance", dextar, "--keep", "clearance>=1x", "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y"}, 2, "clearance>=R"},
      {{"clearance", dextar, "--map", "J3x=[0,0],J3y=[0,0]", "--time-limit", "5", "-o", "/tmp/corank-map.svg"},
       1,
       "one value of 'J3x' only"},
      {{"clearance", dextar, "--map", "J3x=[1,0],J3y=[0,1]", "-o", "/tmp/corank-map.svg"}, 1, "J3x"},
      {{"clearance", dextar, "--map", "J3x", "-o", "/tmp/corank-map.svg"}, 1, "two coordinates"},
      {{"clearance", dextar, "--map", "J3x,J3x", "-o", "/tmp/corank-map.svg"}, 1, "J3x"},
      {{"clearance", dextar, "--map", "J3x,J3y"}, 2, "-o"},
      {{"clearance", dextar, "--map", "J3x,J3y", "-o", "x.txt"}, 2, ".svg"},
      {{"map", dextar}, 2, "--over"},
      {{"map", dextar, "--over", "J3x=0:1"}, 2, "--over"},
      {{"map", dextar, "--over", "J3x", "--over", "J3y=0:1"}, 2, "--over"},
      {{"map", dextar, "--over", "J3x=0", "--over", "J3y=0:1"}, 2, "--over"},
      {{"map", dextar, "--over", "J3x=0:", "--over", "J3y=0:1"}, 2, "--over"},
      {{"map", dextar, "--over", "no=0:1", "--over", "J3y=0:1"}, 1, "no"},
      {{"map", dextar, "--over", "J3x=0:1/0", "--over", "J3y=0:1"}, 1, "J3x"},
      {{"map", dextar, "--over", "J3x=1:0", "--over", "J3y=0:1"}, 1, "J3x"},
      {{"map", dextar, "--over", "J3x=0:1", "--over", "J3x=0:1"}, 1, "J3x"},
      {with(map, {"--resolution", "63"}), 2, "power of two"},
      {with(map, {"--count", "apples"}), 2, "--count"},
      {with(map, {"--fix", "theta2"}), 2, "--fix"},
      {with(map, {"-o", "x.txt"}), 2, "x.txt"},
      {with(map, {"-o", "x.h5", "--count", "aspects"}), 2, "x.h5"},
      {{"path", dextar}, 2, "--from"},
      {{"path", dextar, "--from", "J3x=0.5,J3y=1"}, 2, "--to"},
      {{"path", dextar, "--from", "J3x", "--to", "J3x=0.7,J3y=1"}, 2, "NAME=VALUE"},
      {{"path", dextar, "--from", "no=1,J3y=1", "--to", "J3x=0.7,J3y=1"}, 1, "no"},
      {{"path", dextar, "--from", "J3x=1/0,J3y=1", "--to", "J3x=0.7,J3y=1"}, 1, "J3x"},
      {with(path, {"--avoid", "rain"}), 2, "--avoid"},
      {with(path, {"--csv", ""}), 2, "--csv"},
      {with(path, {"--report", ""}), 2, "--report"},
      {{"report"}, 2, "FILE"},
      {{"report", slider, "--sets", "sideways"}, 2, "--sets"},
      {{"report", slider, "--results", "/nowhere"}, 2, "--results"},
      {{"report", "--results", slider}, 1, "three_slider"},
      {{"sweep", slider}, 2, "-D"},
      {{"sweep", slider, "-D", "L2=0.5:1"}, 2, "L2"},
      {{"sweep", slider, "-D", "L2=0.5:1:0"}, 2, "L2"},
      {{"sweep", slider, "-D", "L2=0.5:1:x"}, 2, "L2"},
      {{"sweep", slider, "-D", "L2=0.5:1:-3"}, 2, "L2"},
      {{"sweep", slider, "-D", "L2=nan:1:2"}, 1, "L2"},
      {{"sweep", slider, "-D", "L2=0:1/0:2"}, 1, "L2"},
      {{"sweep", slider, "-D", "no=0:1:2"}, 1, "no"},
      {{"plot"}, 2, "RESULT"},
      {{"plot", "/nowhere", "-o", "x.svg"}, 2, "--axes"},
      {{"plot", "/nowhere", "--axes", "x,y"}, 2, "-o"},
      {{"plot", "/nowhere", "--axes", "x", "-o", "x.svg"}, 2, "--axes"},
      {{"plot", "/nowhere", "--axes", "x,y,z,w", "-o", "x.vtp"}, 2, "--axes"},
      {{"plot", "/nowhere", "--axes", "x,y,z", "-o", "x.svg"}, 2, "flat"},
      {{"plot", "/nowhere", "--axes", "x,y", "-o", "x.doc"}, 2, "x.doc"},
      {{"plot", "/nowhere", "--axes", "x,y", "-o", "x.svg"}, 1, "/nowhere"},
      {{"plot", slider, "--axes", "x,y", "-o", "x.svg"}, 1, "three_slider"},
      {{"plot", "/nowhere", "--axes", "x,y", "-o", "x.svg", "--color", "red"}, 2, "--color"},
      {{"studio", "/nowhere"}, 1, "/nowhere"},
      {{"studio", slider, "--port", "-1"}, 2, "--port"},
      {{"studio", slider, "--port", "70000"}, 2, "--port"},
      {{"studio", slider, "-D", "L2"}, 2, "NAME=EXPR"},
      {{"studio", slider, "--threads", "-1"}, 2, "--threads"},
      {{"angles"}, 2, "WORDS"},
      {{"angles", "a.sol"}, 2, "pairs"},
      {{"angles", "a.sol", "1", "b.sol"}, 2, "pairs"},
      {{"angles", "/nowhere", "1", "2", "b.sol"}, 1, "/nowhere"},
      {{"angles", slider, "1", "2", "b.sol"}, 1, "three_slider"},
  };
  for (const Case& c : cases) expect_refused(c.words, c.status, c.expected);
}

}  // namespace
}  // namespace corank::app
