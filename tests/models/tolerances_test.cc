// Sets of robots whose constants have tolerances: of each robot that may be meant, no point is lost, and a proven box holds
// exactly one solution for each robot and each value of its other free variables.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "corank/check/checker.h"
#include "corank/solve/search/solve.h"
#include "corank/study/question.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/models/closed_forms.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {
using symbolic::SingularitySet;

symbolic::Mechanism dextar(double tolerance) {
  auto model = symbolic::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik");
  for (const auto& [name, value] : {std::pair("l2", "0.9"), {"l3", "0.9"}, {"l4", "0.9"}, {"l5", "0.9"}, {"d", "1.18"}}) {
    const symbolic::Constant c = symbolic::parse_constant(name, value + (" +- " + std::to_string(tolerance)));
    model.set_constant(name, c.value, c.tolerance);
  }
  return model;
}

Cover solved_for_all(const System& system, const std::optional<double>& sigma = std::nullopt, bool proof = true) {
  solve::Options options;
  options.sigma = sigma;
  options.proof = proof;
  return solve::solve(system, options);
}

void expect_verified(const System& system, Cover cover, bool with_proof = true) {
  if (!with_proof) cover.proof.reset();
  const check::Report report = check::check(system, cover);
  for (std::size_t i = 0; i < report.failures.size() && i < 3; ++i)
    ADD_FAILURE() << report.failures[i].index << ": " << report.failures[i].reason;
  EXPECT_TRUE(with_proof ? report.complete() : report.verified());
}

// A five-bar like Dextar with links of its own.
struct FiveBar {
  double l2, l3, l4, l5, d;
  std::array<double, 10> configuration(test::Point j2, test::Point j3, test::Point j4) const {
    const test::Point e2 = (1 / l2) * (j2 - test::Point{d, 0}), e3 = (1 / l3) * (j3 - j2), e4 = (1 / l4) * (j4 - j3),
                      e5 = (1 / l5) * j4;
    return {j3.x, j3.y, e2.x, e2.y, e3.x, e3.y, e4.x, e4.y, e5.x, e5.y};
  }
  // J2, J3, J4 in a line, stretched or folded.
  std::vector<std::array<double, 10>> forward(int n) const {
    std::vector<std::array<double, 10>> result;
    for (int i = 0; i < n; ++i)
      for (const int sign : {-1, 1})
        for (const double k : {1.0, -1.0}) {
          const test::Point j4 = l5 * test::direction(0.01 + 2 * M_PI * i / n);
          const double apart = std::fabs(l4 + k * l3);
          const auto j2 = test::intersect_circles({d, 0}, l2, j4, apart, sign);
          if (!j2 || apart < 1e-6) continue;
          const double along = (k > 0 ? l4 : l4 > l3 ? l4 : -l4) / apart;  // of J2 − J4
          result.push_back(configuration(*j2, j4 + along * (*j2 - j4), j4));
        }
    return result;
  }
  // An arm straight or folded.
  std::vector<std::array<double, 10>> inverse(int n) const {
    std::vector<std::array<double, 10>> result;
    for (int i = 0; i < n; ++i)
      for (const int sign : {-1, 1})
        for (const double k : {1.0, -1.0}) {
          const test::Point e = test::direction(0.01 + 2 * M_PI * i / n), j1{d, 0};
          const test::Point right = j1 + (l2 + k * l3) * e, left = (l5 + k * l4) * e;
          if (const auto j4 = test::intersect_circles({0, 0}, l5, right, l4, sign))
            result.push_back(configuration(j1 + l2 * e, right, *j4));
          if (const auto j2 = test::intersect_circles(j1, l2, left, l3, sign))
            result.push_back(configuration(*j2, left, l5 * e));
        }
    return result;
  }
};

class ToleratedDextar : public testing::TestWithParam<std::tuple<SingularitySet, double>> {};

TEST_P(ToleratedDextar, HoldsTheSetOfEveryRobot) {
  const auto [set, tolerance] = GetParam();
  const System system = study::system({dextar(tolerance), set});
  ASSERT_EQ(system.parameters(), 5);
  ASSERT_EQ(system.dimension(), 1);
  const Cover cover = solved_for_all(system);
  ASSERT_TRUE(cover.complete());
  EXPECT_GT(cover.count(Verdict::regular), 100u);
  expect_verified(system, cover, set == SingularitySet::forward || test::long_run());  // the other proof takes a minute
  const test::CoverLookup lookup(cover);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> change(-tolerance, tolerance);
  std::size_t lost = 0, samples = 0;
  for (unsigned robot = 0; robot < test::seeds(100); ++robot) {
    const FiveBar bar{0.9 + change(random), 0.9 + change(random), 0.9 + change(random), 0.9 + change(random),
                      1.18 + change(random)};
    for (const auto& q : set == SingularitySet::forward ? bar.forward(20) : bar.inverse(20)) {
      std::vector<double> x(q.begin(), q.end());
      for (const double length : {bar.d, bar.l2, bar.l3, bar.l4, bar.l5}) x.push_back(length);
      ++samples;
      lost += !lookup.holds(x, test::kSampleTolerance);
    }
  }
  EXPECT_GT(samples, 1000u);
  EXPECT_EQ(lost, 0u);
}

INSTANTIATE_TEST_SUITE_P(Sets, ToleratedDextar,
                         testing::Combine(testing::Values(SingularitySet::forward, SingularitySet::inverse),
                                          testing::Values(0.0001, 0.001)));

