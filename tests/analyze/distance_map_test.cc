// Distances of bodies over a plane, against distances of segments in plain doubles, at places chosen at random: planar
// five-bars and arms in space of random sizes. No cell is contradicted; the files of their maps are verified.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "corank/tests/analyze/map_files.h"
#include "corank/tests/analyze/required_robots.h"
#include "corank/tests/analyze/segment_distance.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using Eigen::Vector3d;
using test::segment_distance;

// What is required is that this is `least` or more at every place; nothing: no posture there.
struct PlantedBodies {
  MapQuestion question;
  std::function<std::vector<double>(double, double)> distances;  // of each posture
  double least = 0;
};

class Sizes {
 public:
  explicit Sizes(unsigned seed) : random_(seed) {}
  double thousandths(double lo, double hi) {
    return std::round(1000 * std::uniform_real_distribution<double>(lo, hi)(random_)) / 1000;
  }
  unsigned below(unsigned n) { return static_cast<unsigned>(random_() % n); }

 private:
  std::mt19937 random_;
};

std::string text(double x) { return std::to_string(x); }

PlantedBodies five_bar(unsigned seed) {
  Sizes sizes(seed);
  const double l = sizes.thousandths(0.8, 1), d = sizes.thousandths(1, 1.4), radius = sizes.thousandths(0.01, 0.1),
               least = sizes.thousandths(0, 0.2);
  const unsigned pair = sizes.below(3);
  const char* const pairs[] = {"J5 J4, J1 J2", "J5 J4, J2 J3", "J4 J3, J1"};
  std::string bodies = pairs[pair];
  bodies.insert(bodies.find(','), " radius " + text(radius));
  const std::string require = "distance(" + bodies + " radius " + text(radius) + ") >= " + text(least);
  study::Question question = required(model_question("dextar.cuik", symbolic::SingularitySet::cspace), {require});
  question.constants = {{"l", text(l)}, {"d", text(d)}};
  result::put_in(question.constants, question.model);
  const auto distances = [=](double x, double y) {
    const Vector3d j5(0, 0, 0), j1(d, 0, 0), j3(x, y, 0);
    std::vector<double> result;
    for (int branch = 0; branch < 4; ++branch) {
      std::array<Vector3d, 2> elbow;
      for (int i = 0; i < 2; ++i) {
        const Vector3d ground = i == 0 ? j5 : j1, to = j3 - ground;
        if (to.norm() > 2 * l) return std::vector<double>();
        const double angle = std::atan2(to.y(), to.x()) + ((branch >> i & 1) != 0 ? 1 : -1) * std::acos(to.norm() / (2 * l));
        elbow[i] = ground + l * Vector3d(std::cos(angle), std::sin(angle), 0);
      }
      result.push_back(pair == 0   ? segment_distance(j5, elbow[0], j1, elbow[1])
                       : pair == 1 ? segment_distance(j5, elbow[0], elbow[1], j3)
                                   : segment_distance(elbow[0], j3, j1, j1));
    }
    return result;
  };
  const double from = sizes.thousandths(-0.5, 0.5);
  return {{.question = std::move(question), .over = {{"J3x", text(from), text(from + 0.8)}, {"J3y", "1/10", "9/10"}}},
          distances,
          least + 2 * radius};
}

// An arm that turns about a column, with a shoulder off its axis and an elbow, beside a post.
PlantedBodies arm(unsigned seed) {
  Sizes sizes(seed);
  const double off = sizes.thousandths(0.1, 0.3), l = sizes.thousandths(0.8, 1.2), k = sizes.thousandths(0.7, 1.1),
               z = sizes.thousandths(-0.2, 0.8), px = sizes.thousandths(0.5, 1), py = sizes.thousandths(-1, 1),
               radius = sizes.thousandths(0.02, 0.1), least = sizes.thousandths(0, 0.2);
  const bool post = sizes.below(2) == 0;
  study::Question question = question_of(
      "[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\nz : [-3, 3]\na ~\nb ~\nc ~\n[SYSTEM EQS]\n"
      "x = cos(a)*(" +
      text(off) + " + " + text(l) + "*cos(b) + " + text(k) +
      "*cos(c));\n"
      "y = sin(a)*(" +
      text(off) + " + " + text(l) + "*cos(b) + " + text(k) +
      "*cos(c));\n"
      "z = " +
      text(l) + "*sin(b) + " + text(k) +
      "*sin(c);\n"
      "[INPUTS] a, b, c\n[OUTPUTS] x, y, z\n[DRAWING]\n"
      "point E = (cos(a)*(" +
      text(off) + " + " + text(l) + "*cos(b)), sin(a)*(" + text(off) + " + " + text(l) + "*cos(b)), " + text(l) +
      "*sin(b))\n"
      "point P = (x, y, z)\n"
      "point A = (0, 0, -1)\npoint B = (0, 0, 1)\n"
      "point C = (" +
      text(px) + ", " + text(py) + ", -1)\npoint D = (" + text(px) + ", " + text(py) +
      ", 1/2)\n"
      "cylinder forearm = E P radius " +
      text(radius) + "\ncylinder column = A B radius " + text(radius) + "\ncylinder post = C D radius " + text(radius) +
      "\n");
  question = required(std::move(question),
                      {std::string("distance(forearm, ") + (post ? "post" : "column") + ") >= " + text(least)});
  const auto distances = [=](double x, double y) {
    std::vector<double> result;
    for (const double side : {1.0, -1.0})
      for (const double way : {1.0, -1.0}) {
        const double r = side * std::hypot(x, y) - off, n = std::hypot(r, z);
        const double cosine = (n * n + l * l - k * k) / (2 * l * n);
        if (std::fabs(cosine) > 1) continue;
        const double at = std::atan2(z, r) + way * std::acos(cosine), turn = std::atan2(side * y, side * x);
        const double out = off + l * std::cos(at);
        const Vector3d elbow(std::cos(turn) * out, std::sin(turn) * out, l * std::sin(at)), end(x, y, z);
        result.push_back(post ? segment_distance(elbow, end, {px, py, -1}, {px, py, 0.5})
                              : segment_distance(elbow, end, {0, 0, -1}, {0, 0, 1}));
      }
    return result;
  };
  return {
      {.question = std::move(question), .over = {{"x", "3/10", "11/10"}, {"y", "-2/5", "2/5"}}, .fixed = {{"z", text(z)}}},
      distances,
      least + 2 * radius};
}

