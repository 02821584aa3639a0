// Paths between random configurations: each tube is checked by the checker and by samples of its lift, each separation by
// an independent flood of samples.
#include "corank/analyze/paths/path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <queue>
#include <set>
#include <sstream>

#include "corank/analyze/paths/path_space.h"
#include "corank/analyze/paths/tube_builder.h"
#include "corank/check/tube.h"
#include "corank/study/model.h"
#include "corank/tests/analyze/path_samples.h"
#include "corank/tests/analyze/random_pairs.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using ::testing::HasSubstr;

study::Question model_of(const std::string& name) {
  return {.model = study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik").mechanism};
}

std::vector<NamedValue> values(const std::vector<std::pair<std::string, std::string>>& list) {
  std::vector<NamedValue> result;
  for (const auto& [name, text] : list) result.push_back({name, symbolic::parse_expression(text, name)});
  return result;
}

int from_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : otherwise;
}

// A flood over random configurations, joined where straight ways in doubles keep the signs.
class Flood {
 public:
  Flood(const PathSpace& space, const TubeBuilder& builder, int points, unsigned seed) : space_(space), builder_(builder) {
    std::mt19937_64 random(seed);
    const std::vector<Interval> domain = space.system().domain();
    while (static_cast<int>(points_.size()) < points) {
      Eigen::VectorXd x(space.size());
      for (int j = 0; j < space.size(); ++j) {
        const Interval& side = domain[static_cast<std::size_t>(j)];
        x(j) = std::uniform_real_distribution<double>(side.lo(), side.hi())(random);
      }
      if (space.project(x) && space.state(x).inside) add(x);
    }
  }
  // Can the second be reached from the first?
  bool joins(const Box& from, const Box& to) {
    const std::size_t a = add(from), b = add(to);
    std::set<std::pair<std::size_t, std::size_t>> checked, refused;
    for (;;) {
      std::vector<std::size_t> before(points_.size(), points_.size());
      std::queue<std::size_t> queue({a});
      before[a] = a;
      while (!queue.empty() && before[b] == points_.size()) {
        const std::size_t at = queue.front();
        queue.pop();
        for (const std::size_t next : neighbours_[at])
          if (before[next] == points_.size() && !refused.contains(std::minmax(at, next)))
            before[next] = at, queue.push(next);
      }
      if (before[b] == points_.size()) return false;
      bool whole = true;  // a coarse step may have jumped from one piece to another
      for (std::size_t at = b; at != a; at = before[at]) {
        const auto pair = std::minmax(at, before[at]);
        if (checked.contains(pair)) continue;
        (is_open(pair.first, pair.second, 2e-4) ? checked : refused).insert(pair);
        whole = whole && checked.contains(pair);
      }
      if (whole) return true;
    }
  }

 private:
  std::size_t add(const Box& box) {
    Eigen::VectorXd x(space_.size());
    for (int j = 0; j < space_.size(); ++j) x(j) = box[static_cast<std::size_t>(j)].mid();
    return add(x);
  }
  std::size_t add(const Eigen::VectorXd& x) {
    constexpr std::size_t kNeighbours = 10;
    const std::size_t index = points_.size();
    std::vector<std::size_t> near(index);
    std::iota(near.begin(), near.end(), std::size_t{0});
    const std::size_t count = std::min(kNeighbours, index);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end(),
                      [&](std::size_t i, std::size_t j) { return (points_[i] - x).norm() < (points_[j] - x).norm(); });
    near.resize(count);
    points_.push_back(x);
    neighbours_.emplace_back();
    for (const std::size_t j : near)
      if (is_open(index, j, 0.03)) {
        neighbours_[index].push_back(j);
        neighbours_[j].push_back(index);
      }
    return index;
  }
  bool is_open(std::size_t i, std::size_t j, double step) const {
    const std::vector<int> signs = space_.state(points_[i]).signs;
    const auto accept = [&](const Eigen::VectorXd& x) {
      const PathSpace::State s = space_.state(x);
      return s.inside && s.signs == signs;
    };
    return space_.state(points_[j]).signs == signs && builder_.follow(points_[i], points_[j], step, accept).has_value();
  }

  const PathSpace& space_;
  const TubeBuilder& builder_;
  std::vector<Eigen::VectorXd> points_;
  std::vector<std::vector<std::size_t>> neighbours_;
};

