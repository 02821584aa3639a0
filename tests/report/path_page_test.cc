// A path's page: what it says, and what its script reads.
#include "corank/report/html/path_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::report {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct Asked {
  symbolic::Mechanism mechanism;
  PathView view;
};

Asked asked(const std::string& model, const std::vector<std::pair<std::string, std::string>>& from, int from_mode,
            const std::vector<std::pair<std::string, std::string>>& to, int to_mode, analyze::PathOptions options = {}) {
  const study::Question question{
      .model = study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + model + ".cuik").mechanism};
  const auto values = [](const std::vector<std::pair<std::string, std::string>>& list) {
    std::vector<analyze::NamedValue> result;
    for (const auto& [name, text] : list) result.push_back({name, symbolic::parse_expression(text, name)});
    return result;
  };
  solve::Control control;
  analyze::PathFinder finder(question, options);
  const Box a = finder.end(values(from), from_mode, "from", control), b = finder.end(values(to), to_mode, "to", control);
  return {question.model, path_view(finder, finder.find(a, b, control))};
}

Asked joined() { return asked("dextar", {{"J3x", "1/2"}, {"J3y", "1"}}, 1, {{"J3x", "0.6"}, {"J3y", "1"}}, 1); }
Asked apart() { return asked("dextar", {{"J3x", "1/2"}, {"J3y", "1"}}, 1, {{"J3x", "0.6"}, {"J3y", "1"}}, 2); }

std::vector<std::string> names(const System& system) {
  std::vector<std::string> result;
  for (const Variable& v : system.variables) result.push_back(v.name);
  return result;
}

TEST(PathView, BringsTheTubeIntoTheOrderOfThePagesVariables) {
  const Asked a = joined();
  ASSERT_TRUE(a.view.path.tube);
  std::vector<std::string> order = names(a.view.system);
  const json straight = json::parse(path_json(a.view, order));
  std::reverse(order.begin(), order.end());
  json turned = json::parse(path_json(a.view, order));
  EXPECT_EQ(straight["status"], "path");
  ASSERT_EQ(turned["nodes"].size(), a.view.path.tube->nodes.size());
  ASSERT_EQ(turned["pieces"].size() + 1, turned["nodes"].size());
  const auto back = [](json& list) { std::reverse(list.begin(), list.end()); };
  for (json& end : turned["ends"]) back(end);
  for (json& node : turned["nodes"]) {
    back(node["x"]);
    for (json& row : node["rows"]) back(row);
  }
  for (json& piece : turned["pieces"])
    for (const char* side : {"lower", "upper"}) back(piece[side]);
  EXPECT_EQ(turned, straight);
  EXPECT_THROW(path_json(a.view, {"nobody"}), std::invalid_argument);
}

TEST(PathView, HasTheNodesOnTheirLinearEquations) {
  const Asked a = joined();
  const json path = json::parse(path_json(a.view, names(a.view.system)));
  for (const json& node : path["nodes"])
    for (std::size_t i = 0; i < node["values"].size(); ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < node["x"].size(); ++j)
        sum += node["rows"][i][j].get<double>() * node["x"][j].get<double>();
      EXPECT_NEAR(sum, node["values"][i].get<double>(), 1e-9);
    }
}

TEST(PathWords, SayWhatIsProvenOfAPath) {
  const Asked a = joined();
  const PathWords words = path_words(a.mechanism, a.view);
  EXPECT_EQ(words.kicker, "A path without forward singularities");
  EXPECT_THAT(words.proven, Contains(HasSubstr("The path meets no forward singularity")));
  EXPECT_THAT(words.proven, Contains(HasSubstr("It keeps to the ranges of <i>J</i><sub>3x</sub>")));
  EXPECT_THAT(words.unproven, Not(Contains(HasSubstr("requested"))));
}

TEST(PathWords, SayThatARobotIsCuspidal) {
  Asked a = joined();
  a.view.cuspidal = true;
  const PathWords words = path_words(a.mechanism, a.view);
  EXPECT_EQ(words.kicker, "Cuspidal: a path without forward singularities");
  EXPECT_THAT(words.finding, HasSubstr("This robot is cuspidal: a path joins two poses for the same values of its motors"));
}

