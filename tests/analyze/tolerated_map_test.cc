// Maps of all robots within tolerances: no robot contradicts a number or a requirement of a cell.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "corank/tests/analyze/map_files.h"
#include "corank/tests/analyze/required_robots.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using ::testing::HasSubstr;
using Kind = MapCellAnswer::Kind;

constexpr double kTolerance = 0.05;

// The ends of two bars meet; the distance of their pivots has a tolerance, and a width follows it.
study::Question two_bars() {
  return question_of(R"([CONSTANTS]
r1 := 1
r2 := 1
d := 2 ± 0.05
w := 2*d
[SYSTEM VARS]
x : [-w - r1, w + r1]
y : [-4, 4]
[SYSTEM EQS]
x^2 + y^2 = r1^2;
(x - d)^2 + y^2 = r2^2;)");
}
const std::vector<symbolic::Parameter> kBars{{"r1", "1/2", "5/2"}, {"r2", "1/2", "5/2"}};

int crossings(double r1, double r2, double d) { return std::fabs(r1 - r2) < d && r1 + r2 > d ? 2 : 0; }

class Numbers {
 public:
  double in(const Interval& side) { return std::uniform_real_distribution<double>(side.lo(), side.hi())(random_); }
  // One of the ends in every second case, where robots differ most.
  double within(double nominal, double tolerance) {
    const double by = in({-tolerance, tolerance});
    return nominal + (random_() % 2 == 0 ? by : std::copysign(tolerance, by));
  }

 private:
  std::mt19937 random_{7};
};

TEST(ToleratedMap, HasTheNumberOfEveryRobot) {
  const int resolution = 128;
  solve::Control control;
  const ParameterMap map =
      parameter_map({.question = two_bars(), .over = kBars}, {.resolution = resolution, .threads = 2}, control);
  ASSERT_TRUE(map.complete);
  ASSERT_EQ(map.tolerances.size(), 1u);
  EXPECT_EQ(map.tolerances[0].first, "d");
  EXPECT_NEAR(map.tolerances[0].second.width(), 2 * kTolerance, 1e-12);
  Numbers numbers;
  for (unsigned k = 0; k < test::seeds(5000); ++k) {
    const double r1 = numbers.in(map.region[0]), r2 = numbers.in(map.region[1]), d = numbers.within(2, kTolerance);
    const MapCellAnswer* cell = cell_at(map, r1, r2);
    ASSERT_NE(cell, nullptr);
    EXPECT_EQ(cell->count.value_or(crossings(r1, r2, d)), crossings(r1, r2, d)) << r1 << " " << r2 << " " << d;
    // Where a little more tolerance makes no difference, the number is proven.
    const double more = kTolerance + 8.0 / resolution;
    if (crossings(r1, r2, 2 - more) == crossings(r1, r2, 2 + more)) {
      EXPECT_EQ(cell->kind, Kind::proven) << r1 << " " << r2;
    } else if (crossings(r1, r2, 2 - kTolerance) != crossings(r1, r2, 2 + kTolerance)) {
      EXPECT_EQ(cell->kind, Kind::undecided) << "robots differ at " << r1 << " " << r2;
    }
  }
}

TEST(ToleratedMap, EnclosesTheCurvesOfAllRobots) {
  solve::Control control;
  const ParameterMap map = parameter_map({.question = two_bars(), .over = kBars}, {.resolution = 64}, control);
  ASSERT_TRUE(map.boundary_known);
  Numbers numbers;
  for (int k = 0; k < 2000; ++k) {
    const double r1 = numbers.in({0.6, 1.4}), r2 = numbers.within(2, kTolerance) - r1;
    EXPECT_TRUE(std::ranges::any_of(
        map.boundary, [&](const MapBoundaryBox& b) { return b.sides[0].contains(r1) && b.sides[1].contains(r2); }))
        << r1 << " " << r2;
  }
}

MapQuestion five_bar(double tolerance) {
  study::Question question =
      required(model_question("dextar.cuik", symbolic::SingularitySet::cspace), {"amplification(outputs) <= 2"});
  const std::string limits = " ± " + std::to_string(tolerance);
  question.constants = {{"l", "0.9" + limits}, {"d", "1.18" + limits}};
  result::put_in(question.constants, question.model);
  return {.question = std::move(question), .over = {{"J3x", "0", "1"}, {"J3y", "1/5", "1"}}};
}

