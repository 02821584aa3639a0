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

TEST(MapCommand, ProvesWhereRequirementsAreMet) {
  const TemporaryFolder folder;
  const std::vector<std::string> question{"map",    model("dextar"), "--over",       "J3x=1/4:1",
                                          "--over", "J3y=3/10:1",    "--resolution", "16"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), question.begin(), question.end());
    return run_corank(more);
  };
  const std::string file = folder.file("r.h5");
  const auto run = with({"--require", "amplification(outputs) <= 2", "--require", "J3x <= 2", "-o", file, "-o",
                         folder.file("r.svg"), "-o", folder.file("r.csv")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("required              amplification(outputs) <= 2\n  required              J3x <= 2\n"));
  EXPECT_THAT(run.out, HasSubstr("proven for every solution there"));
  EXPECT_THAT(content(folder.file("r.csv")), StartsWith("J3x_lo,J3x_hi,J3y_lo,J3y_hi,kind,count,at_centre,standing\n"));
  EXPECT_THAT(content(folder.file("r.csv")), HasSubstr(",proven,4,,violated\n"));
  EXPECT_THAT(content(folder.file("r.svg")), HasSubstr("violated by one solution at least"));
  const auto verify = run_corank({"verify", file, "--require-proof"});
  EXPECT_EQ(verify.status, 0) << verify.out;
  EXPECT_THAT(verify.out, HasSubstr("required: amplification(outputs) <= 2\n"));

  const auto of_lengths = with({"--require", "torque(theta2) <= 3 N m under moment(J3x) <= 1"});
  EXPECT_EQ(of_lengths.status, 1);
  EXPECT_THAT(of_lengths.err, HasSubstr("'J3x' is a length; expected a moment on angles"));
  const auto unfinished = with({"--require", "amplification(outputs) <="});
  EXPECT_EQ(unfinished.status, 1);
  EXPECT_THAT(unfinished.err, HasSubstr("requirement:1:26: "));
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
