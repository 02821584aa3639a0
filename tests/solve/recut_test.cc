// Covers whose sheets are whole, cut to boxes afterwards. Random surfaces with known points:
//
//     (x/a)² + (y/b)² + (z/c)² = 1,  t = x y − d z
//
// of which the reduction eliminates t; and curves and surfaces of the other tests.
#include "corank/solve/search/recut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>

#include "corank/check/checker.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/seeds.h"
#include "corank/tests/solve/same_cover.h"

namespace corank::solve {
namespace {

Cover cut_to(const System& system, Cover cover, Options options) {
  Control control;
  return recut(prepare(system, options, control), std::move(cover), control);
}

// Its half-axes and d are quarters.
struct Ellipsoid {
  int a, b, c, d;
  explicit Ellipsoid(std::mt19937& random) {
    std::uniform_int_distribution<int> axis(1, 6);
    a = axis(random), b = axis(random), c = axis(random), d = axis(random);
  }
  // The domain begins at x = -3/4: the surface reaches beyond it where a > 3.
  System system() const {
    SystemBuilder builder;
    const int x = builder.variable("x", "-3/4", "2"), y = builder.variable("y", "-2", "2"),
              z = builder.variable("z", "-2", "2"), t = builder.variable("t", "-9", "9");
    const auto inverse_square = [](int quarters) { return "16/" + std::to_string(quarters * quarters); };
    builder.equation(
        {{inverse_square(a), {{x, 2}}}, {inverse_square(b), {{y, 2}}}, {inverse_square(c), {{z, 2}}}, {"-1", {}}});
    builder.equation({{"1", {{t, 1}}}, {"-1", {{x, 1}, {y, 1}}}, {std::to_string(d) + "/4", {{z, 1}}}});
    return builder.system();
  }
  std::vector<double> at(double u, double v) const {
    const double x = a / 4.0 * std::cos(u) * std::cos(v), y = b / 4.0 * std::cos(u) * std::sin(v), z = c / 4.0 * std::sin(u);
    return {x, y, z, x * y - d / 4.0 * z};
  }
};

// Of random ellipsoids, found with the options: does what `cut` makes of their sheets hold this many planted points?
void expect_no_losses(const Options& options, int points, const std::function<Cover(const System&, const Cover&)>& cut) {
  int losses = 0;
  for (unsigned seed = 1; seed <= test::seeds(10); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Ellipsoid planted(random);
    const System system = planted.system();
    const Cover result = cut(system, solve(system, options));
    EXPECT_TRUE(check::check(system, result).verified());
    const test::CoverLookup lookup(result);
    std::uniform_real_distribution<double> angle(-4, 4);
    for (int k = 0; k < points; ++k) {
      const std::vector<double> point = planted.at(angle(random), angle(random));
      losses += point[0] > -0.75 && !lookup.holds(point, 1e-12);
    }
  }
  EXPECT_EQ(losses, 0);
}

TEST(Recut, LosesNothingAndClaimsNothingFalse) {
  expect_no_losses({.surfaces_whole = true}, 500, [parts = false](const System& system, const Cover& whole) mutable {
    EXPECT_TRUE(std::isinf(whole.sigma.length));
    parts = !parts;  // in every second one
    Cover cut = cut_to(system, whole, {.sigma = 0.1, .surfaces_whole = parts});
    EXPECT_TRUE(cut.complete());
    EXPECT_GT(cut.boxes.size(), 2 * whole.boxes.size());
    EXPECT_LE(test::widest_edge(cut, 4), 0.1);
    EXPECT_GE(cut.statistics.processed, whole.statistics.processed);
    return cut;
  });
}

// Of an ellipsoid's box, free in two of x, y, z, the number of solutions in it with these values.
int solutions(const Ellipsoid& e, const CoverBox& box, double u, double v) {
  const double axes[] = {e.a / 4.0, e.b / 4.0, e.c / 4.0};
  double point[] = {NAN, NAN, NAN};
  point[box.free[0]] = u, point[box.free[1]] = v;
  const int last = 3 - box.free[0] - box.free[1];
  double rest = 1;
  for (const int j : box.free) rest -= point[j] * point[j] / (axes[j] * axes[j]);
  int count = 0;
  for (const double sign : {-1.0, 1.0}) {
    point[last] = sign * axes[last] * std::sqrt(rest);
    const double t = point[0] * point[1] - e.d / 4.0 * point[2];
    count += box.box[last].contains(point[last]) && box.box[3].contains(t);
  }
  return count;
}

TEST(PartsOfSheets, HaveAtMostOneSolutionForEachValueAndOneForSome) {
  std::size_t parts = 0, whole = 0, narrow_parts = 0;
  int some = 0, twice = 0, none = 0;
  for (unsigned seed = 1; seed <= test::seeds(10); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Ellipsoid planted(random);
    const System system = planted.system();
    Options options{.surfaces_whole = true, .proof = true};
    if (seed % 2 == 0) options.sigma = 0.3;
    const Cover cover = solve(system, options);
    EXPECT_LE(test::widest_edge(cover, 4), options.sigma.value_or(HUGE_VAL));
    EXPECT_TRUE(check::check(system, cover).complete());
    for (const CoverBox& box : cover.boxes) {
      const bool spans = corank::spans(cover, box);
      if (options.sigma) {
        narrow_parts += !spans;
      } else {
        ++(spans ? whole : parts);
      }
      const Box& region = cover.regions[box.region];
      if (std::ranges::find(box.free, 3) != box.free.end()) continue;
      const auto value = [&](const Box& of, int k) {
        const Interval& side = of[box.free[k]];
        return std::uniform_real_distribution<double>(side.lo(), side.hi())(random);
      };
      for (int k = 0; k < 20; ++k) {
        const int here = solutions(planted, box, value(box.box, 0), value(box.box, 1));
        twice += here > 1;
        none += spans && box.verdict == Verdict::regular && here == 0;
        if (!spans) some += solutions(planted, box, value(region, 0), value(region, 1)) == 1;
      }
    }
    int losses = 0;
    const test::CoverLookup lookup(cover);
    std::uniform_real_distribution<double> angle(-4, 4);
    for (int k = 0; k < 500; ++k) {
      const std::vector<double> point = planted.at(angle(random), angle(random));
      losses += point[0] > -0.75 && !lookup.holds(point, 1e-12);
    }
    EXPECT_EQ(losses, 0);
  }
  EXPECT_EQ(twice, 0);
  EXPECT_EQ(none, 0);
  EXPECT_GT(some, 0);
  EXPECT_GT(parts, whole / 10);
  EXPECT_GT(narrow_parts, 0u);
}

TEST(Recut, TakesTheDefaultOfSigmaFromTheSet) {
  std::mt19937 random(3);
  const System system = Ellipsoid(random).system();
  const Cover whole = solve(system, {.surfaces_whole = true}), cut = cut_to(system, whole, {}), direct = solve(system, {});
  EXPECT_NEAR(cut.sigma.length, direct.sigma.length, 0.3 * direct.sigma.length);
  EXPECT_EQ(cut.wider_than_sigma, 0u);
  EXPECT_EQ(solve(system, {.sigma = 0.1, .surfaces_whole = true}).sigma.length, 0.1) << "an own sigma is kept";
}

// s = x₁ + … + x_n: the sheet is one box.
TEST(Recut, OfManyDimensionsMakesAsManyBoxesAsOfThree) {
  const auto boxes = [](int dimension) {
    SystemBuilder builder;
    std::vector<SystemBuilder::Term> sum;
    for (int k = 0; k < dimension; ++k) sum.push_back({"1", {{builder.variable("x" + std::to_string(k), "-1", "1"), 1}}});
    sum.push_back({"-1", {{builder.variable("s", "-9", "9"), 1}}});
    builder.equation(sum);
    const System system = builder.system();
    return cut_to(system, solve(system, {.surfaces_whole = true}), {}).boxes.size();
  };
  const std::size_t of_three = boxes(3);
  EXPECT_GT(of_three, 1000u);
  EXPECT_LT(boxes(4), 3 * of_three);
}

TEST(Recut, OfACurveThatIsCutAlreadyMakesNarrowerBoxes) {
  const System system = lemniscate();
  EXPECT_FALSE(cut_to(system, solve(system, {.proof = true}), {.sigma = 0.01, .proof = true}).proof);
  const Cover first = solve(system, {.surfaces_whole = true}), finer = cut_to(system, first, {.sigma = 0.002});
  EXPECT_TRUE(std::isfinite(first.sigma.length)) << "curves are cut";
  EXPECT_GT(finer.boxes.size(), 2 * first.boxes.size());
  EXPECT_EQ(finer.count(Verdict::undecided), first.count(Verdict::undecided));
  EXPECT_TRUE(check::check(system, finer).verified());
}

TEST(Recut, KeepsSelfMotions) {
  const System system = plane_and_line();
  const Cover whole = solve(system, {.sigma = kWhole}), cut = cut_to(system, whole, {.sigma = 0.1});
  ASSERT_EQ(whole.self_motions.size(), 1u);
  EXPECT_EQ(cut.self_motions.size(), 1u);
  const auto on_motion = [](const Cover& c) {
    return std::ranges::count_if(c.boxes, [](auto& b) { return b.motion >= 0; });
  };
  EXPECT_GT(on_motion(cut), 5 * on_motion(whole));
  EXPECT_TRUE(check::check(system, cut).verified());
}

TEST(Recut, RefusesTheCoverOfAnotherSystem) {
  std::mt19937 random(1);
  const System system = Ellipsoid(random).system();
  const Cover whole = solve(system, {.sigma = kWhole});
  EXPECT_THROW(cut_to(lemniscate(), whole, {.sigma = 0.1}), std::invalid_argument);
}

// What is not cut is pending, within the domain and in the order of the others.
TEST(Recut, EndsWithItsControlAndLosesNothing) {
  expect_no_losses({.sigma = kWhole}, 200, [](const System& system, const Cover& whole) {
    int glances = 0;
    Control control({.time = 1, .clock = [&] { return glances++ > 20 ? 1.05 : 0.0; }});
    Cover cut = recut(prepared_with(system, {.sigma = 0.01}), whole, control);
    EXPECT_GT(cut.count(Verdict::pending), 0u);
    return cut;
  });
}

}  // namespace
}  // namespace corank::solve