TEST(PathWords, SpeakOfBothKindsOfSingularityWhereBothAreAvoided) {
  const Asked a = asked("three_slider", {{"x_C", "0.3"}}, 4, {{"x_C", "0.5"}}, 4, {.avoid = analyze::Avoid::both});
  ASSERT_TRUE(a.view.path.tube);
  const PathWords words = path_words(a.mechanism, a.view);
  EXPECT_EQ(words.kicker, "A path without forward and inverse singularities");
  EXPECT_THAT(words.proven, Contains(HasSubstr("The path meets no forward or inverse singularity")));
  EXPECT_EQ(a.view.signs[0].size(), a.view.signs[1].size());
  EXPECT_THAT(signs_html(a.view), AllOf(HasSubstr("det <i>L<sub>y</sub></i>"), HasSubstr("det <i>L<sub>z</sub></i>")));
}

TEST(PathWords, NameTheRadiusThatWasNotReached) {
  Asked a = joined();
  a.view.radius_asked = 100;
  EXPECT_THAT(path_words(a.mechanism, a.view).unproven,
              Contains(HasSubstr("The path does not have the requested radius, 100")));
}

TEST(PathWords, NameTheLimitsOfJoints) {
  const Asked a = asked("dextar_limits", {{"J3x", "1/2"}, {"J3y", "1"}}, 1, {{"J3x", "0.5"}, {"J3y", "1.01"}}, 1);
  ASSERT_TRUE(a.view.path.tube);
  EXPECT_THAT(path_words(a.mechanism, a.view).proven, Contains(HasSubstr("<i>θ</i><sub>2</sub>")));
}

TEST(PathWords, ShowTheSignsThatSeparateTheEnds) {
  const Asked a = apart();
  ASSERT_EQ(a.view.path.status, analyze::Path::Status::separated);
  ASSERT_FALSE(a.view.signs[0].empty());
  EXPECT_EQ(a.view.signs[0][0].sign, -a.view.signs[1][0].sign);
  EXPECT_THAT(signs_html(a.view), HasSubstr("class=\"unlike\""));
  EXPECT_THAT(signs_html(joined().view), Not(HasSubstr("unlike")));
  EXPECT_EQ(path_words(a.mechanism, a.view).finding, "It is proven that there is no such path.");
  EXPECT_EQ(waypoints_html(a.view, a.mechanism), "");
}

TEST(PathWords, NameWhatSeparatesTheEndsWhereARequirementDoes) {
  const study::Question arm{.model = symbolic::parse_model("[SYSTEM VARS]\n  y :\n  q ~\n[SYSTEM EQS]\n  y = sin(q);\n"
                                                           "[INPUTS] q\n[OUTPUTS] y\n[REQUIREMENTS]\n  y <= 1/5;\n",
                                                           "arm")};
  solve::Control control;
  analyze::PathFinder finder(arm, {.avoid = analyze::Avoid::requirements});
  const Box low = finder.end({{"q", 0}}, 0, "from", control), high = finder.end({{"q", 1}}, 0, "to", control);
  const PathView view = path_view(finder, finder.find(low, high, control));
  ASSERT_EQ(view.path.status, analyze::Path::Status::separated);
  EXPECT_EQ(view.path.reason, "a function that is 0 only at limits of requirements has opposite signs at the ends");
  EXPECT_THAT(signs_html(view), AllOf(HasSubstr("0 where a requirement reaches its limit"),
                                      HasSubstr("a factor of det <i>R</i>"), Not(HasSubstr("<i>L"))));
  const std::string page = path_page(arm.model, view, {});
  EXPECT_TRUE(page.find("zero only at limits of requirements") != std::string::npos);
}

TEST(PathPage, IsOneFileThatSaysWhatItDoesNotDraw) {
  const Asked a = joined();
  const std::string page = path_page(a.mechanism, a.view, {}, {.command = "corank path x", .missing = {"C-space"}});
  EXPECT_TRUE(page.find("not drawn, for they take longer: C-space") != std::string::npos);
  EXPECT_TRUE(page.find("class=\"speed\"") != std::string::npos);
  EXPECT_TRUE(page.find("{{#") == std::string::npos);
  const std::string none = path_page(apart().mechanism, apart().view, {});
  EXPECT_TRUE(none.find("class=\"speed\"") == std::string::npos);
  EXPECT_TRUE(none.find("The mechanism at the end") != std::string::npos);
}

}  // namespace
}  // namespace corank::report
