// Maps of where cables pull between two limits, held against every way to choose their tensions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <array>
#include <cmath>
#include <random>

#include "corank/analyze/sets/standing.h"
#include "corank/symbolic/sets/requirements.h"
#include "corank/tests/analyze/map_files.h"
#include "corank/tests/analyze/required_robots.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using ::testing::HasSubstr;

// A point on cables from anchors, in metres.
struct CablePoint {
  std::vector<Vector2d> anchors;
  double least = 5, most = 200;  // of tensions
  Vector2d weight{0, 0};         // a load that is always there
  double force = 0;              // and one of any direction

  std::string text() const {
    std::string variables = "[SYSTEM VARS]\nx : [-1, 1]\ny : [-1, 1]\n", equations = "[SYSTEM EQS]\n", inputs, names;
    for (std::size_t k = 0; k < anchors.size(); ++k) {
      variables += fmt::format("d{} : [0.01, 9]\n", k + 1);
      equations += fmt::format("(x - ({}))^2 + (y - ({}))^2 - d{}^2 = 0;\n", anchors[k].x(), anchors[k].y(), k + 1);
      inputs += fmt::format("{}d{}", k > 0 ? ", " : "", k + 1);
    }
    return fmt::format("{}{}[INPUTS] {}\n[OUTPUTS] x, y\n[DRAWING]\nunit m\n[REQUIREMENTS]\n{};\n", variables, equations,
                       inputs, requirement(inputs));
  }
  std::string requirement(const std::string& cables) const {
    return fmt::format("tension({}) in [{} N, {} N] under force(x) = {} N, force(y) = {}, force(x, y) <= {} N", cables,
                       least, most, weight.x(), weight.y(), force);
  }

  // Σ t_k e_k = −f, e_k towards the anchors: if there are such tensions, there are some of which all but two are at a limit.
  bool holds(const Vector2d& at, const Vector2d& f, double slack) const {
    const std::size_t m = anchors.size();
    std::vector<Vector2d> e;
    for (const Vector2d& a : anchors) e.push_back((a - at).normalized());
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = i + 1; j < m; ++j)
        for (std::size_t ends = 0; ends < std::size_t{1} << (m - 2); ++ends) {
          Vector2d rest = -f;
          std::size_t bit = 0;
          for (std::size_t k = 0; k < m; ++k)
            if (k != i && k != j) rest -= ((ends >> bit++ & 1) != 0 ? most : least) * e[k];
          Eigen::Matrix2d two;
          two << e[i], e[j];
          const Vector2d t = two.inverse() * rest;
          if (t.allFinite() && t.minCoeff() >= least - slack && t.maxCoeff() <= most + slack) return true;
        }
    return false;
  }
  // Under each load of the polygon about, or within, the disc of loads: those that can be held are a convex set.
  bool holds_all(const Vector2d& at, bool about, double slack) const {
    constexpr int kCorners = 90;
    const double radius = about ? force / std::cos(M_PI / kCorners) : force;
    for (int k = 0; k < kCorners; ++k) {
      const double angle = 2 * M_PI * k / kCorners;
      if (!holds(at, weight + radius * Vector2d(std::cos(angle), std::sin(angle)), slack)) return false;
    }
    return true;
  }
};

CablePoint random_point(unsigned seed, std::mt19937& random) {
  const auto number = [&](double from, double to) {
    return std::round(100 * std::uniform_real_distribution<double>(from, to)(random)) / 100;
  };
  CablePoint result;
  const int cables = 2 + static_cast<int>(seed % 3);
  for (int k = 0; k < cables; ++k) {
    const double angle = cables == 2 ? M_PI / 4 * (1 + 2 * k) : 2 * M_PI * k / cables + number(-0.4, 0.4);
    const double far = number(1.6, 3);
    result.anchors.emplace_back(std::round(100 * far * std::cos(angle)) / 100,
                                std::round(100 * far * std::sin(angle)) / 100);
  }
  result.least = number(0, 10);
  result.most = result.least + number(60, 200);
  result.weight = {number(-10, 10), cables == 2 ? number(-100, -40) : number(-60, 20)};
  result.force = number(0, 25);
  return result;
}

TEST(Tensions, OfAMapAreThoseThatCanBeChosen) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> side(-1, 1);
  int false_satisfied = 0, false_violated = 0, cells = 0, open = 0, unverified = 0;
  const unsigned count = test::seeds(9);
  for (unsigned seed = 0; seed < count; ++seed) {
    const CablePoint robot = random_point(seed, random);
    study::Question question = question_of(robot.text());
    question.set = symbolic::SingularitySet::cspace;
    const MapFile file = make_file(MapQuestion{.question = question, .over = {{"x", "-1", "1"}, {"y", "-1", "1"}}}, 32);
    unverified += !result::verify(file).complete();
    for (const MapCellClaim& cell : file.claims.cells) {
      ++cells;
      open += cell.standing == Standing::open;
      for (int sample = 0; sample < 4; ++sample) {
        const auto at = [&](const Interval& i) { return i.mid() + 0.5 * side(random) * i.width(); };
        const Vector2d place(at(cell.sides[0]), at(cell.sides[1]));
        false_satisfied += cell.standing == Standing::satisfied && !robot.holds_all(place, false, 1e-6);
        false_violated += cell.standing == Standing::violated && robot.holds_all(place, true, -1e-6);
      }
    }
  }
  printf("tensions: %u robots, %d cells, %d open, %d falsely satisfied, %d falsely violated\n", count, cells, open,
         false_satisfied, false_violated);
  EXPECT_EQ(false_satisfied + false_violated + unverified, 0);
  EXPECT_LT(open, cells / 2);
  EXPECT_LT(open, cells - 5 * static_cast<int>(count));
}

