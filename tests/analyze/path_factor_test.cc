// How far tolerances may grow until a robot cannot follow a path: planted truths, and robots at random that do follow it.
#include "corank/analyze/paths/path_factor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "corank/analyze/paths/path_space.h"
#include "corank/result/values/claim_files.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/analyze/path_samples.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using ::testing::HasSubstr;

struct OneLength {
  std::string name;
  double value, tolerance;
};

study::Question robot_with(const std::string& file, const std::vector<OneLength>& lengths,
                           const std::vector<std::string>& required = {}) {
  std::vector<result::ConstantOverride> overrides;
  for (const OneLength& l : lengths) {
    const std::string exact = ExactNumber::dyadic(l.value).text();
    overrides.push_back({l.name, l.tolerance > 0 ? exact + " ± " + ExactNumber::dyadic(l.tolerance).text() : exact});
  }
  study::Model model = study::read_model(std::string(CORANK_SOURCE_DIR "/models/") + file, overrides);
  study::require(required, model);
  return {.model = std::move(model.mechanism), .constants = overrides, .assembly = std::move(model.assembly)};
}

using Ends = std::array<std::vector<NamedValue>, 2>;

result::PathFile stored_path(const study::Question& question, const Ends& ends, std::array<int, 2> modes,
                             Avoid avoid = Avoid::forward) {
  PathFinder finder(question, {.avoid = avoid});
  solve::Control control;
  const Path path =
      finder.find(finder.end(ends[0], modes[0], "--from", control), finder.end(ends[1], modes[1], "--to", control), control);
  return to_file(finder, path);
}

double to_few_bits(double x) { return std::ldexp(std::round(std::ldexp(x, 12)), -12); }

// A robot without tolerances follows the sections of a path of another one without: from the start x, which is moved, with
// these signs of determinants; none: those at the start.
bool follows(const PathSpace& space, const Tube& tube, Eigen::VectorXd& x, std::vector<int>& signs) {
  constexpr int kSteps = 40;
  for (std::size_t k = 0; k + 1 < tube.nodes.size(); ++k) {
    for (int s = 0; s <= kSteps; ++s) {
      if (!move_to_section(space, tube.nodes[k], tube.nodes[k + 1], static_cast<double>(s) / kSteps, x)) return false;
      const PathSpace::State state = space.state(x);
      if (signs.empty()) signs = state.signs;
      if (state.signs != signs || !state.inside) return false;
    }
  }
  return true;
}

// The start of the path of the robot with these lengths: step by step from the robot as drawn.
bool robot_follows(const std::string& file, const std::vector<OneLength>& drawn, const std::vector<double>& lengths,
                   const Tube& tube) {
  constexpr int kSteps = 8;
  Eigen::VectorXd x;
  std::vector<int> signs;
  for (int s = 0; s <= kSteps; ++s) {
    std::vector<OneLength> own = drawn;
    for (std::size_t k = 0; k < own.size(); ++k)
      own[k] = {own[k].name, own[k].value + (lengths[k] - own[k].value) * s / kSteps, 0};
    const PathSpace space(robot_with(file, own), Avoid::forward, 0);
    if (s == 0) x = space.middle(tube.nodes.front().box);
    Tube start = tube;
    start.nodes.resize(2);
    start.nodes[1] = start.nodes[0];
    if (!follows(space, s == kSteps ? tube : start, x, signs)) return false;
  }
  return true;
}

// The crank passes the position in line with the base, beyond it, while 2 + d < 3 + 9/2.
TEST(PathFactor, EnclosesThePlantedOneOfACrank) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(4.8, 5.3), size(0.01, 0.1);
  const Ends ends{{{{"theta", "pi/2"}}, {{"theta", "3*pi/2"}}}};
  int lost = 0, false_ones = 0, wide = 0;
  for (unsigned k = 0; k < test::seeds(10); ++k) {
    const OneLength d{"d", to_few_bits(value(random)), to_few_bits(size(random))};
    const double truth = (5.5 - d.value) / d.tolerance;
    const std::string file = "planar/four_bar_crank_rocker.cuik";
    const result::PathFile path = stored_path(robot_with(file, {{"d", d.value, 0}}), ends, {1, 2});
    solve::Control control;
    const study::Question question = robot_with(file, {d});
    const PathFactor f = path_factor(question, path, {}, control);
    lost += !f.upper || f.lower == 0;
    false_ones += f.lower > truth || (f.upper && *f.upper < truth);
    wide += !f.complete();
    if (k > 0) continue;
    const auto json = nlohmann::json::parse(to_json(question, f));
    EXPECT_EQ(json["keep"]["path"], "forward");
    EXPECT_NEAR(json["robot"]["d"]["hi"], 5.5, 0.01);
    EXPECT_THAT(to_table(question, f), HasSubstr("every robot is to keep: the path without forward singularities"));
  }
  printf("crank: %d lost, %d false, %d not as precise as asked for\n", lost, false_ones, wide);
  EXPECT_EQ(lost + false_ones, 0);
  EXPECT_LE(wide, static_cast<int>(test::seeds(10)) / 2);
}

