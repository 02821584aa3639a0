// Requirements over a plane and in balls, against kinematics of their own: nothing is claimed that a random place, or a
// random robot within tolerances, contradicts. The files of maps.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <optional>
#include <random>

#include "corank/analyze/clearance/clearance.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/analyze/map_files.h"
#include "corank/tests/analyze/required_robots.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using symbolic::SingularitySet;
using ::testing::HasSubstr;

std::vector<MatrixXd> dextar_postures(double x, double y) { return five_bar_postures(x, y, 0.9, 1.18); }
std::vector<MatrixXd> rrr_postures(double x, double y) {
  const double h = std::sqrt(3) / 2;
  return postures({{{0, 0}, {0, 0}}, {{2, 0}, {0.5, 0}}, {{1, 2 * h}, {0.25, 0.5 * h}}}, 1, 1, x, y);
}

struct RequiredCase {
  const char* name;
  MapQuestion question;
  std::function<std::vector<MatrixXd>(double, double)> postures;
  std::function<double(const MatrixXd&)> value;
  double most;
};

MapQuestion dextar_question(const char* require) {
  return {.question = required(model_question("dextar.cuik", SingularitySet::cspace), {require}),
          .over = {{"J3x", "-1/4", "1"}, {"J3y", "-1/2", "3/2"}}};
}

std::vector<RequiredCase> required_cases() {
  const auto error = [](const MatrixXd& j) {
    return 0.01 * std::max((j * Vector2d(1, 1)).norm(), (j * Vector2d(1, -1)).norm());
  };
  MapQuestion rrr{.question = required(model_question("3rrr.cuik", SingularitySet::cspace),
                                       {"amplification(outputs) <= 3 metric x: 1, y: 1, phi: 1"}),
                  .over = {{"x", "1/4", "5/4"}, {"y", "0", "1"}},
                  .fixed = {{"phi", "0"}}};
  return {{"amplification of outputs", dextar_question("amplification(outputs) <= 2"), dextar_postures, amplification, 2},
          {"amplification of inputs", dextar_question("amplification(inputs) <= 2"), dextar_postures,
           [&](const MatrixXd& j) { return amplification(j.inverse()); }, 2},
          {"torque", dextar_question("torque(theta2) <= 3 N m under force(J3x, J3y) <= 20 N"), dextar_postures,
           [](const MatrixXd& j) { return 20 * j.col(0).norm(); }, 30},
          {"error", dextar_question("error(J3x, J3y) <= 4 mm under inputs <= 0.01"), dextar_postures, error, 0.04},
          {"three legs", rrr, rrr_postures, amplification, 3}};
}

TEST(RequiredMap, ClaimsNothingThatAPlaceContradicts) {
  for (const RequiredCase& c : required_cases()) {
    SCOPED_TRACE(c.name);
    solve::Control control;
    const ParameterMap map =
        parameter_map(c.question, {.resolution = test::long_run() ? 256 : 64, .boundary = false, .threads = 2}, control);
    std::mt19937 random(1);
    const int places = test::long_run() ? 100'000 : 3000;
    int satisfied = 0, violated = 0, open = 0;
    for (int k = 0; k < places; ++k) {
      const auto in = [&](const Interval& side) {
        return std::uniform_real_distribution<double>(side.lo(), side.hi())(random);
      };
      const double x = in(map.region[0]), y = in(map.region[1]);
      const MapCellAnswer* cell = cell_at(map, x, y);
      ASSERT_NE(cell, nullptr);
      const std::vector<MatrixXd> all = c.postures(x, y);
      EXPECT_EQ(cell->count.value_or(static_cast<int>(all.size())), static_cast<int>(all.size())) << x << " " << y;
      if (all.empty()) continue;
      double worst = 0;
      for (const MatrixXd& j : all) worst = std::max(worst, c.value(j));
      if (!cell->standing || cell->standing == Standing::open) {
        ++open;
      } else if (cell->standing == Standing::satisfied) {
        ++satisfied;
        EXPECT_LT(worst, c.most * (1 + 1e-9)) << x << " " << y;
      } else {
        ++violated;
        EXPECT_GT(worst, c.most * (1 - 1e-9)) << x << " " << y;
      }
    }
    EXPECT_GT(satisfied, places / 100);
    EXPECT_GT(violated, places / 10);
    EXPECT_LT(open, places / 2);
    double all = map.shares()[0];
    for (const Standing s : {Standing::satisfied, Standing::violated, Standing::open}) all += map.share_where(s);
    EXPECT_NEAR(all, 1, 1e-9);
  }
}