struct Subject {
  std::string model;
  std::vector<RandomRange> ranges;
  Avoid avoid = Avoid::forward;
};

void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.model << " " << to_string(subject.avoid); }

class RandomPairs : public ::testing::TestWithParam<Subject> {};

// CORANK_PATH_PAIRS and CORANK_PATH_SAMPLES ask for more. Unknown are less than a fiftieth of all.
TEST_P(RandomPairs, GetATubeOrTheProofThatThereIsNone) {
  const int pairs = from_environment("CORANK_PATH_PAIRS", test::long_run() ? 8 : 3),
            samples = from_environment("CORANK_PATH_SAMPLES", 1000);
  PathFinder finder(model_of(GetParam().model), {.avoid = GetParam().avoid});
  const PathSpace space(model_of(GetParam().model), GetParam().avoid);
  const TubeBuilder builder(space);
  Flood flood(space, builder, test::long_run() ? 600 : 200, 7);
  RandomConfigurations configurations(finder, GetParam().ranges, 2025);
  std::map<std::string, int> counts;
  for (int k = 0; k < pairs; ++k) {
    solve::Control control;
    const Box from = configurations.draw(control), to = configurations.draw(control);
    const Path path = finder.find(from, to, control);
    ++counts[to_string(path.status)];
    if (path.status == Path::Status::separated) {
      if (path.resolution > 0) ++counts["separated by boxes"];
      EXPECT_FALSE(flood.joins(from, to)) << "pair " << k << ": " << path.reason;
    } else if (path.tube) {
      EXPECT_TRUE(samples_agree(space, *path.tube, samples)) << "pair " << k;
      const check::TubeReport report = check::check_tube(finder.system(), finder.matrices(), *path.tube);
      EXPECT_TRUE(report.verified()) << "pair " << k << ": " << (report.failures.empty() ? "" : report.failures.front());
      ++counts["by " + path.method];
    } else {
      std::string ends;
      for (const Box* box : {&from, &to})
        for (const CoordinateValue& v : coordinate_values(finder.system(), *box))
          ends += fmt::format("{}={:.6g},", v.name, v.value.mid());
      std::cout << "unknown, pair " << k << ": " << path.reason << "; " << ends << "\n";
    }
  }
  for (const auto& [word, count] : counts) std::cout << word << ": " << count << "\n";
  EXPECT_LE(50 * counts["unknown"], pairs);
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, RandomPairs,
                         ::testing::Values(Subject{"three_slider", {{"x_C", -0.8, 0.8}}},
                                           Subject{"dextar", {{"J3x", -0.6, 1.8}, {"J3y", -1.6, 1.6}}},
                                           Subject{"dextar", {{"J3x", -0.6, 1.8}, {"J3y", -1.6, 1.6}}, Avoid::both},
                                           Subject{"planar/four_bar_double_rocker", {{"theta", -3, 3}}, Avoid::both},
                                           Subject{"serial/orthogonal_3r_section",
                                                   {{"theta2", -3.1, 3.1}, {"theta3", -3.1, 3.1}},
                                                   Avoid::inverse}),
                         [](const auto& test) { return "Subject" + std::to_string(test.index); });

// A further coordinate chooses between the two configurations, whose J3y differ by a third of a link.
TEST(PathEnds, AreChosenByFurtherCoordinatesInEveryUnit) {
  for (const std::string unit : {"1/1000", "1", "1000"}) {
    study::Question dextar = model_of("dextar");
    dextar.model.set_constant("l", symbolic::parse_expression("9/10*" + unit));
    dextar.model.set_constant("d", symbolic::parse_expression("59/50*" + unit));
    const PathFinder finder(dextar, {});
    solve::Control control;
    const auto motors = values({{"theta2", "1.334"}, {"theta5", "2"}});
    EXPECT_EQ(finder.ends(motors, control).size(), 2U) << unit;
    for (const std::string y : {"1.019", "0.674"}) {
      auto chosen = motors;
      chosen.push_back(values({{"J3y", y + "*" + unit}}).front());
      EXPECT_EQ(finder.ends(chosen, control).size(), 1U) << unit;
    }
  }
}