TEST(PlantedBodies, ContradictNoMapOfDistances) {
  int places = 0, satisfied = 0, violated = 0;
  double open = 0, all = 0;
  for (unsigned seed = 0; seed < test::seeds(6); ++seed) {
    const PlantedBodies planted = seed % 2 == 0 ? five_bar(seed) : arm(seed);
    SCOPED_TRACE(planted.question.question.model.requirement_texts().at(0) + ", seed " + std::to_string(seed));
    solve::Control control;
    const ParameterMap map =
        parameter_map(planted.question, {.resolution = 32, .boundary = false, .certificate = true, .threads = 2}, control);
    std::mt19937 random(seed);
    for (int k = 0; k < 1700; ++k) {
      const auto in = [&](const Interval& side) {
        return std::uniform_real_distribution<double>(side.lo(), side.hi())(random);
      };
      const double x = in(map.region[0]), y = in(map.region[1]);
      const MapCellAnswer* cell = cell_at(map, x, y);
      ASSERT_NE(cell, nullptr);
      const std::vector<double> there = planted.distances(x, y);
      EXPECT_EQ(cell->count.value_or(static_cast<int>(there.size())), static_cast<int>(there.size())) << x << " " << y;
      if (there.empty() || !cell->standing) continue;
      ++places;
      const double least = *std::ranges::min_element(there);
      if (cell->standing == Standing::satisfied) {
        ++satisfied;
        EXPECT_GT(least, planted.least - 1e-9) << x << " " << y;
      } else if (cell->standing == Standing::violated) {
        ++violated;
        EXPECT_LT(least, planted.least + 1e-9) << x << " " << y;
      }
    }
    for (const MapCellAnswer& cell : map.cells)
      if (cell.standing) {
        all += map.share_of(cell);
        if (cell.standing == Standing::open) open += map.share_of(cell);
      }
    if (seed < 4) {
      const MapFile file = to_file(planted.question, map);
      const check::MapReport report = result::verify(file);
      EXPECT_TRUE(report.verified()) << result::to_table(report, file);
    }
  }
  EXPECT_GT(satisfied, places / 10);
  EXPECT_GT(violated, places / 10);
  EXPECT_LT(open, all / 4);
  std::printf("%d places in cells of known postures, %d satisfied, %d violated; %.1f %% of these cells' area open\n", places,
              satisfied, violated, 100 * open / all);
}

// A cell's standing the other way round, or a limit that is not met in the model's text.
TEST(DistanceMap, OfAFalseFileIsRefused) {
  const PlantedBodies planted = five_bar(0);
  solve::Control control;
  const MapFile good = to_file(
      planted.question,
      parameter_map(planted.question, {.resolution = 16, .boundary = false, .certificate = true, .threads = 2}, control));
  int damages = 0;
  for (const MapCellClaim& cell : good.claims.cells) {
    if (cell.standing == Standing::open || cell.count == 0) continue;
    MapFile bad = good;
    bad.claims.cells = {cell};
    bad.claims.cells[0].standing = cell.standing == Standing::satisfied ? Standing::violated : Standing::satisfied;
    EXPECT_FALSE(result::verify(bad).verified());
    if (++damages == 40) break;
  }
  EXPECT_GT(damages, 10);
}

}  // namespace
}  // namespace corank::analyze
