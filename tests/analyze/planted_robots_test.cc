// Random five-bars with random tolerances, loads and requirements: no map claims what a random robot contradicts, each
// certificate is accepted, and what was made false in it is refused. CORANK_SEEDS=100 makes 100,000 cases and 1,000 damages.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <functional>
#include <random>

#include "corank/tests/analyze/map_files.h"
#include "corank/tests/analyze/required_robots.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

constexpr std::array kNames{"l2", "l3", "l4", "l5", "d"};
constexpr int kRobots = 1000, kDamages = 10;  // of a map

class Planted {
 public:
  explicit Planted(unsigned seed) : random_(seed) {
    for (std::size_t k = 0; k < kNames.size(); ++k) {
      lengths_[k] = thousandths(k == 4 ? 1.1 : 0.8, k == 4 ? 1.3 : 1.0);
      tolerances_[k] = thousandths(0.001, 0.006);
    }
    const auto text = [](double x) { return std::to_string(x); };
    const double k = thousandths(1, 3), load = thousandths(5, 20), along = thousandths(1, 9),
                 error = thousandths(0.002, 0.02);
    switch (below(4)) {
      case 0: require("amplification(outputs) <= " + text(k), k, [](const MatrixXd& j) { return amplification(j); }); break;
      case 1:
        require("amplification(inputs) <= " + text(k), k, [](const MatrixXd& j) { return amplification(j.inverse()); });
        break;
      case 2:  // decimetres
        require("torque(theta2) <= " + text(k) + " N m under force(J3x, J3y) <= " + text(load) +
                    " N, force(J3x) <= " + text(along) + " N",
                10 * k, [=](const MatrixXd& j) { return load * j.col(0).norm() + along * std::fabs(j(0, 0)); });
        break;
      default:
        require("error(J3x, J3y) <= " + text(k) + " mm under inputs <= " + text(error), k / 100, [error](const MatrixXd& j) {
          return error * std::max((j * Vector2d(1, 1)).norm(), (j * Vector2d(1, -1)).norm());
        });
    }
  }

  MapQuestion question() {
    study::Question question = required(model_question("dextar.cuik", symbolic::SingularitySet::cspace), {text_});
    for (std::size_t k = 0; k < kNames.size(); ++k)
      question.constants.push_back({kNames[k], std::to_string(lengths_[k]) + " ± " + std::to_string(tolerances_[k])});
    result::put_in(question.constants, question.model);
    const auto side = [this](const char* name, double from, double to) {
      const double at = thousandths(from, to);
      return symbolic::Parameter{name, std::to_string(at), std::to_string(at + 0.4)};
    };
    return {.question = std::move(question), .over = {side("J3x", 0, 0.8), side("J3y", 0.1, 0.8)}};
  }

  double in(const Interval& side) { return std::uniform_real_distribution<double>(side.lo(), side.hi())(random_); }
  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }
  const std::string& text() const { return text_; }
  double most() const { return most_; }

  // What is required is at most that in all postures, whose number is told, of a random robot or the one as drawn.
  double worst(double x, double y, bool drawn, int& count) {
    std::array<double, 5> l = lengths_;
    for (std::size_t k = 0; k < l.size() && !drawn; ++k) {
      const double by = in({-tolerances_[k], tolerances_[k]});
      l[k] += below(2) == 0 ? by : std::copysign(tolerances_[k], by);
    }
    // Legs of their own lengths, one by one: J has a row and a column of each.
    const std::array<double, 2> ground{l[4], 0}, crank{l[0], l[3]}, rod{l[1], l[2]};
    count = 0;
    double worst = 0;
    for (int branch = 0; branch < 4; ++branch) {
      MatrixXd outputs(2, 2), inputs = MatrixXd::Zero(2, 2);
      for (int i = 0; i < 2; ++i) {
        const Vector2d to(x - ground[i], y);
        const double cosine = (to.squaredNorm() + crank[i] * crank[i] - rod[i] * rod[i]) / (2 * crank[i] * to.norm());
        if (!(std::fabs(cosine) <= 1)) return 0;
        const double angle = std::atan2(to.y(), to.x()) + ((branch >> i & 1) != 0 ? 1 : -1) * std::acos(cosine);
        const Vector2d e = to - crank[i] * Vector2d(std::cos(angle), std::sin(angle));
        outputs.row(i) = e.transpose();
        inputs(i, i) = crank[i] * e.dot(Vector2d(-std::sin(angle), std::cos(angle)));
      }
      ++count;
      worst = std::max(worst, value_(outputs.inverse() * inputs));
    }
    return worst;
  }

 private:
  double thousandths(double lo, double hi) { return std::round(1000 * in({lo, hi})) / 1000; }
  void require(std::string text, double most, std::function<double(const MatrixXd&)> value) {
    text_ = std::move(text);
    most_ = most;
    value_ = std::move(value);
  }

  std::mt19937 random_;
  std::array<double, 5> lengths_{}, tolerances_{};
  std::string text_;
  double most_ = 0;
  std::function<double(const MatrixXd&)> value_;
};

