// corank derive: three formats; the polynomial one solves to the same boxes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
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

TEST(Derive, PrintsTheSameInEveryRun) {
  const std::string file = testing::TempDir() + "turning_column.cuik";
  std::ofstream(file)
      << "[LINKS]\nbase : point O (0, 0, 0)\ncolumn : point O (0, 0, 0)  point S (1, 0, 2)\n"
         "upper : point S (0, 0, 0)  point E (0, 0, 3)\ncrank : point S (0, 0, 0)  point C (-1, 0, 0)\n"
         "fore : point E (0, 0, 0)  point D (-1, 0, 0)  point W (4, 0, 0)\n"
         "[JOINTS]\nrevolute j1 : base O + (0, 0, 1)  column O + (0, 0, 1)  actuated\n"
         "revolute j2 : column S + (0, 1, 0)  upper S + (0, 1, 0)  actuated\n"
         "revolute j3 : column S + (0, 1, 0)  crank S + (0, 1, 0)  actuated\n"
         "revolute elbow : upper E + (0, 1, 0)  fore E + (0, 1, 0)\nsph_sph rod : crank C  fore D  length 3\n"
         "[OUTPUTS]\nW : position of fore.W\n";
  std::set<std::string> texts;
  for (int k = 0; k < 8; ++k) texts.insert(run_corank({"derive", file}).out);
  EXPECT_EQ(texts.size(), 1u) << *texts.begin() << *texts.rbegin();
}

TEST(Derive, PrintsTheSystemOfACorank) {
  const Outcome outcome = run_corank({"derive", model("dextar"), "--set", "inverse", "--corank", "2"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* part : {"row 4 of L_z xi2 = 0", "xi1 orthogonal to xi2", "choice of xi2", "half-space of xi2"})
    EXPECT_THAT(outcome.out, HasSubstr(part));
}

TEST(Derive, PrintsOfLaterPartsOnlyWhatTheFirstHasNot) {
  const Outcome boundary = run_corank({"derive", model("planar/arm_2r_limits"), "--set", "boundary"});
  EXPECT_EQ(boundary.status, 0) << boundary.err;
  EXPECT_EQ(boundary.out.find("Φ(q) = 0"), boundary.out.rfind("Φ(q) = 0"));
  EXPECT_THAT(boundary.out, HasSubstr("\nSystem arm_2r_limits boundary: t2 at its upper limit\n  t2 ~ [3*pi/4, 3*pi/4]\n"
                                      "  of the first system: (1), (2)\n"));
  const Outcome parts = run_corank({"derive", model("3rrr"), "--set", "inverse", "--kernel", "none"});
  EXPECT_EQ(parts.status, 0) << parts.err;
  EXPECT_THAT(parts.out, HasSubstr("\nSystem 3rrr inverse: psi2 = theta2\n  of the first system: (1) to (6)\n"
                                   "  (8)  psi2 = theta2   % psi2 = theta2\n"));
  EXPECT_THAT(parts.out, HasSubstr("\nSystem 3rrr inverse: psi2 = theta2 + pi\n  without theta2, psi2\n"
                                   "  of the first system: (1), (2), (5), (6)\n  (8)  -2 + x + 0.5*cos(phi) = 0 "));
  const Outcome latex = run_corank({"derive", model("3rrr"), "--set", "inverse", "--kernel", "none", "--format", "latex"});
  EXPECT_THAT(latex.out, HasSubstr("% of the first system, counted from 1: (1) to (6)\n\\begin{align}\n"
                                   "  \\psi_{2} &= \\theta_{2}\n\\end{align}\n"));
  // Hundreds of parts, of the same equations.
  const Outcome stewart = run_corank({"derive", model("platforms/stewart"), "--set", "boundary"});
  EXPECT_LT(stewart.out.size(), 1'000'000u);
}

// No part of it is there where it was ended.
TEST(Derive, EndsAtATimeLimitWithoutOutput) {
  const TemporaryFolder folder;
  const std::string file = folder.file("d.json");
  const Outcome outcome =
      run_corank({"derive", model("platforms/stewart"), "--set", "boundary", "--json", file, "--time-limit", "1e-9"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "corank: stopped by the time limit while reading the model; the output is not complete\n");
  EXPECT_FALSE(std::filesystem::exists(file));
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
