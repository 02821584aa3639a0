// Paths on which bodies keep their distances: random places in the tubes are compared with distances of segments, and a
// file that asks for more is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "corank/analyze/paths/path.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/analyze/map_files.h"
#include "corank/tests/analyze/required_robots.h"
#include "corank/tests/analyze/segment_distance.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using ::testing::HasSubstr;

std::vector<NamedValue> at_place(double x, double y) {
  const auto value = [](const char* name, double v) {
    return NamedValue{name, symbolic::parse_expression(std::to_string(v), name)};
  };
  return {value("J3x", x), value("J3y", y)};
}

TEST(DistancePath, KeepsBodiesApartAllAboutIt) {
  std::mt19937 random(5);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  int paths = 0, asked = 0;
  for (unsigned seed = 0; seed < test::seeds(6); ++seed) {
    const double least = std::round(1000 * number(0.1, 0.4)) / 1000;
    std::vector<std::string> texts{"distance(J5 J4, J1 J2) >= " + std::to_string(least)};
    if (seed % 2 == 1) texts.push_back("amplification(outputs) <= 20");
    const study::Question question = required(model_question("dextar.cuik", symbolic::SingularitySet::cspace), texts);
    PathFinder finder(question, {.avoid = Avoid::requirements});
    solve::Control control;
    const std::vector<Box> from = finder.ends(at_place(number(0.4, 0.8), number(0.6, 1.2)), control),
                           to = finder.ends(at_place(number(0.4, 0.8), number(0.6, 1.2)), control);
    for (std::size_t k = 0; k < from.size(); ++k) {
      const solve::Control::Limits limits{.time = 2};  // a path is found in milliseconds or not at all
      solve::Control own(limits);
      const Path path = finder.find(from[k], to[k], own);
      ++asked;
      if (!path.tube) continue;
      ++paths;
      EXPECT_NE(path.standing, Standing::open);
      const System& system = finder.system();
      const auto index = [&](const char* name) { return system.find(name); };
      const std::array<int, 4> variables{index("c_theta5"), index("s_theta5"), index("c_theta2"), index("s_theta2")};
      for (const int v : variables) ASSERT_GE(v, 0);
      for (std::size_t piece = 0; piece < path.tube->pieces.size(); ++piece)
        for (int sample = 0; sample < 50; ++sample) {
          std::array<double, 4> x{};
          for (std::size_t i = 0; i < 4; ++i) {
            const Interval& side = path.tube->pieces[piece][variables[i]];
            const double room = path.tube->radii[piece] * path.tube->sizes[variables[i]];
            x[i] = sample % 2 == 0     ? number(side.lo() - room, side.hi() + room)
                   : random() % 2 == 0 ? side.lo() - room
                                       : side.hi() + room;
          }
          EXPECT_GE(test::segment_distance({0, 0, 0}, {0.9 * x[0], 0.9 * x[1], 0}, {1.18, 0, 0},
                                           {1.18 + 0.9 * x[2], 0.9 * x[3], 0}),
                    least - 1e-9);
        }
      result::PathFile file = to_file(finder, path);
      EXPECT_TRUE(result::verify(file).verified());
      const std::size_t place = file.model_text.find(std::to_string(least));
      file.model_text.replace(place, std::to_string(least).size(), "1.5");
      const check::TubeReport report = result::verify(file);
      ASSERT_FALSE(report.verified());
      EXPECT_THAT(report.failures.back(), HasSubstr("bodies are not shown to keep their distances"));
    }
  }
  EXPECT_GT(paths, asked / 4);
  std::printf("%d paths of %d asked for\n", paths, asked);
}

// In one posture the cranks cross: there is no path from there, and the reason says so.
TEST(DistancePath, BeginsWhereBodiesAreApart) {
  const study::Question question =
      required(model_question("dextar.cuik", symbolic::SingularitySet::cspace), {"distance(J5 J4, J1 J2) >= 1/10"});
  PathFinder finder(question, {.avoid = Avoid::requirements});
  solve::Control control;
  int near = 0;
  for (const Box& end : finder.ends(at_place(0.7, 0.8), control)) {
    const bool satisfied = finder.standing(end) == Standing::satisfied;
    const Path path = finder.find(end, end, control);
    if (satisfied) continue;
    ++near;
    EXPECT_THAT(path.reason, HasSubstr("bodies are too near there"));
    EXPECT_FALSE(path.tube);
  }
  EXPECT_GT(near, 0);
}

}  // namespace
}  // namespace corank::analyze