TEST(ToleratedMap, ClaimsNoRequirementThatARobotContradicts) {
  const int resolution = test::long_run() ? 256 : 128;
  double satisfied_before = 1;
  for (const double tolerance : {0.0, 0.001, 0.01}) {
    solve::Control control;
    const ParameterMap map =
        parameter_map(five_bar(tolerance), {.resolution = resolution, .boundary = false, .threads = 2}, control);
    Numbers numbers;
    int satisfied = 0, violated = 0;
    for (int k = 0; k < (test::long_run() ? 100'000 : 3000); ++k) {
      const double x = numbers.in(map.region[0]), y = numbers.in(map.region[1]);
      const MapCellAnswer* cell = cell_at(map, x, y);
      ASSERT_NE(cell, nullptr);
      const auto all = five_bar_postures(x, y, numbers.within(0.9, tolerance), numbers.within(1.18, tolerance));
      EXPECT_EQ(cell->count.value_or(static_cast<int>(all.size())), static_cast<int>(all.size())) << x << " " << y;
      if (!cell->standing || cell->standing == Standing::open) continue;
      double worst = 0;
      for (const MatrixXd& j : all) worst = std::max(worst, amplification(j));
      if (cell->standing == Standing::satisfied) {
        ++satisfied;
        EXPECT_LT(worst, 2 * (1 + 1e-9)) << x << " " << y;
      } else {
        ++violated;
        EXPECT_GT(worst, 2 * (1 - 1e-9)) << x << " " << y;
      }
    }
    EXPECT_GT(satisfied, 20);
    EXPECT_GT(violated, 200);
    EXPECT_LE(map.share_where(Standing::satisfied), satisfied_before);
    satisfied_before = map.share_where(Standing::satisfied);
    EXPECT_GT(satisfied_before, 0.01) << tolerance;
  }
}

TEST(ToleratedMap, IsVerifiedForEveryRobotAndNotForMore) {
  MapQuestion question = five_bar(0.001);
  question.over = {{"J3x", "1/4", "1"}, {"J3y", "3/10", "8/10"}};
  const MapFile file = make_file(question, 32);
  const std::string path = ::testing::TempDir() + "tolerated_map_test.h5";
  result::write_map(path, file);
  const MapFile read = result::read_map(path);
  const check::MapReport report = result::verify(read);
  EXPECT_TRUE(report.complete()) << result::to_table(report, read);
  EXPECT_THAT(result::to_table(report, read), HasSubstr("J3x and J3y, of every robot within the tolerances of l, d\n"));
  EXPECT_THAT(report.completed(), ::testing::Gt(100u));
  for (const double nominal : {0.9, 1.18}) {  // a sheet of some robots only
    MapFile some = file;
    auto cell = std::ranges::find_if(some.claims.cells, [](const MapCellClaim& c) { return !c.sheets.empty(); });
    MapSheet& sheet = cell->sheets[0];
    const auto side = std::ranges::find_if(sheet.box, [nominal = nominal](const Interval& s) {
      return s.contains(nominal) && std::fabs(s.width() - 0.002) < 1e-12;
    });
    ASSERT_NE(side, sheet.box.end());
    *side = Interval(side->lo(), nominal);
    EXPECT_THAT(result::verify(some).failures.at(0), HasSubstr("not of every robot")) << nominal;
  }
  MapFile wider = file;  // robots that nobody proved anything of
  for (result::ConstantOverride& c : wider.constants)
    if (c.name == "l") c.expression = "0.9 ± 0.002";
  EXPECT_FALSE(result::verify(wider).verified());
}

TEST(ToleratedMap, IsRefusedWhereRobotsWouldHaveDifferentPlanes) {
  EXPECT_THAT(refusal_of({.question = two_bars(), .over = {{"r1", "1/2", "w"}, {"r2", "1/2", "5/2"}}}),
              HasSubstr("the range of 'r1' depends on 'd', which has a tolerance"));
  EXPECT_THAT(refusal_of({.question = two_bars(), .over = {{"r1", "1/2", "1"}, {"x", "0", "1"}}, .fixed = {{"y", "d"}}}),
              HasSubstr("depends on 'd', which has a tolerance"));
  EXPECT_EQ(refusal_of({.question = two_bars(), .over = {{"r1", "1/2", "1"}, {"d", "1", "3"}}}), "none") << "it runs itself";
  MapQuestion counts{.question = model_question("dextar.cuik", symbolic::SingularitySet::cspace),
                     .over = {{"l2", "1/2", "3/2"}, {"l3", "1/2", "3/2"}},
                     .answer = MapAnswer::components};
  result::put_in(std::vector<result::ConstantOverride>{{"d", "1.18 ± 0.01"}}, counts.question.model);
  EXPECT_THAT(refusal_of(counts), HasSubstr("a map of components answers for one robot"));
}

}  // namespace
}  // namespace corank::analyze
