// Paths of all robots within their tolerances: each robot's own lift lies in the tube, and meets no singularity there.
#include <gtest/gtest.h>

#include <random>

#include "corank/analyze/paths/path.h"
#include "corank/result/values/claim_files.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/analyze/path_samples.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using Values = std::vector<std::pair<std::string, double>>;

study::Question robot(const std::string& file, const Values& constants, double tolerance) {
  std::vector<result::ConstantOverride> overrides;
  for (const auto& [name, value] : constants) {
    const std::string exact = ExactNumber::dyadic(value).text();
    overrides.push_back({name, tolerance > 0 ? exact + " ± " + ExactNumber::dyadic(tolerance).text() : exact});
  }
  study::Model model = study::read_model(std::string(CORANK_SOURCE_DIR "/models/") + file, overrides);
  return {.model = std::move(model.mechanism), .constants = overrides, .assembly = std::move(model.assembly)};
}

// The tube as one robot's: its parameters have their values.
Tube of_one(const Tube& tube, const System& all, const System& one) {
  std::vector<std::size_t> places;
  for (const Variable& v : one.variables) places.push_back(all.find(v.name));
  const auto kept = [&](const auto& list, std::size_t from) {
    std::remove_cvref_t<decltype(list)> result;
    for (const std::size_t j : places) result.push_back(list[from + j]);
    return result;
  };
  Tube result = tube;
  for (TubeNode& node : result.nodes) {
    std::vector<double> rows;
    for (std::size_t i = 0; i < node.values.size(); ++i)
      for (const double x : kept(node.rows, i * all.variables.size())) rows.push_back(x);
    node.rows = std::move(rows);
    node.box = kept(node.box, 0);
  }
  for (Box& piece : result.pieces) piece = kept(piece, 0);
  result.sizes = kept(tube.sizes, 0);
  return result;
}

struct Case {
  std::string file;
  Values constants;
  double tolerance;
  std::vector<NamedValue> from, to;
  int mode;
};

std::vector<Case> cases() {
  const Values links{{"l2", 0.9}, {"l3", 0.9}, {"l4", 0.9}, {"l5", 0.9}, {"d", 1.18}};
  const Values platform{{"bx", 2}, {"px", 1}, {"cx", 0.8}};
  return {{"dextar.cuik", links, 0.01, {{"J3x", "1/2"}, {"J3y", "1"}}, {{"J3x", "7/10"}, {"J3y", "1"}}, 1},
          {"dextar.cuik", {{"l", 0.9}}, 0.001, {{"J3x", "1/2"}, {"J3y", "1"}}, {{"J3x", "7/10"}, {"J3y", "-1"}}, 2},
          {"planar/3rpr.cuik",
           platform,
           0.001,
           {{"pose_x", "4/5"}, {"pose_y", "1/2"}, {"pose_phi", "1/10"}},
           {{"pose_x", "1"}, {"pose_y", "3/5"}, {"pose_phi", "1/5"}},
           1}};
}

TEST(ToleratedPath, IsAPathOfEveryRobot) {
  std::mt19937 random(11);
  for (const Case& c : cases()) {
    const study::Question question = robot(c.file, c.constants, c.tolerance);
    PathFinder finder(question, {});
    ASSERT_EQ(finder.system().parameters(), std::ssize(c.constants));
    solve::Control control;
    const Box from = finder.end(c.from, 1, "--from", control), to = finder.end(c.to, c.mode, "--to", control);
    const Path path = finder.find(from, to, control);
    ASSERT_EQ(path.status, Path::Status::path) << c.file;
    EXPECT_GT(path.tube->radius(), 0);
    EXPECT_TRUE(result::verify(to_file(finder, path)).verified()) << c.file;
    std::uniform_real_distribution<double> change(-c.tolerance, c.tolerance);
    for (unsigned k = 0; k < test::seeds(10); ++k) {
      Values own = c.constants;
      for (auto& [name, value] : own) {
        const double by = change(random);
        value += k % 2 == 0 ? std::copysign(c.tolerance, by) : by;
      }
      const PathSpace one(robot(c.file, own, 0), Avoid::forward);
      EXPECT_TRUE(samples_agree(one, of_one(*path.tube, finder.system(), one.system()), 100)) << c.file << " " << k;
    }
  }
}

TEST(ToleratedPath, IsHeldToByTheChecker) {
  const Case c = cases().front();
  PathFinder finder(robot(c.file, c.constants, c.tolerance), {});
  solve::Control control;
  const Path path = finder.find(finder.end(c.from, 1, "--from", control), finder.end(c.to, 1, "--to", control), control);
  ASSERT_TRUE(path.tube);
  const int d = finder.system().find("d");
  const auto verified = [&](const auto& change) {
    result::PathFile file = to_file(finder, path);
    change(file.tube);
    return result::verify(file).verified();
  };
  const auto half = [](Interval& side) { side = Interval(side.lo(), side.mid()); };
  EXPECT_TRUE(verified([](Tube&) {}));
  EXPECT_FALSE(verified([&](Tube& tube) { half(tube.pieces[0][d]); }));
  EXPECT_FALSE(verified([&](Tube& tube) { half(tube.nodes[0].box[d]); }));
  EXPECT_FALSE(verified([](Tube& tube) { tube.radii[0] *= 1.2; }));
}

}  // namespace
}  // namespace corank::analyze