struct PathCase {
  std::string file;
  std::vector<OneLength> lengths;
  Ends ends;
  std::array<int, 2> modes;
};

// Every robot within the lower bound follows, at a corner or anywhere; the one of the upper bound, a little more off, meets
// the singularity. Beyond a fold a robot may have another path.
TEST(PathFactor, IsKeptByRobotsAtRandom) {
  const std::vector<PathCase> cases{{"dextar.cuik",
                                     {{"l2", 0.9, 0.001}, {"l3", 0.9, 0.002}, {"l4", 0.9, 0.001}, {"d", 1.18, 0.001}},
                                     {{{{"J3x", "1/2"}, {"J3y", "1"}}, {{"J3x", "7/10"}, {"J3y", "-1"}}}},
                                     {1, 2}},
                                    {"dextar.cuik",
                                     {{"l5", 0.9, 0.001}, {"d", 1.18, 0.01}},
                                     {{{{"J3x", "1/2"}, {"J3y", "1"}}, {{"J3x", "7/10"}, {"J3y", "1"}}}},
                                     {1, 1}},
                                    {"planar/3rpr.cuik",
                                     {{"bx", 2, 0.001}, {"px", 1, 0.002}, {"cx", 0.8, 0.001}},
                                     {{{{"pose_x", "4/5"}, {"pose_y", "1/2"}, {"pose_phi", "1/10"}},
                                       {{"pose_x", "1"}, {"pose_y", "3/5"}, {"pose_phi", "1/5"}}}},
                                     {1, 1}}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-1, 1);
  int false_below = 0, robots = 0, singular = 0;
  for (const PathCase& c : cases) {
    std::vector<OneLength> drawn = c.lengths;
    for (OneLength& l : drawn) l.tolerance = 0;
    const result::PathFile path = stored_path(robot_with(c.file, drawn), c.ends, c.modes);
    solve::Control control;
    const PathFactor f = path_factor(robot_with(c.file, c.lengths), path, {.precision = 0.05, .progress = {}}, control);
    ASSERT_TRUE(f.upper) << c.file << ": " << f.reason;
    EXPECT_GT(f.lower, 0.8 * *f.upper) << c.file;
    for (unsigned k = 0; k < test::seeds(20); ++k, ++robots) {
      std::vector<double> own;
      for (const OneLength& l : c.lengths) {
        const double at = share(random);
        own.push_back(l.value + f.lower * l.tolerance * (k % 2 == 0 ? std::copysign(1, at) : at));
      }
      false_below += !robot_follows(c.file, drawn, own, path.tube);
    }
    if (f.what != "its path meets a singularity there") continue;
    ++singular;
    std::vector<double> beyond;
    for (const OneLength& l : c.lengths) {
      const double end = std::ranges::find(f.robot, l.name, &CoordinateValue::name)->value.hi();
      beyond.push_back(l.value + 1.02 * (end - l.value));
    }
    EXPECT_FALSE(robot_follows(c.file, drawn, beyond, path.tube)) << c.file;
  }
  printf("%d robots within lower bounds, %d that do not follow\n", robots, false_below);
  EXPECT_EQ(false_below, 0);
  EXPECT_GT(singular, 0);
}

// Bodies come too near for a robot, long before it is singular.
TEST(PathFactor, OfDistancesIsWhereBodiesComeTooNear) {
  const std::vector<std::string> required{"distance(J5 J4, J1 J2) >= 0.3"};
  const Ends ends{{{{"J3x", "1/2"}, {"J3y", "1"}}, {{"J3x", "7/10"}, {"J3y", "1"}}}};
  const study::Question drawn = robot_with("dextar.cuik", {}, required);
  const result::PathFile path = stored_path(drawn, ends, {1, 1}, Avoid::requirements);
  solve::Control control;
  const PathFactor f = path_factor(robot_with("dextar.cuik", {{"d", 1.18, 0.01}}, required), path,
                                   {.precision = 0.05, .progress = {}}, control);
  ASSERT_TRUE(f.upper) << f.reason;
  EXPECT_GT(f.lower, 0);
  EXPECT_EQ(f.what, "there its path does not meet what is required");
}

TEST(PathFactor, AsksForAPathOfTheRobotAsDrawn) {
  const Ends ends{{{{"theta", "pi/2"}}, {{"theta", "2"}}}};
  const std::string file = "planar/four_bar_crank_rocker.cuik";
  const result::PathFile path = stored_path(robot_with(file, {}), ends, {1, 1});
  solve::Control control;
  const PathFactor other = path_factor(robot_with(file, {{"a", 2.25, 0.01}}), path, {}, control);
  EXPECT_EQ(other.lower, 0);
  EXPECT_FALSE(other.upper);
  EXPECT_THAT(other.reason, HasSubstr("as drawn"));
  EXPECT_THROW(path_factor(robot_with(file, {}), path, {}, control), symbolic::ModelError) << "no tolerance";
  EXPECT_THROW(path_factor(robot_with("dextar.cuik", {{"l", 0.9, 0.01}}), path, {}, control), symbolic::ModelError);
}

}  // namespace
}  // namespace corank::analyze