TEST(Tolerances, LeaveEachPointOfEveryRobotIsolated) {
  const System system = study::system({dextar(0.001), SingularitySet::forward_inverse});
  ASSERT_EQ(system.dimension(), 0);
  const Cover cover = solved_for_all(system);
  ASSERT_TRUE(cover.complete());
  expect_verified(system, cover);
  EXPECT_EQ(cover.count(Verdict::isolated), cover.boxes.size());
  const Cover nominal = solve::solve(study::system({dextar(0), SingularitySet::forward_inverse}), {});
  EXPECT_EQ(cover.points.size(), nominal.points.size());
}

TEST(Tolerances, OfNothingAreExactConstants) {
  EXPECT_EQ(study::system({dextar(0), SingularitySet::forward}).parameters(), 0);
}

// Two graphs x = g(s, p) and a y that follows; they may cross for some values of p.
struct TwoGraphs {
  double a[2], b[2], c[2], p, tolerance;

  explicit TwoGraphs(std::mt19937& random) {
    std::uniform_int_distribution<int> number(-8, 8);
    for (int k = 0; k < 2; ++k) a[k] = number(random) / 8.0, b[k] = number(random) / 16.0, c[k] = number(random) / 8.0;
    p = number(random) / 8.0;
    tolerance = std::ldexp(1, -number(random) / 2 - 8);
  }
  double x(int k, double s, double q) const { return a[k] + b[k] * s * s + c[k] * q * (1 + s / 4); }
  double y(double x, double s, double q) const { return x * s / 4 - q * q / 8; }
  std::string text() const {
    const auto graph = [this](int k) {
      return "(x - (" + std::to_string(a[k]) + " + (" + std::to_string(b[k]) + ")*s^2 + (" + std::to_string(c[k]) +
             ")*p*(1 + s/4)))";
    };
    return "[CONSTANTS]\np := " + std::to_string(p) + " +- " + ExactNumber::dyadic(tolerance).text() +
           "\n[SYSTEM VARS]\ns : [-1, 1]\nx : [-4, 4]\ny : [-4, 4]\n[SYSTEM EQS]\n" + graph(0) + "*" + graph(1) +
           " = 0;\ny = x*s/4 - p^2/8;\n";
  }
};

TEST(Tolerances, ProvenBoxesHoldOneSolutionOfEachRobot) {
  std::size_t lost = 0, wrong = 0, counted = 0;
  for (unsigned seed = 0; seed < test::seeds(60); ++seed) {
    std::mt19937 random(seed);
    const TwoGraphs plan(random);
    const System system = study::system({symbolic::parse_model(plan.text(), "two graphs")});
    ASSERT_EQ(system.parameters(), 1);
    const bool is_verified = seed % 10 == 0;
    const Cover cover = solved_for_all(system, 0.25, is_verified);
    ASSERT_TRUE(cover.complete()) << plan.text();
    if (is_verified) expect_verified(system, cover);
    const int s = system.find("s"), x = system.find("x"), y = system.find("y"), p = system.find("p");
    const test::CoverLookup lookup(cover);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int sample = 0; sample < 50; ++sample)
      for (int k = 0; k < 2; ++k) {
        const double q = plan.p + plan.tolerance * unit(random), at = unit(random), value = plan.x(k, at, q);
        std::vector<double> point(4);
        point[s] = at, point[x] = value, point[y] = plan.y(value, at, q), point[p] = q;
        lost += !lookup.holds(point, 1e-9);
      }
    for (const CoverBox& box : cover.boxes) {
      if (box.verdict != Verdict::regular || std::ranges::find(box.free, s) == box.free.end()) continue;
      ASSERT_TRUE(std::ranges::find(box.free, p) != box.free.end() && box.box[p].contains(system.variables[p].domain));
      const Box& region = cover.regions[box.region];
      const double q = plan.p + plan.tolerance * unit(random),
                   at = box.box[s].mid() + 0.49 * box.box[s].width() * unit(random);
      int inside = 0;
      for (int k = 0; k < 2; ++k) {
        const double value = plan.x(k, at, q);
        inside += region[x].contains(value) && region[y].contains(plan.y(value, at, q));
      }
      const bool same = std::fabs(plan.x(0, at, q) - plan.x(1, at, q)) < 1e-12;
      ++counted;
      wrong += inside != 1 && !same;
    }
  }
  EXPECT_EQ(lost, 0u);
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(counted, 500u);
}

TEST(Tolerances, AreHeldToByTheChecker) {
  const System system = study::system({dextar(0.001), SingularitySet::forward});
  const Cover cover = solved_for_all(system, 0.1);
  const int l2 = system.find("l2");
  const auto first = std::ranges::find(cover.boxes, Verdict::regular, &CoverBox::verdict);
  ASSERT_NE(first, cover.boxes.end());
  const auto fault = [&](const auto& change) {
    Cover changed = cover;
    change(changed.boxes[first - cover.boxes.begin()]);
    return !check::check(system, changed).verified();
  };
  EXPECT_FALSE(fault([](CoverBox&) {}));
  EXPECT_TRUE(fault([&](CoverBox& b) { b.box[l2] = Interval(b.box[l2].lo(), b.box[l2].mid()); })) << "half of the robots";
  EXPECT_TRUE(fault([&](CoverBox& b) { std::erase(b.free, l2); }));
  EXPECT_TRUE(fault([&](CoverBox& b) { b.verdict = Verdict::isolated; }));
}

}  // namespace
}  // namespace corank