// All postures of the robot as drawn meet it at the centre, so those of every robot do all over the ball.
TEST(RequiredBall, HoldsForEveryRobotWithinTolerances) {
  for (const double tolerance : {0.0, 0.001, 0.01}) {
    study::Question question =
        required(model_question("dextar.cuik", SingularitySet::requirements), {"amplification(outputs) <= 2"});
    const std::string limits = " ± " + std::to_string(tolerance);
    result::put_in({{"l", "0.9" + limits}, {"d", "1.18" + limits}}, question.model);
    BallOptions ball;
    ball.at = {{"J3x", "0.59"}, {"J3y", "0.55"}};
    ball.in = {"J3x", "J3y"};
    solve::Control control;
    const Clearance found = clearance(question, ball, {.precision = 0.01}, {}, control);
    const double radius = found.free_radius();
    EXPECT_GT(radius, 0.066 - 2.5 * tolerance);
    ASSERT_TRUE(found.nearest.upper);
    EXPECT_LT(*found.nearest.upper, 1.02 * radius);
    std::mt19937 random(5);
    const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
    double nearest = 1;  // beyond the ball there are robots that do not meet it, where the lengths are at their ends
    for (int k = 0; k < 10'000; ++k) {
      const double l = 0.9 + tolerance * (k % 2 == 0 ? number(-1, 1) : k % 4 < 2 ? -1 : 1);
      const double d = 1.18 + tolerance * (k % 3 == 0 ? number(-1, 1) : k % 6 < 3 ? -1 : 1);
      const double angle = number(-M_PI, M_PI), r = radius * std::sqrt(number(0, 1.1));
      const auto all = five_bar_postures(0.59 + r * std::cos(angle), 0.55 + r * std::sin(angle), l, d);
      ASSERT_EQ(all.size(), 4u);
      double worst = 0;
      for (const MatrixXd& j : all) worst = std::max(worst, amplification(j));
      EXPECT_TRUE(r > radius || worst < 2) << l << " " << d << " " << r;
      if (worst > 2) nearest = std::min(nearest, r);
    }
    EXPECT_LT(nearest, 1.05 * radius) << "the ball is nearly the largest one";
  }
}

// Two motors under several loads each, whatever the posture: no place in the ball contradicts it, and where the nearest
// limit is, one motor has its largest torque in one posture.
TEST(RequiredBall, OfTorquesUnderSeveralLoadsHoldsNoLimit) {
  std::mt19937 random(11);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  int met = 0;
  for (unsigned k = 0; k < test::seeds(8); ++k) {
    SCOPED_TRACE(k);
    const double x = number(0.2, 0.9), y = number(0.2, 0.9), f = number(0.5, 2), g = number(0.1, 1);
    const auto loads = [&](const MatrixXd& j, int motor) { return f * j.col(motor).norm() + g * std::fabs(j(0, motor)); };
    std::array<double, 2> worst{};
    for (const MatrixXd& j : five_bar_postures(x, y, 0.9, 1.18))
      for (const int motor : {0, 1}) worst[motor] = std::max(worst[motor], loads(j, motor));
    std::array<double, 2> most{};
    std::vector<std::string> lines;
    for (const int motor : {0, 1}) {
      most[motor] = std::round(1000 * number(1.02, 2) * worst[motor]) / 1000;
      lines.push_back(fmt::format("torque(theta{}) <= {:.3f} under force(J3x, J3y) <= {:.17g}, force(J3x) <= {:.17g}",
                                  motor == 0 ? 2 : 5, most[motor], f, g));
    }
    BallOptions ball;
    ball.at = {{"J3x", symbolic::parse_expression(fmt::format("{:.17g}", x), "x")},
               {"J3y", symbolic::parse_expression(fmt::format("{:.17g}", y), "y")}};
    ball.in = {"J3x", "J3y"};
    solve::Control control;
    const Clearance found = clearance(required(model_question("dextar.cuik", SingularitySet::requirements), lines), ball,
                                      {.precision = 0.01}, {}, control);
    ASSERT_TRUE(found.nearest.complete && found.nearest.upper);
    EXPECT_GT(found.lower(), 0);
    for (int n = 0; n < 2000; ++n) {
      const double angle = number(-M_PI, M_PI), r = found.free_radius() * std::sqrt(number(0, 1));
      const auto all = five_bar_postures(x + r * std::cos(angle), y + r * std::sin(angle), 0.9, 1.18);
      ASSERT_EQ(all.size(), 4u);
      for (const MatrixXd& j : all)
        for (const int motor : {0, 1}) EXPECT_LT(loads(j, motor), most[motor] * (1 + 1e-9));
    }
    std::array<double, 2> at{};
    for (const CoordinateValue& v : found.values)
      if (v.name == "J3x" || v.name == "J3y") at[v.name == "J3y"] = v.value.mid();
    EXPECT_NEAR(std::hypot(at[0] - x, at[1] - y), *found.nearest.upper, 1e-6);
    bool at_limit = false;
    for (const MatrixXd& j : five_bar_postures(at[0], at[1], 0.9, 1.18))
      for (const int motor : {0, 1}) at_limit = at_limit || std::fabs(loads(j, motor) / most[motor] - 1) < 1e-5;
    // … or both motors are anything, at a singular configuration.
    for (const MatrixXd& j : five_bar_postures(at[0], at[1], 0.9, 1.18)) at_limit = at_limit || !(amplification(j) < 1e4);
    EXPECT_TRUE(at_limit) << at[0] << " " << at[1];
    met += found.requirement.has_value();
  }
  EXPECT_GT(met, 0);
}

