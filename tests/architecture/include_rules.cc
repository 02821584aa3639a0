#include "corank/tests/architecture/include_rules.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace corank::architecture {
namespace {

using Arrows = std::map<std::string, std::set<std::string>>;

Arrows read_arrows() {
  std::ifstream list(CORANK_SOURCE_DIR "/cmake/folders.txt");
  Arrows arrows;
  static const std::regex entry("^(([a-z]+/)?[a-z]+):([^#]*)(# .+)?$");
  for (std::string line; std::getline(list, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, entry)) continue;
    if (match[2].matched != match[4].matched)
      throw std::runtime_error("cmake/folders.txt: an inner folder has a sentence, another one has none: " + line);
    std::istringstream names(match[3].str());
    std::set<std::string>& used = arrows[match[1]];
    for (std::string name; names >> name;) {
      name = match[2].str() + name;
      // Those above it only: no cycle.
      if (!arrows.contains(name))
        throw std::runtime_error("cmake/folders.txt: " + match[1].str() + " names " + name + " before it stands there");
      used.insert(name);
    }
  }
  return arrows;
}

// A folder may include itself and these. An inner folder, "solve/step", stands with the inner ones beside it.
const Arrows& arrows_of_house() {
  static const Arrows arrows = read_arrows();
  return arrows;
}

// Of core/, what the checker does in its own way.
const std::set<std::string> kNotForTheChecker{"core/rounding.h", "core/box_tree.h"};
constexpr const char* kChecker = "check";

// Headers of a library, by the beginning of their names, and the only folders that may include them. A folder's tests may do
// what the folder may.
struct LibraryRule {
  std::regex header;
  std::set<std::string> folders;
  bool in_any_test;
};
const std::vector<LibraryRule>& library_rules() {
  static const std::vector<LibraryRule> rules{
      {std::regex("^(ginac|cln)/"), {"symbolic", "kinematics"}, false},
      {std::regex("^(mpfr|mpfi|gmp|mpf2mpfr|mpfi_io)(xx)?\\.h|^boost/multiprecision/"
                  "(mpfr|mpfi|gmp|eigen)|^(arb|acb|arf|mag|arblib)"),
       {"core", "certify", kChecker},
       true},
      {std::regex("^flint/"), {"symbolic", "solve"}, true},  // exact algebra; in solve/ guesses, no proofs
      {std::regex("^coin/"), {"solve"}, true},
      {std::regex("^hdf5|^H5"), {"result"}, true},
      {std::regex("^cairo"), {"report"}, true},
      {std::regex("^zlib"), {"report", "result"}, true},
      {std::regex("^pugi"), {"kinematics", "report"}, true},
      {std::regex("^urdf_"), {}, true},  // another reader of URDF, for comparison
      {std::regex("^CLI/"), {"app"}, false},
      {std::regex("^tao/"), {"symbolic", "kinematics"}, false},
      {std::regex("^nlohmann/"), {"result", "analyze", "report", "studio", "bench"}, true},
      {std::regex("^boost/(asio|beast)"), {"studio"}, true},
      {std::regex("^kainjow/"), {"report"}, false},
      {std::regex("^toml\\+\\+/"), {"report"}, false},
      {std::regex("^pybind11/|^Python\\.h"), {"python"}, false},
  };
  return rules;
}

std::string first_folder(const std::string& path) { return path.substr(0, path.find('/')); }

// "solve/step" of "solve/step/options.h"; "solve" of a file beside the inner folders.
std::string inner_folder(const std::string& path) { return path.substr(0, path.rfind('/')); }

bool has_inner_folders(const std::string& folder) {
  const auto after = arrows_of_house().lower_bound(folder + "/");
  return after != arrows_of_house().end() && after->first.starts_with(folder + "/");
}

template <typename Visit>
void for_each_line(const std::string& text, const Visit& visit) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) visit(line, number);
}

template <typename Visit>
void for_each_include(const std::string& text, const Visit& visit) {
  static const std::regex include("^\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"]");
  for_each_line(text, [&](const std::string& line, int number) {
    std::smatch match;
    if (line.find("include") != std::string::npos && std::regex_search(line, match, include))
      visit(match[2].str(), match[1] == "\"", number);
  });
}

bool ends_with(const std::string& text, const std::string& end) { return text.ends_with(end); }

class Findings {
 public:
  explicit Findings(std::string path) : path_(std::move(path)) {}
  void add(int line, const std::string& problem) { list_.push_back(path_ + ":" + std::to_string(line) + ": " + problem); }
  std::vector<std::string> take() { return std::move(list_); }

 private:
  std::string path_;
  std::vector<std::string> list_;
};

