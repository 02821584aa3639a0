// The CUIK suite's own files and what its programs wrote on them.
#include "corank/tests/cuik/suite_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "corank/result/cuik/cuik_files.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/cuik/shell.h"

namespace corank::cuik {
namespace {

namespace fs = std::filesystem;
using result::SolFile;

std::vector<fs::path> files_with(const std::string& extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(suite_folder())) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(SuiteFiles, EveryParameterFileIsRead) {
  SKIP_WITHOUT_SUITE_FILES();
  const std::vector<fs::path> files = files_with(".param");
  EXPECT_GE(files.size(), 14u);
  std::size_t with_sigma = 0;  // those of planners have none
  for (const fs::path& path : files) EXPECT_NO_THROW(with_sigma += result::read_param(path).sigma.has_value()) << path;
  EXPECT_GE(with_sigma, 14u);
}

TEST(SuiteFiles, EveryParameterThatASolutionFileNamesIsKnown) {
  SKIP_WITHOUT_SUITE_FILES();
  for (const fs::path& path : files_with(".sol")) {
    const std::string text = read_text(path);
    const std::size_t begin = text.find("% PARAMETERS:");
    if (begin == std::string::npos) continue;  // written by cuikatan2
    EXPECT_NO_THROW(result::parse_param(text.substr(begin, text.find("\n\n", begin) - begin), path.string()));
  }
}

TEST(SuiteFiles, EveryModelIsRead) {
  SKIP_WITHOUT_SUITE_FILES();
  const std::vector<fs::path> files = files_with(".cuik");
  EXPECT_GE(files.size(), 15u);
  for (const fs::path& path : files) {
    EXPECT_NO_THROW(symbolic::read_model(path)) << path;
  }
}

TEST(SuiteFiles, EverySolutionFileIsReadWithAllItsBoxes) {
  SKIP_WITHOUT_SUITE_FILES();
  // Boxes from the statistics at the files' ends.
  const std::vector<std::pair<std::string, std::size_t>> counts{
      {"3RPR_sing", 2881}, {"FourBars_extraeq", 522}, {"Serial6RRX60", 8}, {"Welding0D", 2}, {"Welding1D", 126},
      {"fwd", 340},        {"fwd_angles", 340},       {"inv", 660}};
  for (const auto& [name, count] : counts) {
    const SolFile file = result::read_sol(suite_folder() / "solutions" / (name + ".sol"));
    EXPECT_EQ(file.boxes.size(), count) << name;
    EXPECT_EQ(file.variables.empty(), name == "fwd_angles");
  }
}

// Our box may be wider by the rounding of the 12 printed digits, no narrower.
bool encloses(const Interval& ours, const Interval& theirs) {
  constexpr double kPrinted = 1e-10;
  return ours.lo() <= theirs.lo() + kPrinted && theirs.hi() <= ours.hi() + kPrinted;
}

TEST(SuiteFiles, AnglesEncloseTheSuitesOwn) {
  SKIP_WITHOUT_SUITE_FILES();
  const Folder folder;
  fs::copy_file(suite_folder() / "solutions/fwd.sol", folder.file("fwd.sol"));
  ASSERT_EQ(folder.run("cuikatan2 fwd 4 3 10 9 fwd_angles").status, 0);
  const SolFile ours = result::read_sol(folder.file("fwd_angles.sol"));
  const SolFile theirs = result::read_sol(suite_folder() / "solutions/fwd_angles.sol");
  ASSERT_EQ(ours.boxes.size(), theirs.boxes.size());
  int crossing = 0;
  for (std::size_t i = 0; i < ours.boxes.size(); ++i) {
    const Box &a = ours.boxes[i].box, &b = theirs.boxes[i].box;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t j = 0; j < a.size(); ++j) {
      if (j + 2 >= a.size() && a[j].hi() > 3.1415926) {
        ++crossing;  // the original is wrong there
        continue;
      }
      EXPECT_TRUE(encloses(a[j], b[j])) << i << " " << j << ": " << a[j] << " and " << b[j];
      if (j + 2 < a.size()) {
        EXPECT_TRUE(encloses(b[j], a[j]));
      }
    }
  }
  EXPECT_LT(crossing, 20);
}

// y = 0 with t = x²/4 and the circles x² + y² = 4t at t = kπ, q = cos(t)/2 throughout; in the file x and y are q2 and q3.
TEST(SuiteFiles, TheCurvesOfSimpleSingAreCovered) {
  SKIP_WITHOUT_SUITE_FILES();
  const fs::path model = suite_folder() / "problems/simple_sing.cuik";
  if (!fs::exists(model)) GTEST_SKIP() << model << " is not there";
  const System system = symbolic::algebrize(symbolic::plain_system(symbolic::read_model(model)));
  solve::Options options;
  options.sigma = result::read_param(fs::path(model).replace_extension(".param")).sigma;
  const Cover cover = solve::solve(system, options);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_GT(cover.count(Verdict::regular), 5000u);
  EXPECT_LT(cover.count(Verdict::undecided), 100u) << "17 crossings";
  const std::array<int, 4> order{system.find("q1"), system.find("q2"), system.find("q3"), system.find("ts")};
  const auto expect_covered = [&](const std::array<double, 4>& point) {
    EXPECT_TRUE(std::any_of(cover.boxes.begin(), cover.boxes.end(),
                            [&](const CoverBox& b) {
                              for (std::size_t j = 0; j < 4; ++j) {
                                const Interval& side = b.box[static_cast<std::size_t>(order[j])];
                                if (point[j] < side.lo() - 1e-11 || point[j] > side.hi() + 1e-11) return false;
                              }
                              return true;
                            }))
        << point[0] << ' ' << point[1] << ' ' << point[2] << ' ' << point[3];
  };
  const double largest = std::sqrt(32 * std::numbers::pi);
  for (int i = -400; i <= 400; ++i) {
    const double x = largest * i / 400, t = x * x / 4;
    expect_covered({std::cos(t) / 2, x, 0, t});
  }
  for (int k = 1; k <= 8; ++k)
    for (int i = 0; i < 100; ++i) {
      const double r = std::sqrt(4 * std::numbers::pi * k), a = 2 * std::numbers::pi * i / 100;
      expect_covered({k % 2 == 0 ? 0.5 : -0.5, r * std::cos(a), r * std::sin(a), std::numbers::pi * k});
    }
}

// Solves NAME.cuik with the σ of NAME.param and asks for every box of the suite whether one of ours meets it in the
// variables of both.
using SolvedProblem = std::pair<std::string, std::string>;  // folder, name

class Coverage : public ::testing::TestWithParam<SolvedProblem> {};

TEST_P(Coverage, NoBoxOfTheSuiteIsMissed) {
  SKIP_WITHOUT_SUITE_FILES();
  const auto& [folder, name] = GetParam();
  const SolFile theirs = result::read_sol(suite_folder() / "solutions" / (name + ".sol"));
  const fs::path model = suite_folder() / folder / (name + ".cuik");
  const System system = symbolic::algebrize(symbolic::plain_system(symbolic::read_model(model)));
  solve::Options options;
  options.sigma = result::read_param(fs::path(model).replace_extension(".param")).sigma;
  options.threads = 0;
  const Cover cover = solve::solve(system, options);
  EXPECT_TRUE(cover.complete());
  std::vector<std::pair<std::size_t, std::size_t>> common;
  for (std::size_t i = 0; i < theirs.variables.size(); ++i) {
    const int v = system.find(theirs.variables[i]);
    ASSERT_GE(v, 0) << theirs.variables[i];
    common.emplace_back(i, static_cast<std::size_t>(v));
  }
  int missed = 0;
  for (std::size_t k = 0; k < theirs.boxes.size(); ++k) {
    const auto meets = [&](const CoverBox& ours) {
      return std::all_of(common.begin(), common.end(),
                         [&](const auto& pair) { return ours.box[pair.second].overlaps(theirs.boxes[k].box[pair.first]); });
    };
    if (std::any_of(cover.boxes.begin(), cover.boxes.end(), meets)) continue;
    if (++missed <= 10)
      ADD_FAILURE() << name << ": box " << k + 1 << " of the suite meets none of our " << cover.boxes.size();
  }
  EXPECT_EQ(missed, 0);
}

INSTANTIATE_TEST_SUITE_P(Suite, Coverage,
                         ::testing::Values(SolvedProblem{"solutions", "fwd"}, SolvedProblem{"solutions", "inv"},
                                           SolvedProblem{"problems", "3RPR_sing"},
                                           SolvedProblem{"problems", "FourBars_extraeq"},
                                           SolvedProblem{"problems", "Serial6RRX60"}, SolvedProblem{"problems", "Welding0D"},
                                           SolvedProblem{"problems", "Welding1D"}),
                         [](const auto& test) {
                           std::string name = test.param.second;
                           return "of" + name;
                         });

}  // namespace
}  // namespace corank::cuik
