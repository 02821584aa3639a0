// Sets of degenerate solutions that are found before a search. Random systems with such a set planted:
//
//     (z − c) p(x) = 0,  (z − c) q(x) = 0   in (x1, x2, x3, z):
//
// the cube z = c of dimension 3, where 2 is expected, crossed by a surface over the curve p = q = 0, on which z is free.
// With x3 = e besides, dimensions are less by one: a square, crossed by lines.
#include "corank/solve/store/strata.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "corank/core/rounding.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/seeds.h"
#include "corank/tests/solve/same_cover.h"

namespace corank::solve {
namespace {

// p = x1 − a0 − a1 x2 − a2 x3², q = x2 − b0 − b1 x3 − b2 x3², all coefficients and c eighths.
struct CrossedCube {
  int c, a[3], b[3];
  std::optional<int> e{};  // x3 in eighths

  explicit CrossedCube(std::mt19937& random, bool square = false) {
    std::uniform_int_distribution<int> few(-2, 2), middle(-5, 5);
    c = middle(random);
    if (square) e = middle(random);
    for (int* coefficients : {a, b})
      for (int k = 0; k < 3; ++k) coefficients[k] = few(random);
  }
  double z() const { return c / 8.0; }
  double x3(double otherwise) const { return e ? *e / 8.0 : otherwise; }
  std::vector<double> on_curve(double x3, double at_z) const {
    const double x2 = (b[0] + b[1] * x3 + b[2] * x3 * x3) / 8;
    return {(a[0] + a[1] * x2 + a[2] * x3 * x3) / 8, x2, x3, at_z};
  }
  System system() const {
    SystemBuilder builder;
    const int x1 = builder.variable("x1", "-1", "1"), x2 = builder.variable("x2", "-1", "1"),
              x3 = builder.variable("x3", "-1", "1"), z = builder.variable("z", "-1", "1");
    const auto eighths = [](int k) { return std::to_string(k) + "/8"; };
    const auto of_64 = [](int k) { return std::to_string(k) + "/64"; };
    const auto add = [&](int first, int second, const int(&k)[3]) {  // (z − c)(first − k0 − k1·second − k2·x3²)
      builder.equation({{"1", {{first, 1}, {z, 1}}},
                        {eighths(-k[0]), {{z, 1}}},
                        {eighths(-k[1]), {{second, 1}, {z, 1}}},
                        {eighths(-k[2]), {{x3, 2}, {z, 1}}},
                        {eighths(-c), {{first, 1}}},
                        {of_64(c * k[0]), {}},
                        {of_64(c * k[1]), {{second, 1}}},
                        {of_64(c * k[2]), {{x3, 2}}}});
    };
    add(x1, x2, a);
    add(x2, x3, b);
    if (e) builder.equation({{"1", {{x3, 1}}}, {eighths(-*e), {}}});
    return builder.system();
  }
};

// Solutions that are in no box.
int lost(const CrossedCube& planted, const Cover& cover, std::mt19937& random) {
  const test::CoverLookup lookup(cover);
  std::uniform_real_distribution<double> side(-1, 1);
  int count = 0;
  for (int k = 0; k < 300; ++k) {
    count += !lookup.holds(std::vector<double>{side(random), side(random), planted.x3(side(random)), planted.z()}, 1e-12);
    count += !lookup.holds(planted.on_curve(planted.x3(side(random)), side(random)), 1e-12);
  }
  return count;
}

// Boxes that claim one solution for each value of their free variables where there are more.
int false_claims(const CrossedCube& planted, const Cover& cover) {
  int count = 0;
  for (const CoverBox& b : cover.boxes) {
    if (b.verdict != Verdict::regular && b.verdict != Verdict::boundary) continue;
    const auto inside = [&](std::size_t j, double v) { return v > b.box[j].lo() + 1e-12 && v < b.box[j].hi() - 1e-12; };
    bool crossed = false;  // by the surface
    for (int k = 0; k <= 64; ++k) {
      const double t = k / 64.0;
      const std::vector<double> p = planted.on_curve(planted.x3((1 - t) * b.box[2].lo() + t * b.box[2].hi()), 0);
      crossed = crossed || (inside(0, p[0]) && inside(1, p[1]) && (planted.e || inside(2, p[2])));
    }
    if (b.motion >= 0) {
      count += crossed || b.free != (planted.e ? std::vector<int>{0, 1} : std::vector<int>{0, 1, 2}) ||
               !b.box[3].contains(planted.z());
    } else {
      count += inside(3, planted.z());
    }
  }
  return count;
}

TEST(Strata, LargeSetsOfDegenerateSolutionsAreProvenInWideBoxesAndTheSearchEnds) {
  int systems = 0, losses = 0, falsehoods = 0, wide = 0;
  for (unsigned seed = 1; seed <= test::seeds(12); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const CrossedCube planted(random, seed % 3 == 0);
    Options options;
    options.sigma = kWhole;
    options.max_boxes = 100'000;
    const Cover cover = solve(planted.system(), options);
    ++systems;
    EXPECT_TRUE(cover.complete());
    losses += lost(planted, cover, random);
    falsehoods += false_claims(planted, cover);
    for (const CoverBox& b : cover.boxes) {
      if (b.verdict == Verdict::undecided) {
        EXPECT_TRUE(b.reason == Reason::degenerate_set || b.reason == Reason::degenerate_point);
      }
      // Without the tube a box waits until its sides are 1/20 of the domain's.
      wide += b.motion >= 0 && b.box[0].width() > 0.3 && b.box[1].width() > 0.3 && (planted.e || b.box[2].width() > 0.3);
    }
  }
  EXPECT_EQ(losses, 0);
  EXPECT_EQ(falsehoods, 0);
  EXPECT_GE(wide, systems);
}

TEST(Strata, ThreadsMakeTheSameCover) {
  std::mt19937 random(1);
  const System system = CrossedCube(random).system();
  const Cover one = solve_with(system, 0.2), three = solve_with(system, 0.2, 3);
  EXPECT_EQ(one.self_motions.size(), 1u);
  expect_same(one, three);
}

TEST(Strata, ATubeIsCutAtItsFacesAndNothingOfItIsOutside) {
  const UpwardRounding rounding;
  std::mt19937 random(1);
  const CrossedCube planted(random);
  Options options;
  Control control(limits_of(options));
  const Prepared prepared = prepare(planted.system(), options, control);
  const Problem problem = problem_with_strata(prepared, {});
  ASSERT_EQ(problem.strata.size(), 1u);
  EXPECT_EQ(problem.strata[0].dimension, 3);
  std::vector<Box> waiting{prepared.reduction.system.domain()};
  int inside = 0, outside = 0;
  while (!waiting.empty()) {
    ASSERT_LT(inside + outside + std::ssize(waiting), 20);
    Box x = std::move(waiting.back());
    waiting.pop_back();
    const TubePlace place = locate(problem.strata[0], problem.compiled, x);
    if (place.where != TubePlace::Where::across) {
      const Interval z = x[3];
      EXPECT_EQ(place.where == TubePlace::Where::inside, z.contains(planted.z())) << z;
      ++(place.where == TubePlace::Where::inside ? inside : outside);
      continue;
    }
    ASSERT_EQ(place.variable, 3);
    Box upper = x;
    upper[3] = Interval(place.at, x[3].hi());
    x[3] = Interval(x[3].lo(), place.at);
    waiting.push_back(std::move(x));
    waiting.push_back(std::move(upper));
  }
  EXPECT_EQ(inside, 1);
  EXPECT_EQ(outside, 2);
}

TEST(Strata, NoneAreSoughtForPoints) {
  Options options;
  Control control(limits_of(options));
  const Prepared prepared = prepare(circle_and_diagonal().system(), options, control);
  EXPECT_TRUE(problem_with_strata(prepared, {}).strata.empty());
}

}  // namespace
}  // namespace corank::solve
