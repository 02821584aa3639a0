// Every robot at hand with all its lengths multiplied by 1/1000, 1000 and 1,000,000: the same boxes, the same verdicts.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>

#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {
using symbolic::SingularitySet;

// The model with each length x replaced by x/k wherever it stands in an equation, and its range multiplied by k.
std::string scaled(const std::string& model, const std::string& k) {
  static const std::regex range(R"(^\s*(\w+)\s*:\s*\[([^,\]]+),([^\]]+)\](.*)$)");
  std::istringstream lines(model);
  std::string result, section;
  std::vector<std::string> lengths;
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find('%'));
    std::smatch parts;
    if (!line.empty() && line.front() == '[') section = line;
    const bool is_header = !line.empty() && line.front() == '[' && line.find("VARS") == std::string::npos;
    if (section.find("DRAWING") != std::string::npos) continue;
    if (section.find("VARS") != std::string::npos && std::regex_match(line, parts, range)) {
      lengths.push_back(parts[1]);
      line = parts[1].str() + " : [(" + parts[2].str() + ")*" + k + ", (" + parts[3].str() + ")*" + k + "]" + parts[4].str();
    } else if (section.find("EQS") != std::string::npos && !is_header) {
      for (const std::string& name : lengths)
        line = std::regex_replace(line, std::regex("\\b" + name + "\\b"), "(" + name + "/" + k + ")");
    }
    result += line + '\n';
  }
  return result;
}

Cover cover_of(const std::string& text, SingularitySet set) {
  const auto model = symbolic::parse_model(text, "scaled.cuik");
  solve::Options options;
  options.threads = 1;
  options.max_boxes = 100000;
  return solve::solve(
      symbolic::algebrize(symbolic::singularity_system(model, set, std::nullopt, symbolic::kernel_scales(model, set))),
      options);
}

// Counts that touch rounding: of boxes next to a degenerate point there may be a few more or less.
void expect_same(const Cover& cover, const Cover& base) {
  EXPECT_TRUE(cover.complete());
  for (const Verdict v : {Verdict::regular, Verdict::isolated, Verdict::exact, Verdict::boundary, Verdict::partial}) {
    const double count = static_cast<double>(base.count(v));
    EXPECT_NEAR(static_cast<double>(cover.count(v)), count, 0.02 * count) << to_string(v);
  }
  EXPECT_NEAR(static_cast<double>(cover.count(Verdict::undecided)), static_cast<double>(base.count(Verdict::undecided)), 4);
  for (const CoverBox& box : cover.boxes)
    if (box.verdict == Verdict::undecided) {
      EXPECT_NE(box.reason, Reason::none);
      EXPECT_NE(box.reason, Reason::limit);
    }
}

class LengthsTimes : public ::testing::TestWithParam<std::string> {};

TEST_P(LengthsTimes, AnyFactorGiveTheSameCounts) {
  const std::filesystem::path own = CORANK_SOURCE_DIR "/models/" + GetParam() + ".cuik";
  const std::filesystem::path users = CORANK_SOURCE_DIR "/../shared/models/" + GetParam() + ".cuik";
  const std::filesystem::path file = std::filesystem::exists(own) ? own : users;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const std::string text = symbolic::read_model(file).source_text();
  for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse, SingularitySet::cspace}) {
    const Cover base = cover_of(text, set);
    for (const char* k : {"(1/1000)", "1000000", "1000"}) {
      if (std::string(k) == "1000" && !test::long_run()) continue;
      SCOPED_TRACE(std::string(k) + ", set " + std::to_string(static_cast<int>(set)));
      expect_same(cover_of(scaled(text, k), set), base);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, LengthsTimes,
                         ::testing::Values("three_slider", "dextar", "spherical_five_bar", "fiveR_narrow", "rhombus",
                                           "rpr3_innocenti_slice", "rpr3u_m", "rpr3u_mm", "rssr", "spherical5_3out",
                                           "stephenson3", "watt"),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace corank