// target_link_libraries follows the same arrows as the includes.
void check_links(const std::string& folder, const std::string& text, Findings& findings) {
  const auto arrows = arrows_of_house().find(folder);
  if (arrows == arrows_of_house().end()) return;
  static const std::regex target("corank::([a-z]+)");
  for_each_line(text, [&](const std::string& line, int number) {
    for (std::sregex_iterator it(line.begin(), line.end(), target), end; it != end; ++it) {
      const std::string linked = (*it)[1];
      if (!arrows->second.contains(linked)) findings.add(number, folder + " may not link corank::" + (*it)[1].str());
    }
  });
}

}  // namespace

std::vector<std::string> folders() {
  std::vector<std::string> names;
  for (const auto& [folder, used] : arrows_of_house())
    if (folder.find('/') == std::string::npos) names.push_back(folder);
  return names;
}

std::set<std::pair<std::string, std::string>> arrows() {
  std::set<std::pair<std::string, std::string>> all;
  for (const auto& [folder, used] : arrows_of_house())
    for (const std::string& target : used) all.emplace(folder, target);
  return all;
}

std::set<std::string> included_folders(const std::string& text) {
  std::set<std::string> included;
  for_each_include(text, [&](const std::string& header, bool, int) {
    if (!header.starts_with("corank/")) return;
    included.insert(first_folder(header.substr(7)));
    included.insert(inner_folder(header.substr(7)));
  });
  return included;
}

std::vector<std::string> violations(const std::string& path, const std::string& text) {
  Findings findings(path);
  std::string folder = first_folder(path);
  const bool is_test = folder == "tests";
  if (!is_test && !arrows_of_house().contains(folder)) findings.add(1, folder + " is not in cmake/folders.txt");
  if (ends_with(path, "CMakeLists.txt")) {
    check_links(folder, text, findings);
    return findings.take();
  }
  const auto inner = arrows_of_house().find(inner_folder(path));
  if (has_inner_folders(folder) && (inner == arrows_of_house().end() || inner->first == folder))
    findings.add(1, "not in an inner folder of cmake/folders.txt");
  const std::string tested = is_test ? first_folder(path.substr(path.find('/') + 1)) : "";
  const auto arrows = arrows_of_house().find(folder);
  for_each_include(text, [&](const std::string& header, bool quoted, int line) {
    if (quoted && !header.starts_with("corank/")) {
      findings.add(line, "\"" + header + "\": headers of this repository are included as \"corank/<folder>/<file>.h\"");
    }
    if (header.starts_with("corank/")) {
      const std::string target = first_folder(header.substr(7));
      if (arrows != arrows_of_house().end() && target != folder && !arrows->second.contains(target)) {
        findings.add(line, folder + " may not include " + target);
      } else if (const std::string beside = inner_folder(header.substr(7));
                 target == folder && inner != arrows_of_house().end() && beside != inner->first &&
                 !inner->second.contains(beside)) {
        findings.add(line, inner->first + " may not include " + beside);
      } else if (folder == kChecker && kNotForTheChecker.contains(header.substr(7))) {
        findings.add(line, folder + " may include plain values only, not " + header);
      }
      return;
    }
    for (const LibraryRule& rule : library_rules()) {
      if (!std::regex_search(header, rule.header)) continue;
      const bool allowed = rule.folders.contains(folder) || (is_test && (rule.in_any_test || rule.folders.contains(tested)));
      if (!allowed) findings.add(line, folder + " may not include <" + header + ">");
    }
  });
  return findings.take();
}

std::vector<std::string> public_header_violations(const std::string& path, const std::string& text) {
  // Of other libraries only the compiler's own intrinsics, which are part of it.
  static const std::regex standard("^[a-z_0-9]+$|^(emmintrin|immintrin|xmmintrin)\\.h$");
  Findings findings(path);
  for_each_include(text, [&](const std::string& header, bool, int line) {
    if (!header.starts_with("corank/") && !std::regex_search(header, standard)) {
      findings.add(line, "an installed header shows <" + header + ">");
    }
  });
  return findings.take();
}

std::vector<std::string> unsafe_math(const std::string& path, const std::string& text) {
  static const std::vector<std::string> flags{
      "-ffast-math",       "-Ofast", "-funsafe-math-optimizations", "-fassociative-math", "-ffinite-math-only",
      "-ffp-contract=fast"};
  Findings findings(path);
  for_each_line(text, [&](const std::string& line, int number) {
    const auto is_in_line = [&line](const std::string& flag) { return line.find(flag) != std::string::npos; };
    if (std::any_of(flags.begin(), flags.end(), is_in_line))
      findings.add(number, "asks for arithmetic that is not IEEE's: " + line);
  });
  return findings.take();
}

}  // namespace corank::architecture
