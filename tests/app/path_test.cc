// corank path, from the command line to the file that corank verify takes.
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

std::vector<std::string> dextar(const std::string& to_mode, const std::vector<std::string>& more = {}) {
  std::vector<std::string> args{"path", model("dextar"), "--from",        "J3x=0.5,J3y=1", "--from-mode",
                                "1",    "--to",          "J3x=0.7,J3y=1", "--to-mode",     to_mode};
  args.insert(args.end(), more.begin(), more.end());
  return args;
}

TEST(Path, WritesWhatVerifyConfirms) {
  const TemporaryFolder folder;
  const Outcome outcome = run_corank(dextar("3", {"-o", folder.file("p.h5"), "--csv", folder.file("p.csv"), "--json"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json path = json::parse(outcome.out);
  EXPECT_EQ(path["status"], "path");
  EXPECT_GT(path["radius"], 0.0);
  EXPECT_EQ(path["radii"].size() + 1, path["waypoints"].size());
  EXPECT_NEAR(path["waypoints"].back()["J3x"], 0.7, 1e-12);
  const Outcome verified = run_corank({"verify", folder.file("p.h5")});
  EXPECT_EQ(verified.status, 0);
  EXPECT_THAT(verified.out, AllOf(HasSubstr("a path without forward singularities"), HasSubstr("\nverified\n")));
  EXPECT_EQ(json::parse(run_corank({"verify", "--json", folder.file("p.h5")}).out)["verified"], true);
  EXPECT_THAT(read_text(folder.file("p.csv")), HasSubstr("J3x,J3y,theta2,theta3,theta4,theta5,radius\n0.5"));
}

json path_on(const std::string& page) {
  const std::string begin = "id=\"path\">";
  const std::size_t from = page.find(begin) + begin.size();
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(Path, WritesAPageWhoseFramesBeginAndEndWhereWasAsked) {
  const TemporaryFolder folder;
  const Outcome outcome = run_corank(dextar("3", {"--json", "--report", folder.file("p.html")}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = read_text(folder.file("p.html"));
  const json told = json::parse(outcome.out), shown = path_on(page);
  ASSERT_EQ(shown["nodes"].size(), told["waypoints"].size());
  EXPECT_EQ(shown["pieces"].size(), told["radii"].size());
  const auto ends = {std::pair(0.5, shown["nodes"].front()), {0.7, shown["nodes"].back()}};
  for (const auto& [x, node] : ends) {
    EXPECT_NEAR(node["x"][0], x, 1e-12);  // J3x, J3y, then cosines and sines
    EXPECT_NEAR(node["x"][1], 1.0, 1e-12);
  }
  for (std::size_t k = 0; k < shown["pieces"].size(); ++k) EXPECT_EQ(shown["pieces"][k]["radius"], told["radii"][k]);
  EXPECT_THAT(page, AllOf(HasSubstr("There is a path, proven from end to end."), HasSubstr("boxes-forward"),
                          HasSubstr("--to-mode 3")));
}

TEST(Path, WritesAPageOfBothEndsWhereThereIsNoPath) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_corank(dextar("2", {"--report", folder.file("p.html")})).status, 0);
  const std::string page = read_text(folder.file("p.html"));
  EXPECT_TRUE(path_on(page)["nodes"].empty());
  EXPECT_EQ(path_on(page)["ends"].size(), 2u);
  EXPECT_THAT(page, AllOf(HasSubstr("It is proven that there is no such path."), HasSubstr("class=\"unlike\"")));
}

TEST(Path, SaysThatNoneExistsAndReturnsZero) {
  const Outcome outcome = run_corank(dextar("2"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("separated: it is proven that no such path exists"));
}

TEST(Path, ListsTheConfigurationsToChooseFrom) {
  const Outcome outcome = run_corank({"path", model("dextar"), "--from", "J3x=0.5,J3y=1", "--to", "J3x=0.7,J3y=1"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("--from: 4 configurations have these values"), HasSubstr("\n  4: J3x=0.5 J3y=1")));
}

TEST(Path, RefusesWhatMakesNoSense) {
  const auto run = [](const std::string& from) {
    return run_corank({"path", model("dextar"), "--from", from, "--to", "J3x=0,J3y=1"});
  };
  EXPECT_THAT(run("J3x=0.5").err, HasSubstr("1 of the 2 values that are needed"));
  EXPECT_THAT(run("J3x=0.5,knee=1").err, HasSubstr("there is no coordinate 'knee'"));
  EXPECT_THAT(run("J3x=9,J3y=1").err, HasSubstr("there is no configuration with these values"));
  EXPECT_EQ(run("J3x").status, 2);
  EXPECT_EQ(run("J3x=y,J3y=1").status, 1);
}

TEST(Cuspidal, NamesTheKindOfSingularitiesAndHowToAskForTheOther) {
  const std::vector<std::string> arm = {"cuspidal", model("serial/orthogonal_3r_section"), "--poses", "1"};
  const Outcome forward = run_corank(arm), inverse = run_corank(with(arm, {"--of", "inverse"}));
  EXPECT_EQ(forward.status, 0) << forward.err;
  EXPECT_THAT(forward.out, AllOf(HasSubstr("open whether it is cuspidal, without forward singularities: "),
                                 HasSubstr("1 pose tried, at most 1 posture, "), HasSubstr("\n--of inverse asks ")));
  EXPECT_THAT(inverse.out, AllOf(HasSubstr("without inverse singularities"), Not(HasSubstr("--of"))));
}

TEST(Path, EndsByItsTimeLimit) {
  const Outcome outcome = run_corank(dextar("4", {"--time-limit", "1e-9"}));
  EXPECT_EQ(outcome.status, 3);
}

}  // namespace
}  // namespace corank::app
