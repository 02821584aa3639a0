// The problems of the CUIK suite whose answers are known: solved as `corank solve NAME.cuik --param NAME.param` does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "corank/result/cuik/cuik_files.h"
#include "corank/result/files/result_file.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_error.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/cuik/shell.h"
#include "corank/tests/cuik/suite_files.h"
#include "corank/tests/models/closed_forms.h"

namespace corank::cuik {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::vector<std::string> kPoints{"Welding0D", "Serial6RRX60"};
const std::vector<std::string> kCurves{"FourBars",  "FourBars_extraeq", "Checker3",      "SmartBird",
                                       "Welding1D", "3RPR_sing",        "FiveBars_sing", "simple_sing"};
const std::vector<std::string> kLarge{"3RPR", "3RPR_full", "Dietmeier"};

struct Problem {
  symbolic::Mechanism mechanism;
  System system;
  solve::Options options;
};

Problem read_problem(const fs::path& model) {
  symbolic::Mechanism mechanism = symbolic::read_model(model);
  System system = symbolic::algebrize(symbolic::plain_system(mechanism));
  system.coefficient_tolerance = solve::printed_tolerance(system);
  solve::Options options;
  options.sigma = result::sigma_for(result::read_param(fs::path(model).replace_extension(".param")), system);
  options.threads = 0;
  return {std::move(mechanism), std::move(system), std::move(options)};
}

Problem problem(const std::string& name) { return read_problem(suite_folder() / "problems" / (name + ".cuik")); }

bool is_proven(const CoverBox& b) { return b.verdict != Verdict::undecided && b.verdict != Verdict::pending; }

std::size_t proven(const Cover& cover) {
  return static_cast<std::size_t>(std::count_if(cover.boxes.begin(), cover.boxes.end(), is_proven));
}

TEST(KnownAnswers, AreAskedForOfEveryProblem) {
  SKIP_WITHOUT_SUITE_FILES();
  std::set<std::string> expected, found;
  for (const auto* names : {&kPoints, &kCurves, &kLarge}) expected.insert(names->begin(), names->end());
  for (const auto& entry : fs::directory_iterator(suite_folder() / "problems"))
    if (entry.path().extension() == ".cuik") found.insert(entry.path().stem());
  EXPECT_EQ(found, expected);
}

TEST(KnownAnswers, WeldingHasTwoSolutions) {
  SKIP_WITHOUT_SUITE_FILES();
  const Problem p = problem("Welding0D");
  const Cover cover = solve::solve(p.system, p.options);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 0);
  ASSERT_EQ(cover.points.size(), 2u);
  EXPECT_EQ(cover.boxes.size(), 2u);
  for (const CoverBox& point : cover.points) EXPECT_TRUE(is_proven(point)) << to_string(point.verdict);
}

TEST(KnownAnswers, TheSixRobotArmReachesItsPoseInEightWays) {
  SKIP_WITHOUT_SUITE_FILES();
  const Problem p = problem("Serial6RRX60");
  const Cover cover = solve::solve(p.system, p.options);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 0);
  ASSERT_EQ(cover.points.size(), 8u);
  for (const CoverBox& point : cover.points) EXPECT_TRUE(is_proven(point)) << to_string(point.verdict);
}

class KnownCurve : public ::testing::TestWithParam<std::string> {};

TEST_P(KnownCurve, IsProvenToBeOneAlmostEverywhere) {
  SKIP_WITHOUT_SUITE_FILES();
  const Problem p = problem(GetParam());
  const Cover cover = solve::solve(p.system, p.options);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_GT(2 * proven(cover), cover.boxes.size());
  std::size_t others = 0;
  for (const CoverBox& b : cover.boxes) others += is_proven(b) && b.free.size() != 1;
  EXPECT_EQ(others, 0u) << "pieces with more or fewer free variables than one";
  if (GetParam() != "3RPR_sing") return;
  // Lengths of tens, products up to 10⁵: σ holds all the same.
  for (const symbolic::Coordinate& c : p.mechanism.coordinates()) {
    const int v = p.system.find(c.name);
    ASSERT_GE(v, 0) << c.name;
    std::size_t wide = 0;
    for (const CoverBox& b : cover.boxes) wide += b.box[static_cast<std::size_t>(v)].width() > cover.sigma.length;
    EXPECT_EQ(wide, 0u) << c.name;
  }
}

