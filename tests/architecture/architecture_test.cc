// The repository keeps to its own rules (CONTRIBUTING.md), and the rules notice when it does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "corank/tests/architecture/include_rules.h"

namespace corank::architecture {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::string> kFolders = [] {
  std::vector<std::string> all = folders();
  all.push_back("tests");
  return all;
}();

std::string read(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// Calls visit(path relative to the repository, text) for every file of the folders whose name ends with one of the ends.
template <typename Visit>
int for_each_file(const std::vector<std::string>& folders, const std::vector<std::string>& ends, const Visit& visit) {
  int files = 0;
  const fs::path root = CORANK_SOURCE_DIR;
  for (const std::string& folder : folders) {
    if (!fs::exists(root / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string name = entry.path().filename().string();
      const bool wanted = std::any_of(ends.begin(), ends.end(), [&](const std::string& end) { return name.ends_with(end); });
      if (!entry.is_regular_file() || !wanted) continue;
      visit(fs::relative(entry.path(), root).generic_string(), read(entry.path()));
      ++files;
    }
  }
  return files;
}

TEST(Architecture, FoldersIncludeOnlyWhatTheArrowsAllow) {
  const int files = for_each_file(
      kFolders, {".h", ".cc", "CMakeLists.txt"},
      [](const std::string& path, const std::string& text) { EXPECT_THAT(violations(path, text), IsEmpty()); });
  EXPECT_GT(files, 40);
}

TEST(Architecture, EveryFolderOfCodeIsInTheListOfFolders) {
  for (const fs::directory_entry& entry : fs::directory_iterator(CORANK_SOURCE_DIR)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || name.starts_with('.') || name.starts_with("build") || name == "third_party" ||
        name == "cmake")
      continue;
    if (std::find(kFolders.begin(), kFolders.end(), name) != kFolders.end()) continue;
    EXPECT_EQ(for_each_file({name}, {".h", ".cc"}, [](const std::string&, const std::string&) {}), 0) << name;
  }
}

// In characters, not bytes; a number of more digits than a line has cannot be broken.
TEST(Architecture, NoLineIsLongerThan125Columns) {
  constexpr std::size_t kColumns = 125;
  for_each_file(kFolders, {".h", ".cc"}, [](const std::string& path, const std::string& text) {
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      const auto columns = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
      std::istringstream words(line);
      std::size_t longest = 0;
      for (std::string word; words >> word;) longest = std::max(longest, word.size());
      if (static_cast<std::size_t>(columns) > kColumns && longest <= kColumns)
        ADD_FAILURE() << path << ":" << number << ": " << columns << " columns";
    }
  });
}

TEST(Architecture, EveryArrowIsUsed) {
  std::set<std::pair<std::string, std::string>> unused = arrows();
  std::set<std::string> users;
  for (const auto& [folder, used] : unused) users.insert(folder);
  for (const std::string& folder : users) {
    for_each_file({folder}, {".h", ".cc"}, [&](const std::string&, const std::string& text) {
      for (const std::string& used : included_folders(text)) unused.erase({folder, used});
    });
  }
  for (const auto& [folder, used] : unused) ADD_FAILURE() << folder << " includes nothing of " << used;
}

// Does the file include core/interval.h, by whatever way?
class IntervalUsers {
 public:
  bool reaches(const std::string& path) {
    const auto [at, is_new] = known_.try_emplace(path, path == "core/interval.h");
    if (!is_new || at->second) return at->second;
    std::istringstream lines(read(fs::path(CORANK_SOURCE_DIR) / path));
    bool found = false;
    constexpr std::string_view kBegin = "#include \"corank/";
    for (std::string line; std::getline(lines, line) && !found;)
      if (line.starts_with(kBegin)) found = reaches(line.substr(kBegin.size(), line.rfind('"') - kBegin.size()));
    return known_[path] = found;
  }

 private:
  std::map<std::string, bool> known_;
};

// What a command compiles, relative to the source tree: a source, or all that a unity build includes.
std::vector<std::string> compiled_sources(const fs::path& path) {
  const auto in_tree = [](const fs::path& source) { return fs::relative(source, CORANK_SOURCE_DIR).generic_string(); };
  if (!path.filename().string().starts_with("unity_")) return {in_tree(path)};
  std::vector<std::string> sources;
  std::istringstream lines(read(path));
  constexpr std::string_view kBegin = "#include \"";
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(kBegin)) sources.push_back(in_tree(line.substr(kBegin.size(), line.rfind('"') - kBegin.size())));
  return sources;
}

TEST(Architecture, InstalledHeadersShowNoOtherLibrary) {
  std::istringstream headers(CORANK_PUBLIC_HEADERS);
  int files = 0;
  for (std::string path; std::getline(headers, path, ':'); ++files) {
    ASSERT_TRUE(fs::exists(path)) << path;
    EXPECT_THAT(public_header_violations(path, read(path)), IsEmpty());
  }
  EXPECT_GT(files, 15);
}

