// corank aspects as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using ::testing::HasSubstr;

TEST(AspectsCommand, WritesWhatIsVerified) {
  const TemporaryFolder folder;
  const std::string file = folder.file("aspects.h5");
  EXPECT_EQ(run_corank({"aspects", model("three_slider"), "-o", file}).status, 0);
  const auto table = run_corank({"verify", file, "--require-proof"});
  EXPECT_EQ(table.status, 0);
  EXPECT_THAT(table.out, testing::EndsWith("\nverified\n"));
  const auto json = nlohmann::json::parse(run_corank({"verify", file, "--json"}).out);
  EXPECT_EQ(json["complete"], true);
  EXPECT_EQ(json["aspects"]["at_most"], 8);
  EXPECT_EQ(json["working_modes"]["at_most"], 4);
}

TEST(AspectsCommand, DrawsEachAspectOverOutputsAndInputs) {
  const TemporaryFolder folder;
  const std::string file = folder.file("aspects.svg");
  EXPECT_EQ(run_corank({"aspects", model("planar/five_bar_sliders"), "-o", file}).status, 0);
  std::ifstream stream(file);
  const std::string svg{std::istreambuf_iterator<char>(stream), {}};
  int panels = 0;
  for (std::size_t at = svg.find("class=\"region\""); at != std::string::npos; at = svg.find("class=\"region\"", at + 1))
    ++panels;
  EXPECT_EQ(panels, 2 * 8);
}

TEST(AspectsCommand, SaysWhereThereIsNoPicture) {
  const TemporaryFolder folder;
  const auto curve = run_corank({"aspects", model("three_slider"), "-o", folder.file("a.svg")});
  EXPECT_EQ(curve.status, 2);
  EXPECT_THAT(curve.err, HasSubstr("two dimensions"));
  EXPECT_EQ(run_corank({"aspects", model("three_slider"), "-o", folder.file("a.txt")}).status, 2);
}

TEST(AspectsCommand, PrintsTheSignsOfTheDeterminants) {
  const auto json = run_corank({"aspects", model("three_slider"), "--json"});
  EXPECT_EQ(json.status, 0);
  EXPECT_THAT(json.out, HasSubstr("\"det_L_y\": 1"));
  EXPECT_THAT(json.out, HasSubstr("\"det_L_y\": -1"));
}

}  // namespace
}  // namespace corank::app
