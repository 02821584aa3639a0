// A disk that is full, at any moment, as a limit of file size has it: every command that writes says so, and what is left is
// either whole or not there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

#include "corank/tests/app/program.h"
#include "corank/tests/seeds.h"

namespace corank::app {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

// Files below the folder, with their sizes.
std::map<std::string, std::uintmax_t> files_in(const TemporaryFolder& folder) {
  std::map<std::string, std::uintmax_t> result;
  for (const auto& entry : fs::recursive_directory_iterator(folder.file("")))
    if (entry.is_regular_file()) result[fs::relative(entry.path(), folder.file("")).string()] = entry.file_size();
  return result;
}

// `words`: with @ where the folder's path is to stand.
Words placed(Words words, const TemporaryFolder& folder) {
  for (std::string& word : words)
    if (word.starts_with("@")) word = folder.file(word.substr(1));
  return words;
}

// Just below and far below the size of the largest file of each kind that the command writes, in a long run of each file,
// and where its first bytes go. What a result is read into is a file of the kind that has no name, to which the limit
// applies, too.
std::set<std::size_t> sizes_to_try(const std::map<std::string, std::uintmax_t>& whole) {
  std::map<std::string, std::uintmax_t> largest;
  for (const auto& [name, size] : whole) {
    std::uintmax_t& known = largest[test::long_run() ? name : fs::path(name).extension().string()];
    known = std::max(known, size);
  }
  std::set<std::size_t> sizes{600, 4096};
  for (const auto& [kind, size] : largest)
    for (const std::uintmax_t part : {size - 1, size / 2})
      if (part > 600) sizes.insert(part);
  return sizes;
}

class FullDisk : public testing::TestWithParam<Words> {};

TEST_P(FullDisk, IsSaidAndLeavesNoBrokenFile) {
  const TemporaryFolder inputs;
  const std::string result = inputs.file("r.h5"), boxes = inputs.file("r.sol");
  const Words solve{"solve", model("three_slider"), "--set", "cspace", "--sigma", "0.3", "-o"};
  const auto solved = [&](const std::string& file, const Words& more) {
    Words words = solve;
    words.push_back(file);
    words.insert(words.end(), more.begin(), more.end());
    return run_corank(words).status;
  };
  const auto is_asked_for = [](const char* word) { return std::ranges::count(GetParam(), word) > 0; };
  if (is_asked_for("RESULT")) {
    ASSERT_EQ(solved(result, {}), 0);
  }
  if (is_asked_for("BOXES")) {
    ASSERT_EQ(solved(boxes, {}), 0);
  }
  const auto command = [&](const TemporaryFolder& folder) {
    Words words = placed(GetParam(), folder);
    for (std::string& word : words)
      if (word == "RESULT" || word == "BOXES") word = word == "RESULT" ? result : boxes;
    return words;
  };
  const TemporaryFolder all;
  const Outcome normal = run_corank(command(all));
  ASSERT_THAT(normal.status, AnyOf(0, 3)) << normal.err;
  const std::map<std::string, std::uintmax_t> whole = files_in(all);
  ASSERT_FALSE(whole.empty());
  int refused = 0;
  for (const std::size_t size : sizes_to_try(whole)) {
    SCOPED_TRACE(size);
    const TemporaryFolder folder;
    const Outcome outcome = run_corank(command(folder), {.file_bytes = size});
    if (outcome.status == normal.status) continue;
    ++refused;
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_THAT(outcome.err, AnyOf(HasSubstr("cannot"), HasSubstr("no memory for its contents")));
    EXPECT_THAT(outcome.err, Not(HasSubstr("bug in corank")));
    for (const auto& [name, bytes] : files_in(folder)) {
      EXPECT_THAT(name, Not(HasSubstr(".part")));
      EXPECT_TRUE(whole.contains(name)) << name;
      if (name.ends_with(".h5")) {
        EXPECT_THAT(run_corank({"verify", folder.file(name)}).status, AnyOf(0, 4)) << name;
      } else if (name.ends_with(".svg") && bytes > 0) {
        EXPECT_THAT(read_text(folder.file(name)), HasSubstr("</svg>")) << name;
      }
    }
  }
  EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Of, FullDisk,
    testing::Values(
        Words{"solve", model("three_slider"), "--set", "cspace", "--sigma", "0.3", "-o", "@r.h5"},
        Words{"solve", model("three_slider"), "--set", "cspace", "--sigma", "0.3", "--proof", "-o", "@r.h5"},
        Words{"solve", model("three_slider"), "--set", "cspace", "--sigma", "0.3", "-o", "@r.sol"},
        Words{"solve", model("three_slider"), "--set", "cspace", "--sigma", "0.3", "--json", "@r.json"},
        Words{"solve", model("dextar"), "--set", "cspace", "--max-boxes", "300", "--checkpoint", "@c.kept"},
        Words{"solve", "--refine", "RESULT", "--sigma", "0.1", "-o", "@fine.h5"},
        Words{"derive", model("dextar"), "-o", "@d.txt"},
        Words{"derive", model("dextar"), "--format", "cuik", "-o", "@d.cuik"},
        Words{"report", model("three_slider"), "-o", "@page"}, Words{"report", "--results", "RESULT", "-o", "@page"},
        Words{"sweep", model("three_slider"), "-D", "L2=0.5:1:2", "-o", "@family"},
        Words{"clearance", model("dextar"), "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y", "--proof", "@c"},
        Words{"clearance", model("dextar"), "--map", "J3x=[0.4,0.6],J3y=[0.9,1]", "--grid", "2", "-o", "@m.svg"},
        Words{"clearance", model("dextar"), "--map", "J3x=[0.4,0.6],J3y=[0.9,1]", "--grid", "3", "-o", "@m.csv"},
        Words{"topology", model("three_slider"), "-o", "@t.h5"}, Words{"aspects", model("three_slider"), "-o", "@a.h5"},
        Words{"aspects", model("planar/arm_2r_limits"), "-o", "@a.svg"},
        Words{"path", model("dextar"), "--from", "J3x=0.5,J3y=1", "--from-mode", "1", "--to", "J3x=0.51,J3y=1", "--to-mode",
              "1", "-o", "@p.h5", "--csv", "@p.csv", "--report", "@p.html"},
        Words{"map", model("dextar"), "--over", "J3x=0:1", "--over", "J3y=0.5:1", "--resolution", "16", "-o", "@m.h5", "-o",
              "@m.svg", "-o", "@m.csv", "-o", "@m.json"},
        Words{"plot", "BOXES", "--axes", "1,2", "-o", "@p.svg"}, Words{"plot", "BOXES", "--axes", "1,2", "-o", "@p.pdf"},
        Words{"plot", "BOXES", "--axes", "1,2", "-o", "@p.png"}, Words{"plot", "BOXES", "--axes", "1,2,3", "-o", "@p.vtp"},
        Words{"plot", "BOXES", "--axes", "1,2,3", "-o", "@p.gcl"}, Words{"angles", "BOXES", "1", "2", "@a.sol"}),
    [](const testing::TestParamInfo<Words>& of) {
      std::string name = of.param[0] + "_" + std::to_string(of.index);
      std::string kind = of.param.back();
      for (const char c : kind.substr(kind.find('@') == std::string::npos ? 0 : 1)) name += std::isalnum(c) != 0 ? c : '_';
      return name;
    });

}  // namespace
}  // namespace corank::app