TEST(PathEnds, AreSolvedForFromSomeOfTheirCoordinates) {
  const PathFinder finder(model_of("dextar"), {});
  solve::Control control;
  EXPECT_EQ(finder.ends(values({{"J3x", "1/2"}, {"J3y", "1"}}), control).size(), 4U);
  EXPECT_EQ(finder.ends(values({{"J3x", "1/2"}, {"J3y", "1"}, {"theta2", "1.334"}}), control).size(), 2U);
  EXPECT_EQ(finder.ends(values({{"J3x", "5"}, {"J3y", "1"}}), control).size(), 0U);
  EXPECT_THROW(finder.ends(values({{"J3x", "1/2"}}), control), EndError);
  EXPECT_THROW(finder.ends(values({{"J3x", "1/2"}, {"nothing", "1"}}), control), symbolic::ModelError);
  try {
    finder.end(values({{"J3x", "1/2"}, {"J3y", "1"}}), 0, "--from", control);
    FAIL();
  } catch (const EndError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--from-mode"));
    EXPECT_THAT(error.what(), HasSubstr("4: J3x=0.5"));
  }
}

TEST(Path, OfDextarKeepsItsLimits) {
  PathFinder finder(model_of("dextar_limits"), {});
  solve::Control control;
  const Box from = finder.end(values({{"theta2", "1.2"}, {"theta5", "1.8"}}), 1, "--from", control),
            to = finder.end(values({{"theta2", "2"}, {"theta5", "1.5"}}), 1, "--to", control);
  const Path path = finder.find(from, to, control);
  ASSERT_EQ(path.status, Path::Status::path);
  const PathSpace space(model_of("dextar_limits"), Avoid::forward);
  EXPECT_TRUE(samples_agree(space, *path.tube, 1000));
}

TEST(Path, HasTheRadiusThatIsAskedForWherePossible) {
  solve::Control control;
  const auto radius = [&](double asked) {
    PathFinder finder(model_of("dextar"), {.radius = asked});
    const Box from = finder.end(values({{"J3x", "0.5"}, {"J3y", "1"}}), 1, "--from", control),
              to = finder.end(values({{"J3x", "0.7"}, {"J3y", "1"}}), 3, "--to", control);
    const Path path = finder.find(from, to, control);
    return path.tube ? path.tube->radius() : 0;
  };
  EXPECT_GE(radius(0.08), 0.08);
  EXPECT_GT(radius(10), 0);  // nowhere, and there is a path all the same
}

// A path is found and proven in each unit; the size by which radii count for lengths scales.
TEST(Path, DoesNotDependOnTheUnitOfLength) {
  double pieces = 0, radius = 0, length = 0;
  std::vector<std::string> units{"1", "1/1000", "1000000"};
  if (test::long_run()) units.emplace_back("1000");
  for (const std::string& unit : units) {
    study::Question question = model_of("dextar");
    question.model.set_constant("l", symbolic::Expression("9/10*" + unit));
    question.model.set_constant("d", symbolic::Expression("59/50*" + unit));
    solve::Control control;
    PathFinder finder(question, {});
    const Box from = finder.end(values({{"J3x", "1/2*" + unit}, {"J3y", unit}}), 1, "--from", control),
              to = finder.end(values({{"J3x", "7/10*" + unit}, {"J3y", unit}}), 3, "--to", control);
    const Path path = finder.find(from, to, control);
    if (unit == "1") {
      ASSERT_EQ(path.status, Path::Status::path);
      pieces = static_cast<double>(path.tube->pieces.size());
      radius = path.tube->radius();
      length = length_size(finder.system(), *path.tube).value();
      continue;
    }
    ASSERT_EQ(path.status, Path::Status::path) << unit;
    EXPECT_NEAR(static_cast<double>(path.tube->pieces.size()), pieces, 0.02 * pieces) << unit;
    EXPECT_NEAR(path.tube->radius(), radius, 0.05 * radius) << unit;  // its pieces end at other doubles
    const double factor = unit == "1/1000" ? 1e-3 : std::stod(unit);
    EXPECT_NEAR(length_size(finder.system(), *path.tube).value(), length * factor, 1e-9 * length * factor) << unit;
    EXPECT_TRUE(check::check_tube(finder.system(), finder.matrices(), *path.tube).verified()) << unit;
  }
}

