// corank derive: three formats; the polynomial one solves to the same boxes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST(Derive, PrintsConstraintsBlocksAndSystemAsText) {
  const Outcome outcome = run_corank({"derive", model("dextar"), "--set", "inverse"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* part : {"L_y", "L_z", "cos(theta2)", "xi1"}) EXPECT_THAT(outcome.out, HasSubstr(part));
}

TEST(Derive, PrintsTheSystemOfACorank) {
  const Outcome outcome = run_corank({"derive", model("dextar"), "--set", "inverse", "--corank", "2"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* part : {"row 4 of L_z xi2 = 0", "xi1 orthogonal to xi2", "choice of xi2", "half-space of xi2"})
    EXPECT_THAT(outcome.out, HasSubstr(part));
}

TEST(Derive, PrintsLatex) {
  const Outcome outcome = run_corank({"derive", model("dextar"), "--set", "forward", "--format", "latex"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\\theta_{2}"));
}

TEST(Derive, ShowsCspaceWhereNoSetIsNamed) {
  const Outcome without = run_corank({"derive", model("three_slider"), "--format", "cuik"});
  const Outcome with = run_corank({"derive", model("three_slider"), "--format", "cuik", "--set", "cspace"});
  EXPECT_EQ(without.status, 0) << without.err;
  EXPECT_EQ(without.out, with.out);
}

TEST(Derive, PutsOverriddenConstantsIn) {
  const Outcome l1 = run_corank({"derive", model("three_slider"), "--format", "cuik", "-D", "L2=1"});
  const Outcome l2 = run_corank({"derive", model("three_slider"), "--format", "cuik"});
  EXPECT_EQ(l1.status, 0) << l1.err;
  EXPECT_NE(l1.out, l2.out);
}

// Terms are shorter than a line; what is longer is a comment behind one.
TEST(Derive, BreaksLongLinesAndReadsThemBack) {
  const TemporaryFolder folder;
  const auto longest = [](const std::string& text) {
    std::istringstream lines(text);
    std::size_t width = 0;
    for (std::string line; std::getline(lines, line);) width = std::max(width, line.substr(0, line.find('%')).size());
    return width;
  };
  for (const char* name : {"platforms/delta", "platforms/3upu"}) {
    std::map<std::string, std::string> texts;
    for (const std::string format : {"text", "latex", "cuik", "model"}) {
      texts[format] = run_corank({"derive", model(name), "--format", format}).out;
      EXPECT_LE(longest(texts[format]), 104u) << name << ", " << format;
    }
    for (const std::string format : {"cuik", "model"}) {
      const std::string again =
          run_corank({"derive", folder.write("again.cuik", texts[format]), "--format", "cuik", "--set", "cspace"}).out;
      const std::string plain = run_corank({"derive", folder.write("again.cuik", texts[format]), "--format", "cuik"}).out;
      const auto formulas = [](const std::string& text) {
        std::istringstream lines(text);
        std::string all;
        for (std::string line; std::getline(lines, line);) all += line.substr(0, line.find('%'));
        std::erase_if(all, [](char c) { return c == ' '; });
        return all;
      };
      EXPECT_EQ(formulas(format == "cuik" ? plain : again), formulas(texts["cuik"])) << name << ", " << format;
    }
  }
}

TEST(Derive, WritesAPolynomialFileThatSolvesToTheSameResult) {
  const TemporaryFolder folder;
  for (const std::string set : {"forward", "inverse"}) {
    const Outcome derived = run_corank({"derive", model("three_slider"), "--set", set, "--format", "cuik"});
    ASSERT_EQ(derived.status, 0) << derived.err;
    const Outcome first = run_corank({"solve", model("three_slider"), "--set", set, "--json"});
    const Outcome second = run_corank({"solve", folder.write("system.cuik", derived.out), "--json"});
    ASSERT_EQ(first.status, 0) << first.err;
    ASSERT_EQ(second.status, 0) << second.err;
    const json a = json::parse(first.out), b = json::parse(second.out);
    EXPECT_EQ(a["system"], b["system"]);
    EXPECT_EQ(a["boxes"], b["boxes"]);
    json points = a["points"];
    for (json& point : points) {  // a plain system knows no types
      point.erase("types");
      point.erase("typed");
    }
    EXPECT_EQ(points, b["points"]);
    EXPECT_EQ(b["set"], "system");
  }
}

}  // namespace
}  // namespace corank::app
