// What a page of the studio is told: first the model, then coarse pictures, then finer ones; nothing after it was stopped.
#include "corank/studio/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "corank/studio/template_models.h"

namespace corank::studio {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string model_text(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(std::filesystem::path(CORANK_SOURCE_DIR) / "models" / name).rdbuf();
  return text.str();
}

Request request(const std::string& text, std::vector<std::string> sets) {
  return {.number = 7, .model = {text, "robot.cuik"}, .constants = {}, .sets = std::move(sets), .command = {}};
}

std::vector<json> events(const Request& asked, const std::string& stop_after = "", const SessionLimits& limits = {}) {
  std::vector<json> all;
  std::atomic<bool> stop = false;
  const Emit emit = [&](const std::string& line) {
    EXPECT_EQ(line.find('\n'), std::string::npos);
    all.push_back(json::parse(line));
    EXPECT_EQ(all.back().at("number"), 7);
    if (all.back().at("event") == stop_after) stop = true;
  };
  answer(asked, emit, stop, limits);
  return all;
}

std::vector<std::string> kinds(const std::vector<json>& events) {
  std::vector<std::string> kinds;
  for (const json& event : events)
    if (event.at("event") != "progress" && (kinds.empty() || kinds.back() != event.at("event")))
      kinds.push_back(event.at("event"));
  return kinds;
}

// Of each set the counts of boxes in its pictures, one after the other.
std::map<std::string, std::vector<std::size_t>> counts(const std::vector<json>& events) {
  std::map<std::string, std::vector<std::size_t>> counts;
  for (const json& event : events)
    if (event.at("event") == "picture")
      for (const json& set : event.at("model").at("sets")) counts[set.at("name")].push_back(set.at("count"));
  return counts;
}

TEST(Session, SaysTheModelThenCoarsePicturesThenFinerOnes) {
  const std::vector<json> all = events(request(model_text("dextar.cuik"), {"cspace", "forward"}));
  EXPECT_THAT(kinds(all), ElementsAre("begun", "model", "picture", "done"));
  EXPECT_TRUE(all.back().at("complete"));
  for (const auto& [set, boxes] : counts(all)) {
    ASSERT_EQ(boxes.size(), 2u) << set;
    EXPECT_LT(2 * boxes[0], boxes[1]) << set;
  }
}

TEST(Session, StaysWithCoarseBoxesWhereNoFinerOnesAreAskedFor) {
  Request asked = request(model_text("dextar.cuik"), {"forward"});
  asked.fine = false;
  const std::vector<json> all = events(asked);
  EXPECT_EQ(counts(all).at("forward").size(), 1u);
  EXPECT_TRUE(all.back().at("complete"));
}

TEST(Session, SaysTheConstantsWithTheirValuesAndTolerances) {
  Request asked = request(model_text("dextar.cuik"), {"forward"});
  asked.constants = {{"l2", "1.2"}, {"d", "1.18±0.01"}};
  const json model = events(asked, "model").back();
  std::map<std::string, json> constants;
  for (const json& c : model.at("constants")) constants[c.at("name")] = c;
  EXPECT_DOUBLE_EQ(constants.at("l2").at("value"), 1.2);
  EXPECT_DOUBLE_EQ(constants.at("l3").at("value"), 0.9);
  EXPECT_FALSE(constants.at("l3").contains("tolerance"));
  EXPECT_NEAR(constants.at("d").at("tolerance").at(0), 1.17, 1e-12);
}

TEST(Session, FindsTheSetsOfTheRobotWithTheseConstants) {
  // The arm J1 J2 J3 cannot stretch to the other one's end: the locus of the first robot is not that of the second.
  Request asked = request(model_text("dextar.cuik"), {"forward"});
  const auto usual = counts(events(asked));
  asked.constants = {{"l4", "0.1"}, {"l5", "0.1"}, {"l2", "0.1"}, {"l3", "0.1"}};
  EXPECT_GT(usual.at("forward").front(), 0u);
  EXPECT_EQ(counts(events(asked)).at("forward").front(), 0u);
}

TEST(Session, NamesTheLineOfAnError) {
  std::string text = model_text("dextar.cuik");
  text.replace(text.find("l3*cos(theta3)"), 2, "lx");
  const std::vector<json> all = events(request(text, {"forward"}));
  EXPECT_THAT(kinds(all), ElementsAre("begun", "error"));
  EXPECT_EQ(all.back().at("line"), 1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find("lx*")), '\n'));
  EXPECT_THAT(all.back().at("message").get<std::string>(), HasSubstr("lx"));
  EXPECT_THAT(all.back().at("message").get<std::string>(), testing::Not(HasSubstr("robot.cuik")));
}

TEST(Session, SaysThatAConstantIsWrongWithoutALine) {
  Request asked = request(model_text("dextar.cuik"), {"forward"});
  asked.constants = {{"l2", "1 +"}};
  const json error = events(asked).back();
  EXPECT_EQ(error.at("event"), "error");
  EXPECT_EQ(error.at("line"), 0);
  EXPECT_THAT(error.at("message").get<std::string>(), HasSubstr("-D l2"));
}

TEST(Session, RefusesAPlainSystem) {
  const json error = events(request("[SYSTEM VARS]\nx : [0, 1]\n[SYSTEM EQS]\nx^2 = 1/2;\n", {"cspace"})).back();
  EXPECT_EQ(error.at("event"), "error");
  EXPECT_THAT(error.at("message").get<std::string>(), HasSubstr("inputs and outputs"));
}