TEST(RequiredMap, OfAFunctionIsWhereItsSignIsKnown) {
  const MapQuestion question{
      .question = required(question_of("[CONSTANTS]\na := 0\nb := 0\n[SYSTEM VARS]\nx : [-9, 9]\n[SYSTEM EQS]\n"
                                       "x = a + b;"),
                           {"x^2 <= 1/4", "a*x >= -1"}),
      .over = {{"a", "-1", "1"}, {"b", "-1", "1"}}};
  solve::Control control;
  const ParameterMap map = parameter_map(question, {.resolution = 32, .boundary = false}, control);
  for (const MapCellAnswer& c : map.cells) {
    const Interval x = c.sides[0] + c.sides[1];
    EXPECT_TRUE(c.standing != Standing::satisfied || x.mag() <= 0.5) << x;
    EXPECT_TRUE(c.standing != Standing::violated || x.mig() > 0.5) << x;
  }
  EXPECT_NEAR(map.share_where(Standing::satisfied), 0.4375, 0.1);
  EXPECT_NEAR(map.share_where(Standing::violated), 0.5625, 0.1);
}

TEST(RequiredMap, IsRefusedWhereItMeansNothing) {
  MapQuestion lengths = dextar_question("amplification(outputs) <= 2*l");
  lengths.over = {{"l", "1/2", "1"}, {"J3y", "0", "1"}};
  lengths.fixed = {{"J3x", "1/2"}};
  EXPECT_THAT(refusal_of(lengths), HasSubstr("depends on a parameter"));
}

constexpr const char* kRequired = "amplification(outputs) <= 2";

const MapFile& file() {
  static const MapFile made =
      make_file(MapQuestion{.question = required(model_question("dextar.cuik", SingularitySet::cspace), {kRequired}),
                            .over = {{"J3x", "1/4", "1"}, {"J3y", "3/10", "8/10"}}},
                32);
  return made;
}

TEST(RequiredMap, IsVerifiedAsItWasWritten) {
  const std::string path = ::testing::TempDir() + "required_map_test.h5";
  result::write_map(path, file());
  const MapFile read = result::read_map(path);
  const check::MapReport report = result::verify(read);
  EXPECT_TRUE(report.complete()) << result::to_table(report, read);
  EXPECT_THAT(result::to_table(report, read),
              HasSubstr("required: amplification(outputs) <= 2\n  satisfied by every solution: on"));
  EXPECT_THAT(result::to_json(report, read), HasSubstr("\"violated\": "));
}

std::size_t index_of(Standing standing, std::size_t from) {
  const auto& cells = file().claims.cells;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (const std::size_t c = (from + k) % cells.size(); cells[c].standing == standing && cells[c].count > 0) return c;
  throw std::logic_error("no such cell");
}

// One cell alone, so that what is refused is its claim.
std::vector<std::string> failures(MapCellClaim cell, const std::string& require = {}) {
  MapFile changed = file();
  changed.claims.cells = {std::move(cell)};
  if (!require.empty()) changed.model_text.replace(changed.model_text.find(kRequired), std::strlen(kRequired), require);
  return result::verify(changed).failures;
}

TEST(RequiredMap, ThatSomebodyChangedIsRefused) {
  const auto& cells = file().claims.cells;
  std::mt19937 random(3);
  for (unsigned k = 0; k < test::seeds(6); ++k) {
    for (const Standing of : {Standing::satisfied, Standing::violated}) {
      const MapCellClaim& good = cells[index_of(of, random() % cells.size())];
      EXPECT_TRUE(failures(good).empty());
      MapCellClaim changed = good;
      changed.standing = of == Standing::satisfied ? Standing::violated : Standing::satisfied;
      EXPECT_FALSE(failures(changed).empty());
      EXPECT_FALSE(failures(good, of == Standing::satisfied ? "amplification(outputs) <= 1" : "amplification(outputs) <= 99")
                       .empty());
    }
    MapCellClaim open = cells[index_of(Standing::open, random() % cells.size())];
    double worst = 0;  // at one place in it
    for (const MatrixXd& j : dextar_postures(open.sides[0].mid(), open.sides[1].mid()))
      worst = std::max(worst, amplification(j));
    open.standing = worst > 2 ? Standing::satisfied : Standing::violated;
    EXPECT_FALSE(failures(open).empty()) << worst;
  }
  MapFile without = file();
  without.model_text.resize(without.model_text.find("[REQUIREMENTS]"));
  EXPECT_FALSE(result::verify(without).verified());
}

}  // namespace
}  // namespace corank::analyze