TEST(Architecture, NothingAsksForFastMath) {
  std::vector<std::string> folders = kFolders;
  folders.insert(folders.end(), {"cmake", "scripts"});
  const auto check = [](const std::string& path, const std::string& text) {
    if (path.starts_with("tests/architecture/")) return;  // it names the flags
    EXPECT_THAT(unsafe_math(path, text), IsEmpty());
  };
  EXPECT_GT(for_each_file(folders, {".h", ".cc", ".txt", ".cmake", ".in", ".sh"}, check), 40);
  for (const char* name : {"CMakeLists.txt", "CMakePresets.json"}) {
    EXPECT_THAT(unsafe_math(name, read(fs::path(CORANK_SOURCE_DIR) / name)), IsEmpty());
  }
}

TEST(Architecture, WhateverInlinesIntervalsIsCompiledForDirectedRounding) {
  const nlohmann::json commands = nlohmann::json::parse(read(CORANK_COMPILE_COMMANDS));
  int checked = 0;
  IntervalUsers users;
  for (const nlohmann::json& entry : commands) {
    const std::string command = entry["command"];
    for (const std::string& file : compiled_sources(entry["file"].get<std::string>())) {
      EXPECT_THAT(unsafe_math(file, command), IsEmpty());
      if (!fs::exists(fs::path(CORANK_SOURCE_DIR) / file) || !users.reaches(file)) continue;
      EXPECT_THAT(command, HasSubstr(" -frounding-math ")) << file;
      EXPECT_THAT(command, HasSubstr(" -ffp-contract=off ")) << file;
      ++checked;
    }
  }
  EXPECT_GT(checked, 150);
}

// scripts/mutants.py replaces a text that is once in its file; this keeps the lists from rotting.
TEST(Architecture, EveryMutantChangesOneTextOfATrustedFile) {
  const fs::path root = CORANK_SOURCE_DIR;
  std::set<std::string> seen;
  int mutants = 0;
  for_each_file({"tests/mutants"}, {".json"}, [&](const std::string& list, const std::string& text) {
    for (const nlohmann::json& mutant : nlohmann::json::parse(text)) {
      const std::string file = mutant.at("file"), before = mutant.at("old"),
                        name = list + ": " + file + ", " + mutant.at("of").get<std::string>();
      ++mutants;
      EXPECT_TRUE(seen.insert(name).second) << name << ": twice";
      EXPECT_NE(before, mutant.at("new").get<std::string>()) << name;
      EXPECT_FALSE(mutant.at("tests").empty()) << name;
      const std::string folder = file.substr(0, file.find('/'));
      EXPECT_THAT((std::vector<std::string>{"core", "certify", "check"}), testing::Contains(folder)) << name;
      const std::string source = read(root / file);
      const std::size_t first = source.find(before);
      ASSERT_NE(first, std::string::npos) << name << ": its text is not in the file";
      EXPECT_EQ(source.find(before, first + 1), std::string::npos) << name << ": its text is in the file twice";
    }
  });
  EXPECT_GT(mutants, 100);
}

// --- the rules themselves ---

TEST(IncludeRules, NoticeAnArrowThatIsNotThere) {
  EXPECT_THAT(violations("solve/step/a.cc", "\n#include \"corank/symbolic/model/mechanism.h\"\n"),
              ElementsAre("solve/step/a.cc:2: solve may not include symbolic"));
  EXPECT_THAT(violations("certify/a.h", "#include <vector>\n  #  include \"corank/solve/search/solve.h\"\n"),
              ElementsAre("certify/a.h:2: certify may not include solve"));
  EXPECT_THAT(violations("report/html/a.h", "#include \"corank/app/progress.h\"\n"),
              ElementsAre(HasSubstr("report may not include app")));
  EXPECT_THAT(
      violations("report/html/a.h", "#include \"corank/result/values/result.h\"\n#include \"corank/core/cover.h\"\n"),
      IsEmpty());
  EXPECT_THAT(violations("tests/solve/a.cc", "#include \"corank/symbolic/model/mechanism.h\"\n"), IsEmpty());
}

TEST(IncludeRules, NoticeAnArrowBetweenInnerFoldersThatIsNotThere) {
  const auto include = [](const std::string& header) { return "#include \"corank/" + header + "\"\n"; };
  EXPECT_THAT(violations("solve/step/a.h", include("solve/search/solve.h")),
              ElementsAre("solve/step/a.h:1: solve/step may not include solve/search"));
  EXPECT_THAT(violations("solve/search/a.h", include("solve/step/options.h") + include("solve/search/solve.h")), IsEmpty());
  EXPECT_THAT(violations("analyze/paths/a.h", include("solve/search/solve.h")), IsEmpty());
  EXPECT_THAT(violations("solve/a.h", ""), ElementsAre("solve/a.h:1: not in an inner folder of cmake/folders.txt"));
}