TEST(Session, GoesOnWithoutASetThatIsNoneOfTheModel) {
  const std::vector<json> all = events(request(model_text("dextar.cuik"), {"requirements", "forward"}));
  EXPECT_THAT(kinds(all), ElementsAre("begun", "model", "refused", "picture", "done"));
}

TEST(Session, SaysNothingMoreOnceItIsStopped) {
  for (const std::string after : {"begun", "model", "picture"}) {
    const std::vector<json> all = events(request(model_text("dextar.cuik"), {"cspace", "forward", "inverse"}), after);
    EXPECT_EQ(all.back().at("event"), after);
  }
}

TEST(Session, KeepsItsLimitOfBoxesAndSaysSo) {
  const std::vector<json> all = events(request(model_text("dextar.cuik"), {"cspace"}), "", {.boxes = 3000, .threads = 1});
  EXPECT_EQ(all.back().at("event"), "done");
  EXPECT_FALSE(all.back().at("complete"));
  EXPECT_LT(counts(all).at("cspace").back(), 9000u);
}

TEST(Session, MakesTheReport) {
  Request asked = request(model_text("three_slider.cuik"), {"cspace", "forward"});
  asked.want = Request::Want::report;
  asked.command = "corank report three_slider.cuik";
  const std::vector<json> all = events(asked);
  EXPECT_THAT(kinds(all), ElementsAre("begun", "model", "report", "done"));
  const std::string html = all[all.size() - 2].at("html");
  EXPECT_THAT(html, HasSubstr("corank report three_slider.cuik"));
  EXPECT_THAT(html, HasSubstr("id=\"boxes-forward\""));
}

TEST(Session, ColoursAspectsWhereTheyAreAskedFor) {
  Request asked = request(model_text("planar/four_bar_crank_rocker.cuik"), {"cspace", "inverse"});
  asked.colours = Request::Colours::aspects;
  const std::vector<json> all = events(asked);
  EXPECT_THAT(kinds(all), ElementsAre("begun", "model", "picture", "colours", "done"));
  EXPECT_EQ(all[all.size() - 2].at("colours").at("labels").size(), 4u);  // each of the two curves is cut at two points
}

TEST(Session, ShadesWhereRequirementsAreMet) {
  Request asked = request(model_text("dextar.cuik"), {"cspace"});
  asked.fine = false;
  asked.require = {"J3y >= 0"};
  asked.colours = Request::Colours::requirements;
  const std::vector<json> all = events(asked);
  ASSERT_THAT(kinds(all), ElementsAre("begun", "model", "picture", "colours", "done"));
  const json colours = all[all.size() - 2].at("colours");
  EXPECT_THAT(colours.at("labels"), ElementsAre("met", "not met", "open"));
  // Two bytes for each box, in base64.
  const std::size_t boxes = counts(all).at("cspace").back();
  EXPECT_EQ(colours.at("of").get<std::string>().size(), (2 * boxes + 2) / 3 * 4);
  asked.require = {"J3y >="};
  EXPECT_EQ(events(asked).back().at("event"), "error");
  asked.require.clear();
  const std::vector<json> without = events(asked);  // of how many pictures depends on the clock
  EXPECT_TRUE(without[without.size() - 2].at("colours").is_null());
}

TEST(Session, ReadsEveryTemplate) {
  EXPECT_GT(template_models().size(), 8u);
  for (const TemplateModel& model : template_models()) {
    const std::vector<json> all = events(request(std::string(model.text), {"forward"}), "model");
    EXPECT_EQ(all.back().at("event"), "model") << model.name << all.back();
  }
}

TEST(Session, NamesNoOtherFile) {
  const json error = events(request("[INCLUDE]\n../../../etc/passwd\n", {"forward"})).back();
  EXPECT_EQ(error.at("event"), "error");
}

TEST(Request, IsReadFromJson) {
  const Request read = parse_request(
      R"({"number": 3, "want": "picture", "file": "a.cuik", "text": "x", "constants": {"l": "1"}, "sets": ["forward"]})");
  EXPECT_EQ(read.number, 3u);
  EXPECT_EQ(read.model.text, "x");
  EXPECT_FALSE(read.model.folder.has_value());
  EXPECT_THAT(read.constants, ElementsAre(result::ConstantOverride{"l", "1"}));
  EXPECT_THAT(read.sets, ElementsAre("forward"));
}

TEST(Request, IsRefusedWhereItMakesNoSense) {
  const std::string good = R"({"number":3,"want":"picture","file":"a.cuik","text":"x","constants":{},"sets":["forward"]})";
  EXPECT_NO_THROW(parse_request(good));
  const auto with = [&](const std::string& before, const std::string& after) {
    std::string text = good;
    const std::size_t at = text.find(before);
    EXPECT_NE(at, std::string::npos) << before;
    return text.replace(at, before.size(), after);
  };
  for (const std::string& bad :
       {std::string(), std::string("[]"), std::string("{"), good.substr(0, good.size() - 1), with("3", "-3"),
        with("3", "3.5"), with("\"picture\"", "\"all\""), with("\"picture\"", "1"), with("\"text\":\"x\",", ""),
        with("{}", "[]"), with("{}", "{\"l\":1}"), with("{}", "{\"l\":\"" + std::string(300, '1') + "\"}"),
        with("[\"forward\"]", "\"forward\""), with("[\"forward\"]", "[\"nothing\"]"), with("[\"forward\"]", "[1]"),
        with("\"x\"", "\"" + std::string((1 << 20) + 1, 'x') + "\""), with("\"x\"", "\"\\u0000\""),
        with("\"sets\"", "\"fine\":1,\"sets\"")})
    EXPECT_THROW(parse_request(bad), RequestError) << bad.substr(0, 200);
}

}  // namespace
}  // namespace corank::studio