std::string name_of(const ::testing::TestParamInfo<std::string>& test) { return "of" + test.param; }

INSTANTIATE_TEST_SUITE_P(Suite, KnownCurve, ::testing::ValuesIn(kCurves), name_of);

// Three unit vectors in the plane y = 0 that add up to (−1, 0, 0): one of them is (−1, 0, 0), the others opposite. Three
// circles, two of which cross wherever all are (±1, 0, 0).
TEST(KnownAnswers, TheRhombusMovesAlongThreeCirclesThatCrossThreeTimes) {
  SKIP_WITHOUT_SUITE_FILES();
  const Problem p = problem("FourBars");
  const Cover cover = solve::solve(p.system, p.options);
  const auto holds = [&](const CoverBox& b, const std::array<std::pair<double, double>, 3>& links) {
    for (std::size_t k = 0; k < links.size(); ++k) {
      const std::string link = "link" + std::to_string(k + 2) + "_u_";
      const auto at = [&](const char* axis) { return b.box[static_cast<std::size_t>(p.system.find(link + axis))]; };
      if (!at("x").contains(links[k].first) || !at("y").contains(0) || !at("z").contains(links[k].second)) return false;
    }
    return true;
  };
  for (std::size_t fixed = 0; fixed < 3; ++fixed) {
    for (int degree = 0; degree < 360; ++degree) {
      const double t = degree * M_PI / 180, x = std::cos(t), z = degree % 180 == 0 ? 0 : std::sin(t);
      std::array<std::pair<double, double>, 3> links{};
      links[fixed] = {-1, 0};
      links[(fixed + 1) % 3] = {x, z};
      links[(fixed + 2) % 3] = {-x, -z};
      std::size_t holding = 0, of_them_proven = 0;
      for (const CoverBox& b : cover.boxes) {
        if (!holds(b, links)) continue;
        ++holding;
        of_them_proven += is_proven(b);
      }
      EXPECT_GT(holding, 0u) << fixed << ' ' << degree;
      if (z == 0) {
        EXPECT_EQ(of_them_proven, 0u) << "no curve passes a crossing as a graph";
      }
    }
  }
}

// A box that is a piece of a proven sheet, to be cut further or not, may stick out of the domain where the sheet leaves it.
bool is_in_domain(const System& system, const CoverBox& b) {
  for (std::size_t j = 0; j < b.box.size(); ++j) {
    const Interval& domain = system.variables[j].domain;
    if (b.verdict == Verdict::undecided ? !domain.contains(b.box[j]) : !domain.overlaps(b.box[j])) return false;
  }
  return true;
}

void expect_valid_incomplete(const System& system, const Cover& cover) {
  EXPECT_FALSE(cover.complete());
  EXPECT_GT(cover.count(Verdict::pending), 0u);
  EXPECT_TRUE(
      std::all_of(cover.boxes.begin(), cover.boxes.end(), [&](const CoverBox& b) { return is_in_domain(system, b); }));
}

class LargeProblem : public ::testing::TestWithParam<std::string> {};

TEST_P(LargeProblem, EndsAtALimitWithAValidIncompleteCover) {
  SKIP_WITHOUT_SUITE_FILES();
  Problem p = problem(GetParam());
  p.options.time_limit = 1;
  p.options.max_boxes = 1000;
  const Cover cover = solve::solve(p.system, p.options);
  expect_valid_incomplete(p.system, cover);
  EXPECT_LT(cover.statistics.processed, 2 * p.options.max_boxes) << "each thread may take one more";
}

INSTANTIATE_TEST_SUITE_P(Suite, LargeProblem, ::testing::ValuesIn(kLarge), name_of);