TEST(IncludeRules, NoticeACheckerThatLearnsFromWhatItChecks) {
  for (const char* header :
       {"certify/newton.h", "certify/slope_matrix.h", "certify/compiled_system.h", "certify/algebraic_number.h"}) {
    const std::string include = std::string("#include \"corank/") + header + "\"\n";
    EXPECT_THAT(violations("check/a.cc", include), ElementsAre(HasSubstr("check may not include certify"))) << header;
    EXPECT_THAT(violations("certify/a.cc", include), IsEmpty());
  }
  for (const char* header : {"core/rounding.h", "core/box_tree.h"}) {
    EXPECT_THAT(violations("check/a.cc", std::string("#include \"corank/") + header + "\"\n"),
                ElementsAre(HasSubstr("plain values only")));
  }
  EXPECT_THAT(
      violations("check/a.cc", "#include <mpfi.h>\n#include \"corank/core/cover.h\"\n#include \"corank/check/rows.h\"\n"),
      IsEmpty());
  EXPECT_THAT(violations("check/a.cc", "#include \"corank/solve/search/solve.h\"\n"),
              ElementsAre(HasSubstr("check may not include solve")));
  EXPECT_THAT(violations("certify/a.cc", "#include \"corank/check/checker.h\"\n"),
              ElementsAre(HasSubstr("certify may not include check")));
  EXPECT_EQ(violations("solve/CMakeLists.txt", "corank_library(solve PUBLIC_LINK corank::check)\n").size(), 1u);
}

TEST(IncludeRules, NoticeALibraryOutOfItsFolder) {
  for (const char* header : {"ginac/ginac.h", "cln/cln.h", "mpfr.h", "mpfi.h", "gmp.h", "boost/multiprecision/mpfi.hpp",
                             "hdf5.h", "CLI/CLI.hpp", "tao/pegtl.hpp", "pybind11/pybind11.h"}) {
    EXPECT_EQ(violations("solve/step/a.cc", std::string("#include <") + header + ">\n").size(), 1u) << header;
  }
  EXPECT_THAT(violations("symbolic/model/a.cc", "#include <ginac/ginac.h>\n#include <tao/pegtl.hpp>\n"), IsEmpty());
  EXPECT_THAT(violations("certify/a.cc", "#include <mpfr.h>\n"), IsEmpty());
  EXPECT_THAT(violations("tests/solve/a.cc", "#include <mpfi.h>\n"), IsEmpty()) << "an oracle";
  EXPECT_EQ(violations("tests/solve/a.cc", "#include <ginac/ginac.h>\n").size(), 1u);
}

TEST(IncludeRules, NoticeALinkThatNoArrowAllows) {
  EXPECT_THAT(violations("certify/CMakeLists.txt", "corank_library(certify PUBLIC_LINK corank::solve)\n"),
              ElementsAre("certify/CMakeLists.txt:1: certify may not link corank::solve"));
  EXPECT_THAT(violations("solve/CMakeLists.txt", "corank_library(solve PUBLIC_LINK corank::certify)\n"), IsEmpty());
}

TEST(IncludeRules, NoticeAnIncludeByAnotherName) {
  EXPECT_THAT(violations("solve/step/a.cc", "#include \"solve.h\"\n"), ElementsAre(HasSubstr("included as")));
}

TEST(IncludeRules, NoticeALibraryInAnInstalledHeader) {
  for (const char* header : {"CGAL/Interval_nt.h", "Eigen/Dense", "nlohmann/json.hpp", "mpfr.h", "hdf5.h", "fmt/format.h"}) {
    EXPECT_EQ(public_header_violations("a.h", std::string("#include <") + header + ">\n").size(), 1u) << header;
  }
  EXPECT_THAT(public_header_violations(
                  "a.h", "#include <vector>\n#include <emmintrin.h>\n#include \"corank/solve/search/solve.h\"\n"),
              IsEmpty());
}

TEST(IncludeRules, NoticeFastMath) {
  EXPECT_EQ(unsafe_math("CMakeLists.txt", "target_compile_options(x PRIVATE -O2 -ffast-math)\n").size(), 1u);
  EXPECT_EQ(unsafe_math("CMakeLists.txt", "# nothing\nset(CMAKE_CXX_FLAGS \"-Ofast\")\n").size(), 1u);
  EXPECT_THAT(unsafe_math("CMakeLists.txt", "target_compile_options(x PRIVATE -O2 -frounding-math)\n"), IsEmpty());
}

}  // namespace
}  // namespace corank::architecture