TEST(Path, IsShownAsJson) {
  PathFinder finder(model_of("three_slider"), {});
  solve::Control control;
  const Box from = finder.end(values({{"x_C", "0.3"}}), 1, "--from", control),
            to = finder.end(values({{"x_C", "0.5"}}), 1, "--to", control);
  const auto json = nlohmann::json::parse(to_json(finder, finder.find(from, to, control)));
  EXPECT_EQ(json["status"], "path");
  ASSERT_GE(json["waypoints"].size(), 2U);
  EXPECT_NEAR(json["waypoints"].front()["x_C"], 0.3, 1e-12);
  EXPECT_NEAR(json["waypoints"].back()["x_C"], 0.5, 1e-12);
  EXPECT_GT(json["radius"], 0.0);
}

// The text of a model with some of its words replaced.
study::Question changed(const std::string& name, const std::vector<std::pair<std::string, std::string>>& changes) {
  std::ifstream file(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik");
  std::stringstream text;
  text << file.rdbuf();
  std::string model = text.str();
  for (const auto& [from, to] : changes) {
    const std::size_t at = model.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    model.replace(at, from.size(), to);
  }
  // Of each test another: they may run at the same time.
  const std::string path =
      ::testing::TempDir() + "path_test_" + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".cuik";
  std::ofstream(path) << model;
  return {.model = study::read_model(path).mechanism};
}

// Between number `mode_a` of the configurations with the values a and number `mode_b` of those with b, by sampling.
void expect_a_tube(const study::Question& question, Avoid avoid, const std::vector<NamedValue>& a, int mode_a,
                   const std::vector<NamedValue>& b, int mode_b, std::size_t dimension) {
  PathFinder finder(question, {.avoid = avoid});
  const PathSpace space(question, avoid);
  ASSERT_EQ(static_cast<std::size_t>(space.dimension()), dimension);
  solve::Control control;
  const Box from = finder.end(a, mode_a, "--from", control), to = finder.end(b, mode_b, "--to", control);
  const Path path = finder.find(from, to, control);
  ASSERT_EQ(path.status, Path::Status::path) << path.reason;
  EXPECT_EQ(path.method, "sampling");
  EXPECT_TRUE(samples_agree(space, *path.tube, 2000));
  EXPECT_TRUE(check::check_tube(finder.system(), finder.matrices(), *path.tube).verified());
}

TEST(Path, OfAStewartPlatformIsATube) {
  const auto legs = [](const std::vector<std::string>& lengths) {
    std::vector<std::pair<std::string, std::string>> list;
    for (std::size_t k = 0; k < lengths.size(); ++k) list.emplace_back("leg" + std::to_string(k + 1), lengths[k]);
    return values(list);
  };
  expect_a_tube(changed("platforms/stewart", {{"   keeps Rz(yaw)*Ry(pitch)*Rx(roll)", ""}}), Avoid::forward,
                legs({"1.2", "1.3", "1.25", "1.3", "1.2", "1.3"}), 1, legs({"1.1", "1.0", "1.15", "1.1", "1.2", "1.1"}), 3,
                6);
}

TEST(Path, OfASixRevoluteArmIsATube) {
  const auto angles = [](const std::vector<std::string>& radians) {
    std::vector<std::pair<std::string, std::string>> list;
    for (std::size_t k = 0; k < radians.size(); ++k) list.emplace_back("theta" + std::to_string(k + 1), radians[k]);
    return values(list);
  };
  const auto free = [](const std::string& joint) {
    return std::pair<std::string, std::string>("  range [" + joint + ", " + joint + "]", "");
  };
  expect_a_tube(changed("serial/ur5", {free("t1"), free("t4"), free("t6")}), Avoid::inverse,
                angles({"0", "-1", "1", "0.5", "1", "0"}), 1, angles({"3", "-1.5", "2", "3", "1", "2"}), 1, 6);
}

}  // namespace
}  // namespace corank::analyze