// Makes something false of a cell that has solutions; false: not of this one.
bool damage(Planted& robot, MapFile& file) {
  MapCellClaim cell = file.claims.cells[robot.below(file.claims.cells.size())];
  if (cell.sheets.empty()) return false;
  const std::size_t text = file.model_text.find(robot.text());
  const bool known = cell.standing != Standing::open;
  switch (robot.below(5)) {
    case 0: {
      int count = 0;
      const double worst = robot.worst(cell.sides[0].mid(), cell.sides[1].mid(), true, count);
      if (std::fabs(worst / robot.most() - 1) < 1e-6) return false;
      cell.standing = worst < robot.most() ? Standing::violated : Standing::satisfied;
      break;
    }
    case 1: cell.sheets.push_back(cell.sheets[robot.below(cell.sheets.size())]), ++cell.count; break;
    case 2: {  // a sheet of some robots only
      MapSheet& sheet = cell.sheets[robot.below(cell.sheets.size())];
      Interval& side = sheet.box[sheet.box.size() - 1 - robot.below(kNames.size())];
      if (!(side.width() > 0)) return false;
      side = Interval(side.lo(), side.mid());
      break;
    }
    case 3:
      if (!known) return false;
      file.model_text.replace(
          text, robot.text().size(),
          cell.standing == Standing::satisfied ? "amplification(outputs) <= 1/1000" : "amplification(outputs) <= 1000000");
      break;
    default: {
      result::ConstantOverride& c = file.constants[robot.below(file.constants.size())];  // robots that nothing is proven of
      c.expression.replace(c.expression.find("± 0.0") + std::string("± 0.").size(), 1, "1");
    }
  }
  file.claims.cells = {std::move(cell)};
  return true;
}

TEST(PlantedRobots, WithinTolerancesContradictNoMap) {
  int cases = 0, satisfied = 0, violated = 0, damages = 0;
  for (unsigned seed = 0; seed < test::seeds(2); ++seed) {
    Planted robot(seed);
    SCOPED_TRACE(robot.text());
    const MapQuestion question = robot.question();
    solve::Control control;
    const ParameterMap map =
        parameter_map(question, {.resolution = 16, .boundary = false, .certificate = true, .threads = 2}, control);
    const MapFile good = to_file(question, map);
    for (int k = 0; k < kRobots; ++k, ++cases) {
      const double x = robot.in(map.region[0]), y = robot.in(map.region[1]);
      const MapCellAnswer* cell = cell_at(map, x, y);
      ASSERT_NE(cell, nullptr);
      int count = 0;
      const double worst = robot.worst(x, y, false, count);
      EXPECT_EQ(cell->count.value_or(count), count) << x << " " << y;
      if (count == 0 || !cell->standing) continue;
      if (cell->standing == Standing::satisfied) {
        ++satisfied;
        EXPECT_LT(worst, robot.most() * (1 + 1e-9));
      } else if (cell->standing == Standing::violated) {
        ++violated;
        EXPECT_GT(worst, robot.most() * (1 - 1e-9));
      }
    }
    const check::MapReport report = result::verify(good);
    EXPECT_TRUE(report.verified()) << result::to_table(report, good);
    for (int k = 0, tries = 0; k < kDamages && tries < 100 * kDamages; ++tries) {
      MapFile bad = good;
      if (!damage(robot, bad)) continue;
      ++k, ++damages;
      EXPECT_FALSE(result::verify(bad).verified());
    }
  }
  EXPECT_GT(satisfied, 0);
  EXPECT_GT(violated, 0);
  std::printf("%d robots, %d of them in cells that are satisfied, %d in cells that are violated; %d damages\n", cases,
              satisfied, violated, damages);
}

}  // namespace
}  // namespace corank::analyze