TEST(Tensions, ThatSomebodyChangedAreRefused) {
  CablePoint robot;
  robot.anchors = {{-2, 2}, {2, 2}, {0, -2}};
  robot.force = 40;
  study::Question question = question_of(robot.text());
  question.set = symbolic::SingularitySet::cspace;
  const MapFile file = make_file(MapQuestion{.question = question, .over = {{"x", "-1", "1"}, {"y", "-1", "1"}}}, 16);
  ASSERT_TRUE(result::verify(file).complete());
  int changed = 0;
  for (std::size_t k = 0; k < file.claims.cells.size(); k += 7) {
    const Standing standing = file.claims.cells[k].standing;
    if (standing == Standing::open) continue;
    MapFile other = file;
    other.claims.cells[k].standing = standing == Standing::satisfied ? Standing::violated : Standing::satisfied;
    EXPECT_FALSE(result::verify(other).verified());
    ++changed;
  }
  EXPECT_GT(changed, 5);
}

std::string refusal(const std::string& requirement, const std::string& text = "") {
  CablePoint robot;
  robot.anchors = {{-2, 2}, {2, 2}, {0, -2}};
  try {
    study::Question question = question_of(text.empty() ? robot.text() : text);
    question.model.keep_requirements({});
    question.model.require(requirement);
    symbolic::Requirements all(question.model);
    symbolic::at_requirements(question.model);
  } catch (const symbolic::ModelError& error) {
    return error.what();
  }
  return "none";
}

TEST(Tensions, AreRefusedWhereTheyMeanNothing) {
  EXPECT_THAT(refusal("tension(d1, d2) in [1, 2] under force(x) <= 1"), HasSubstr("the input 'd3' is none of the cables"));
  EXPECT_THAT(refusal("tension(d1, d2, d2) in [1, 2] under force(x) <= 1"), HasSubstr("occurs twice"));
  EXPECT_THAT(refusal("tension(d1, d2, d3) in [2, 1] under force(x) <= 1"), HasSubstr("its range is empty"));
  EXPECT_THAT(refusal("tension(d1, d2, x) in [1, 2] under force(x) <= 1"), HasSubstr("'x' is no input"));
  EXPECT_THAT(refusal("tension(d1, d2, d3) in [1, 2] under moment(x) <= 1"), HasSubstr("a moment on angles"));
  EXPECT_THAT(refusal("tension(d1, d2, d3) in [1 mm, 2] under force(x) <= 1"), HasSubstr("mm"));
  EXPECT_THAT(refusal("tension(d1, d2, d3) in [1, 2] under force(x) <= 1"),
              HasSubstr("one of tensions, whose limit is no single form; expected corank map"));
  EXPECT_THAT(refusal("tension(theta2, theta5) in [1, 2] under force(J3x) <= 1",
                      study::read_text(CORANK_SOURCE_DIR "/models/dextar.cuik").text),
              HasSubstr("'theta2' is no length"));
}

// A motor under its load's weight: |F| of the two together, at the worst.
TEST(Tensions, AreLikeAMotorsEffortUnderAWeight) {
  const std::string text = "[SYSTEM VARS]\nx : [-1, 1]\nd : [-9, 9]\n[SYSTEM EQS]\nd - 2*x = 0;\n[INPUTS] d\n[OUTPUTS] x\n";
  const auto standing = [&](const std::string& requirement) {
    study::Question question = question_of(text);
    question.model.require(requirement);
    const symbolic::TrigonometricSystem space = study::equations(question);
    const System system = study::system(question, space);
    Box box(system.size(), Interval(0.0));
    return Standings(question.model, space).of(box);
  };
  EXPECT_EQ(standing("force(d) <= 5 under force(x) = -6, force(x) <= 3"), Standing::satisfied) << "9/2";
  EXPECT_EQ(standing("force(d) <= 4 under force(x) = -6, force(x) <= 3"), Standing::violated);
  EXPECT_EQ(standing("tension(d) in [1, 5] under force(x) = 6, force(x) <= 3"), Standing::satisfied) << "3/2 to 9/2";
  EXPECT_EQ(standing("tension(d) in [2, 5] under force(x) = 6, force(x) <= 3"), Standing::violated);
  EXPECT_EQ(standing("tension(d) in [1, 5] under force(x) = -6, force(x) <= 3"), Standing::violated) << "a cable pushes";
}

}  // namespace
}  // namespace corank::analyze
