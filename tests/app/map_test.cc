// corank map as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string content(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(MapCommand, CountsDrawsAndWritesCells) {
  const TemporaryFolder folder;
  const auto run =
      run_corank({"map",   model("dextar"),      "--over", "l2=1/2:3/2",         "--over",       "l3=1/2:3/2",
                  "--fix", "theta2=pi/3",        "--fix",  "theta5=2",           "--resolution", "16",
                  "-o",    folder.file("m.svg"), "-o",     folder.file("m.csv"), "-o",           folder.file("m.pdf"),
                  "-o",    folder.file("m.json")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("2 solutions"));
  EXPECT_THAT(run.out, HasSubstr("proven for every value there"));
  EXPECT_THAT(content(folder.file("m.csv")), StartsWith("l2_lo,l2_hi,l3_lo,l3_hi,kind,count,at_centre\n"));
  EXPECT_THAT(content(folder.file("m.csv")), HasSubstr(",proven,2,\n"));
  EXPECT_THAT(content(folder.file("m.svg")), HasSubstr("<title>solutions meet</title>"));
  EXPECT_THAT(content(folder.file("m.pdf")), StartsWith("%PDF"));
  EXPECT_THAT(content(folder.file("m.json")), HasSubstr("\"boundary_known\":true"));
}

TEST(MapCommand, WritesWhatVerifyConfirms) {
  const TemporaryFolder folder;
  const std::string file = folder.file("m.h5");
  const auto run = run_corank({"map", model("dextar"), "--over", "l2=1/2:3/2", "--over", "l3=1/2:3/2", "--fix",
                               "theta2=pi/3", "--fix", "theta5=2", "--resolution", "16", "-o", file});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto verify = run_corank({"verify", file, "--require-proof"});
  EXPECT_EQ(verify.status, 0) << verify.out;
  EXPECT_THAT(verify.out, StartsWith("dextar: numbers of solutions over l2 and l3\n"));
  EXPECT_THAT(verify.out, EndsWith("\nverified\n"));
  EXPECT_THAT(run_corank({"verify", file, "--json"}).out, HasSubstr("\"complete\": true"));
  const auto centres = run_corank({"map", model("three_slider"), "--over", "L1=1:2", "--over", "L2=1/2:9/10", "--count",
                                   "aspects", "--resolution", "8", "-o", file});
  EXPECT_EQ(centres.status, 2);
  EXPECT_THAT(centres.err, HasSubstr("there is no certificate for that"));
}

TEST(MapCommand, PrintsJsonAlone) {
  const auto run = run_corank({"map", model("three_slider"), "--set", "inverse", "--over", "L1=1:2", "--over", "L2=1/2:9/10",
                               "--resolution", "8", "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("{\"model\":\"three_slider\",\"set\":\"inverse\",\"count\":\"solutions\""));
  EXPECT_THAT(run.out, HasSubstr("\"proven\",4,null]"));
  EXPECT_THAT(run.out, Not(HasSubstr("undecided")));
}

TEST(MapCommand, SaysWhatIsMissing) {
  const std::string file = model("dextar");
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"map", file});
    return run_corank(more);
  };
  EXPECT_EQ(with({"--over", "l2=1/2:1"}).status, 2);
  EXPECT_EQ(with({"--over", "l2", "--over", "l3=0:1"}).status, 2);
  EXPECT_EQ(with({"--over", "l2=1/2:1", "--over", "l3=1/2:1", "--resolution", "20"}).status, 2);
  EXPECT_EQ(with({"--over", "l2=1/2:1", "--over", "l3=1/2:1", "-o", "map.txt"}).status, 2);
  EXPECT_EQ(with({"--over", "l2=1/2:1", "--over", "l3=1/2:1", "--count", "aspects", "--set", "forward"}).status, 2);
  const auto surface = with({"--over", "l2=1/2:1", "--over", "l3=1/2:1"});
  EXPECT_EQ(surface.status, 1);
  EXPECT_THAT(surface.err, HasSubstr("no number of solutions to count"));
}

}  // namespace
}  // namespace corank::app