TEST(KnownAnswers, TheProgramWritesAnIncompleteResultOfALargeProblem) {
  SKIP_WITHOUT_SUITE_FILES();
  const Folder folder;
  const Problem p = problem("3RPR");
  for (const char* extension : {".cuik", ".param"})
    fs::copy_file(suite_folder() / "problems" / (std::string("3RPR") + extension),
                  folder.file(std::string("a") + extension));
  const Outcome run = folder.run("corank solve a.cuik --param a.param --time-limit 0.5 -o a.h5");
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_THAT(run.out, HasSubstr("INCOMPLETE"));
  const result::Result result = result::read_result(folder.file("a.h5"));
  expect_valid_incomplete(p.system, result.cover);
  EXPECT_EQ(result.options.sigma, (Sigma{0.1, 0.1}));
  EXPECT_EQ(result.options.time_limit, 0.5);
}

// The tutorial's printed systems of Dextar and those that corank derives from its model: the same configurations, whatever
// the kernel vectors.
class Dextar : public ::testing::TestWithParam<std::pair<std::string, symbolic::SingularitySet>> {
 protected:
  static constexpr int kConfiguration = 10;

  static std::size_t boxes_that_meet_none(const Cover& from, const std::vector<int>& from_index, const Cover& to,
                                          const std::vector<int>& to_index) {
    const auto meets = [&](const CoverBox& a, const CoverBox& b) {
      for (std::size_t k = 0; k < from_index.size(); ++k) {
        if (!a.box[static_cast<std::size_t>(from_index[k])].overlaps(b.box[static_cast<std::size_t>(to_index[k])]))
          return false;
      }
      return true;
    };
    return static_cast<std::size_t>(std::count_if(from.boxes.begin(), from.boxes.end(), [&](const CoverBox& a) {
      return std::none_of(to.boxes.begin(), to.boxes.end(), [&](const CoverBox& b) { return meets(a, b); });
    }));
  }
};

TEST_P(Dextar, HasTheSameConfigurationsInTheTutorialsFilesAndFromItsModel) {
  SKIP_WITHOUT_SUITE_FILES();
  const auto& [name, set] = GetParam();
  const Problem printed = read_problem(suite_folder() / "solutions" / (name + ".cuik"));
  const auto model = symbolic::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik");
  const System derived = symbolic::algebrize(symbolic::singularity_system(model, set));
  const Cover theirs = solve::solve(printed.system, printed.options), ours = solve::solve(derived, printed.options);
  EXPECT_TRUE(theirs.complete() && ours.complete());
  EXPECT_EQ(theirs.sigma, (Sigma{0.1, 0.1}));
  EXPECT_EQ(theirs.sigma, ours.sigma);

  // ct2 is the model's c_theta2; DextarConfiguration has the model's order.
  std::vector<int> in_theirs, in_ours;
  for (int v = 0; v < kConfiguration; ++v) {
    std::string variable = derived.variables[static_cast<std::size_t>(v)].name;
    in_ours.push_back(v);
    if (const std::size_t at = variable.find("_theta"); at != std::string::npos) variable.replace(at, 6, "t");
    in_theirs.push_back(printed.system.find(variable));
    ASSERT_EQ(in_theirs.back(), v) << variable;
  }
  EXPECT_EQ(boxes_that_meet_none(theirs, in_theirs, ours, in_ours), 0u) << "of " << theirs.boxes.size();
  EXPECT_EQ(boxes_that_meet_none(ours, in_ours, theirs, in_theirs), 0u) << "of " << ours.boxes.size();

  const auto samples =
      set == symbolic::SingularitySet::forward ? test::dextar_forward_samples(2000) : test::dextar_inverse_samples(2000);
  ASSERT_GT(samples.size(), 1000u);
  for (const Cover* cover : {&theirs, &ours}) {
    const test::CoverLookup lookup(*cover);
    constexpr double kRounding = 1e-7;  // of the samples, where two circles nearly touch
    EXPECT_TRUE(std::all_of(samples.begin(), samples.end(), [&](const auto& q) { return lookup.holds(q, kRounding); }));
  }
}

INSTANTIATE_TEST_SUITE_P(Suite, Dextar,
                         ::testing::Values(std::pair("fwd", symbolic::SingularitySet::forward),
                                           std::pair("inv", symbolic::SingularitySet::inverse)),
                         [](const auto& test) { return test.param.first; });

}  // namespace
}  // namespace corank::cuik
