// The CUIK suite's own mechanism files, which are no part of the repository: each is read, or refused by the name of what
// cannot be read; doc/cuik.md lists which.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "corank/kinematics/equations/assembly.h"
#include "corank/kinematics/language/part_file.h"
#include "corank/tests/cuik/suite_files.h"
#include "corank/tests/kinematics/read_robot.h"
#include "corank/tests/seeds.h"

namespace corank::kinematics {
namespace {

namespace fs = std::filesystem;

std::string why_refused(const std::string& message) {
  static const std::regex kind("joints of the kind '(\\w+)'"), file("the included file '([^']+)' is not there"),
      body("of the body '([^']+)' of the link '\\w+' is needed");
  std::smatch match;
  if (std::regex_search(message, match, kind)) return match[1].str();
  if (std::regex_search(message, match, file)) return "the included file " + match[1].str() + " is not at hand";
  if (std::regex_search(message, match, body)) return "vertices of " + match[1].str() + ", which is not at hand";
  return message;
}

std::vector<fs::path> worlds() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(cuik::suite_folder() / "worlds")) {
    if (entry.path().extension() == ".world") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(SuiteWorlds, AreReadOrRefusedByNameAsTheDocumentationSays) {
  SKIP_WITHOUT_SUITE_FILES();
  if (!fs::exists(cuik::suite_folder() / "worlds")) GTEST_SKIP() << "no mechanism files in " << cuik::suite_folder();
  std::ostringstream doc;
  doc << std::ifstream(CORANK_SOURCE_DIR "/doc/cuik.md").rdbuf();
  std::size_t read = 0;
  const std::vector<fs::path> files = worlds();
  for (const fs::path& path : files) {
    std::string result;
    try {
      const Robot robot = read_part_file(path);
      ++read;
      result = "read: " + std::to_string(robot.links.size()) + " links, " + std::to_string(robot.joints.size()) + " joints";
      if (!robot.missing.empty()) result += ", " + std::to_string(robot.missing.size()) + " missing";
    } catch (const symbolic::ModelError& error) {
      EXPECT_GT(error.where().line, 0) << error.what();
      result = "refused: " + why_refused(error.what());
    }
    const std::string name = fs::relative(path, cuik::suite_folder() / "worlds").generic_string();
    const std::string line = "\n| " + name + " | " + result + " |";
    EXPECT_NE(doc.str().find(line), std::string::npos) << "doc/cuik.md lacks " << line;
  }
  EXPECT_EQ(files.size(), 122u);
  EXPECT_EQ(read, 102u);
  std::cout << read << " of " << files.size() << " mechanism files are read\n";
}

std::string how_it_moves(const Robot& robot) {
  const Assembly assembly = assemble(robot);
  std::string text = std::string(to_string(assembly.space)) + ", mobility " + std::to_string(assembly.mobility);
  if (assembly.mobility_by_rank && *assembly.mobility_by_rank > assembly.mobility)
    text += ", " + std::to_string(*assembly.mobility_by_rank) + " by the rank";
  return text;
}

// Of many loops, each like another that is assembled always: for long runs.
bool is_dear(const std::string& world) {
  static const std::set<std::string> dear{"Bio/cs_orig.world", "Bio/csh_orig.world", "Symmetry/example2p.world",
                                          "Symmetry/example6.world", "Symmetry/example6b.world"};
  return dear.contains(world);
}

TEST(SuiteWorlds, MoveAsTheDocumentationSays) {
  SKIP_WITHOUT_SUITE_FILES();
  if (!fs::exists(cuik::suite_folder() / "worlds")) GTEST_SKIP() << "no mechanism files in " << cuik::suite_folder();
  std::ifstream doc(CORANK_SOURCE_DIR "/doc/cuik.md");
  static const std::regex row("\\| (\\S+\\.world) \\| (read: [^|]*) \\| ([^|]*)\\|");
  std::size_t read = 0, assembled = 0;
  for (std::string line; std::getline(doc, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    ++read;
    const std::string what = match[2], moves = match[3];
    const bool whole = what.find("missing") == std::string::npos;
    EXPECT_EQ(whole, !moves.empty()) << line;
    if (!whole) continue;
    ++assembled;
    if (is_dear(match[1]) && !test::long_run()) continue;
    EXPECT_EQ(how_it_moves(read_part_file(cuik::suite_folder() / "worlds" / match[1].str())) + " ", moves) << line;
  }
  EXPECT_EQ(read, 102u);
  EXPECT_EQ(assembled, 86u);
}

// The number of coordinates less that of constraints, six for each link: what the suite prints for some of its mechanisms.
int mobility(const Robot& robot) {
  int result = 6 * (static_cast<int>(robot.links.size()) - 1);
  for (const Joint& joint : robot.joints) {
    switch (joint.kind) {
      case JointKind::revolute:
      case JointKind::parallelogram:
      case JointKind::prismatic: result -= 5; break;
      case JointKind::cylindrical:
      case JointKind::universal: result -= 4; break;
      case JointKind::slot: result -= 2; break;
      case JointKind::spherical:
      case JointKind::planar: result -= 3; break;
      case JointKind::fixed: result -= 6; break;
      case JointKind::universal_rod:
      case JointKind::distance: result -= 1; break;
      case JointKind::distance_variable: break;
    }
  }
  return result;
}

TEST(SuiteWorlds, HaveTheMobilityOfTheirMechanisms) {
  SKIP_WITHOUT_SUITE_FILES();
  const fs::path folder = cuik::suite_folder() / "worlds";
  if (!fs::exists(folder)) GTEST_SKIP() << "no mechanism files in " << cuik::suite_folder();
  EXPECT_EQ(mobility(read_part_file(folder / "Serial6R/Serial6RRX60.world")), 0) << "six revolute joints and a fixed hand";
  EXPECT_EQ(mobility(read_part_file(folder / "ParallelPlatform/Dietmeier.world")), 0) << "six rods of constant length";
  EXPECT_EQ(mobility(read_part_file(folder / "Cycloalkanes/Cyclooctane.world")), 2) << "a ring of eight revolute joints";
  EXPECT_EQ(mobility(read_part_file(folder / "SingFree/3RPR_model.world")), 3 - 9 + 3)
      << "planar loops count three constraints too many each";
}

}  // namespace
}  // namespace corank::kinematics
