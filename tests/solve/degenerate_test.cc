// Classic degenerate systems: singular points, multiple roots, touching and crossing sets. Their solutions are known in
// closed form, so every claim can be held against them; nothing may be lost, and what is singular must stay undecided.
#include "corank/tests/solve/cover_questions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "corank/tests/cover_lookup.h"
#include "corank/tests/seeds.h"

namespace corank::solve {
namespace {
using Point = std::vector<double>;

bool claims_one(const CoverBox& b) { return b.verdict == Verdict::regular || b.verdict == Verdict::isolated; }

// Every claim: for several values of its free variables, ends included, a box holds exactly one of the solutions that
// `solutions(box, values of the free variables)` lists. Boxes have every third of seven values, in turn; in a long run all.
using Solutions = std::function<std::vector<Point>(const CoverBox& box, const Point& at)>;
void expect_true_claims(const Cover& cover, const Solutions& solutions) {
  constexpr double kSlack = 1e-12;
  int boxes = 0;
  for (const CoverBox& b : cover.boxes) {
    if (!claims_one(b)) continue;
    for (int step = test::long_run() ? 0 : boxes++ % 3; step <= 6; step += test::long_run() ? 1 : 3) {
      Point at(b.box.size());
      for (std::size_t j = 0; j < at.size(); ++j) at[j] = b.box[j].mid();
      for (std::size_t k = 0; k < b.free.size(); ++k) {
        const Interval& side = b.box[static_cast<std::size_t>(b.free[k])];
        const double t = k == 0 ? step / 6.0 : (step * 5 % 7) / 6.0;
        at[static_cast<std::size_t>(b.free[k])] = (1 - t) * side.lo() + t * side.hi();
      }
      int surely = 0, perhaps = 0;
      for (const Point& p : solutions(b, at)) {
        bool inside = true, near = true;
        for (std::size_t j = 0; j < p.size(); ++j) {
          if (std::find(b.free.begin(), b.free.end(), static_cast<int>(j)) != b.free.end()) continue;
          inside = inside && p[j] >= b.box[j].lo() + kSlack && p[j] <= b.box[j].hi() - kSlack;
          near = near && p[j] >= b.box[j].lo() - kSlack && p[j] <= b.box[j].hi() + kSlack;
        }
        surely += inside, perhaps += near;
      }
      ASSERT_GE(perhaps, 1) << "a claim without a solution at " << b.box[0] << b.box[1] << " step " << step;
      ASSERT_LE(surely, 1) << "more than one solution in " << b.box[0] << b.box[1] << " step " << step;
    }
  }
}

// No box that makes a claim holds the point.
void expect_undecided_at(const test::CoverLookup& lookup, const Point& p) {
  EXPECT_TRUE(lookup.holds(p, 1e-15));
  lookup.for_each(p, 0, [&](const CoverBox& b) {
    bool inside = true;
    for (std::size_t j = 0; j < p.size() && inside; ++j) inside = b.box[j].strictly_contains(Interval(p[j]));
    if (inside) {
      EXPECT_EQ(b.verdict, Verdict::undecided) << b.box[0] << b.box[1];
    }
  });
}

// a (x − p)² + b (y − q)² = c (z − r)², at random places: the surroundings of the apex are one box.
TEST(Degenerate, AnApexIsOneUndecidedBox) {
  for (unsigned seed = 0; seed < test::seeds(6); ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](int n) { return static_cast<int>(random() % n); };
    SystemBuilder builder;
    std::vector<SystemBuilder::Term> terms;
    Point apex;
    int constant = 0;
    for (const char* const name : {"x", "y", "z"}) {
      const int variable = builder.variable(name, "-1", "1"), sixteenths = below(21) - 10;
      const int weight = (1 + below(4)) * (apex.size() == 2 ? -1 : 1);
      terms.push_back({std::to_string(256 * weight), {{variable, 2}}});
      terms.push_back({std::to_string(-32 * weight * sixteenths), {{variable, 1}}});
      constant += weight * sixteenths * sixteenths;
      apex.push_back(sixteenths / 16.0);
    }
    terms.push_back({std::to_string(constant), {}});
    builder.equation(terms);
    const Cover cover = solve_with(builder.system(), 0.1);
    EXPECT_TRUE(cover.complete());
    EXPECT_EQ(cover.count(Verdict::undecided), 1u) << "seed " << seed;
    expect_undecided_at(test::CoverLookup(cover), apex);
    for (const CoverBox& box : cover.boxes)
      for (const Interval& side : box.box) EXPECT_TRUE(box.verdict != Verdict::undecided || side.width() < 0.04) << seed;
  }
}

TEST(Degenerate, TheAxesCrossAndNothingIsLostNearTheOrigin) {
  // x₁x₂ = 0, also where the domain's middle is nowhere near the crossing.
  for (const char* const upper : {"1", "3/2", "7"}) {
    SystemBuilder b;
    const int x = b.variable("x1", "-1", upper), y = b.variable("x2", "-1", upper);
    b.equation({{"1", {{x, 1}, {y, 1}}}});
    const Cover cover = solve_with(b.system(), 0.01);
    const test::CoverLookup lookup(cover);
    EXPECT_TRUE(cover.complete());
    for (int k = 0; k <= 1200; ++k) {
      const double t = std::pow(10, -k / 100.0);  // to 1e-12
      for (const double u : {t, -t}) {
        ASSERT_TRUE(covers(cover, {u, 0})) << u;
        ASSERT_TRUE(covers(cover, {0, u})) << u;
      }
    }
    ASSERT_TRUE(covers(cover, {0, 0}));
    for (const double t : {1e-300, std::numeric_limits<double>::denorm_min()})
      ASSERT_TRUE(covers(cover, {t, 0}) && covers(cover, {0, -t}));
    expect_undecided_at(lookup, {0, 0});
    EXPECT_GT(cover.count(Verdict::regular), 100u);
    expect_true_claims(cover, [](const CoverBox& box, const Point& at) {
      return box.free.at(0) == 0 ? std::vector<Point>{{at[0], 0}} : std::vector<Point>{{0, at[1]}};
    });
  }
}

TEST(Degenerate, ACrossingThatMeetsNoAxisLosesNothingDownToRounding) {
  // The same lines turned: (3x + 4y − 1/7)(4x − 3y + 1/11) = 0; in coordinates (u, v) along them the set is uv = 0.
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"12", {{x, 2}}},
              {"7", {{x, 1}, {y, 1}}},
              {"-12", {{y, 2}}},
              {"-23/77", {{x, 1}}},  // 3/11 − 4/7
              {"61/77", {{y, 1}}},   // 4/11 + 3/7
              {"-1/77", {}}});
  const double cx = (3.0 / 7 - 4.0 / 11) / 25, cy = (4.0 / 7 + 3.0 / 11) / 25;  // the crossing
  const Cover cover = solve_with(b.system(), 0.01);
  const test::CoverLookup lookup(cover);
  EXPECT_TRUE(cover.complete());
  for (int k = 0; k <= 1200; ++k) {
    const double t = 0.7 * std::pow(10, -k / 100.0);
    for (const double u : {t, -t}) {
      ASSERT_TRUE(lookup.holds(Point{cx + 0.8 * u, cy - 0.6 * u}, 1e-15)) << u;
      ASSERT_TRUE(lookup.holds(Point{cx + 0.6 * u, cy + 0.8 * u}, 1e-15)) << u;
    }
  }
  expect_undecided_at(lookup, {cx, cy});
  EXPECT_GT(cover.count(Verdict::regular), 100u);
  expect_true_claims(cover, [](const CoverBox& box, const Point& at) {
    const double u = at[0], v = at[1];
    if (box.free.at(0) == 0) return std::vector<Point>{{u, (1.0 / 7 - 3 * u) / 4}, {u, (1.0 / 11 + 4 * u) / 3}};
    return std::vector<Point>{{(1.0 / 7 - 4 * v) / 3, v}, {(3 * v - 1.0 / 11) / 4, v}};
  });
}

TEST(Degenerate, ATripleRootIsNeverClaimed) {
  // (x − 1/3)³ (x + 1/2) = 0: a triple root beside a simple one.
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2");
  b.equation({{"1", {{x, 4}}}, {"-1/2", {{x, 3}}}, {"-1/6", {{x, 2}}}, {"7/54", {{x, 1}}}, {"-1/54", {}}});
  for (const double sigma : {1e-3, 1e-6}) {  // 1e-6 is less than double arithmetic resolves there: a cloud of boxes
    const Cover cover = solve_with(b.system(), sigma);
    const test::CoverLookup lookup(cover);
    EXPECT_TRUE(cover.complete());
    EXPECT_EQ(cover.count(Verdict::isolated), 1u);
    EXPECT_TRUE(lookup.holds(Point{1.0 / 3}, 1e-16));
    EXPECT_TRUE(sigma < 1e-3 || cover.points.size() == 2);
    for (const CoverBox& box : cover.boxes) {
      EXPECT_TRUE(box.verdict == Verdict::undecided || box.box[0].contains(-0.5)) << box.box[0];
      EXPECT_NEAR(box.box[0].mid(), box.verdict == Verdict::undecided ? 1.0 / 3 : -0.5, 10 * sigma + 1e-4);
    }
  }
}

TEST(Degenerate, AClusterOfRootsIsNeverTakenForOne) {
  // Five roots 10⁻⁴ apart about 1/3, too near for double arithmetic: a box may hold them all, but no claim may.
  std::vector<ExactNumber> c{1};
  for (int k = -2; k <= 2; ++k) {
    const ExactNumber root = ExactNumber::rational("1/3") + ExactNumber(k) * ExactNumber::rational("1e-4");
    std::vector<ExactNumber> next(c.size() + 1);
    for (std::size_t i = 0; i < c.size(); ++i) next[i + 1] = next[i + 1] + c[i], next[i] = next[i] - c[i] * root;
    c = next;
  }
  SystemBuilder b;
  b.variable("x", "-1", "1");
  System system = b.system();
  Polynomial p;
  for (std::size_t i = 0; i < c.size(); ++i)
    p.monomials.emplace_back(c[i], i == 0 ? std::vector<Factor>{} : std::vector<Factor>{{0, static_cast<int>(i)}});
  system.equations.push_back(p);
  for (const double sigma : {0.01, 1e-5, 1e-6}) {
    const Cover cover = solve_with(system, sigma);
    const test::CoverLookup lookup(cover);
    EXPECT_TRUE(cover.complete());
    for (int k = -2; k <= 2; ++k) EXPECT_TRUE(lookup.holds(Point{1.0 / 3 + k * 1e-4}, 1e-15)) << sigma;
    for (const CoverBox& point : cover.points) {
      int roots = 0;
      for (int k = -2; k <= 2; ++k) roots += point.box[0].contains(1.0 / 3 + k * 1e-4);
      EXPECT_TRUE(point.verdict != Verdict::isolated || roots == 1) << point.box[0];
    }
    EXPECT_LE(cover.count(Verdict::isolated), 5u);
  }
}

TEST(Degenerate, ACuspStaysUndecidedAndItsBranchesAreProven) {
  // y² = x³.
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{y, 2}}}, {"-1", {{x, 3}}}});
  const Cover cover = solve_with(b.system(), 0.01);
  const test::CoverLookup lookup(cover);
  EXPECT_TRUE(cover.complete());
  for (int k = 0; k <= 1200; ++k) {
    const double t = std::pow(10, -k / 200.0);
    for (const double u : {t, -t}) ASSERT_TRUE(lookup.holds(Point{u * u, u * u * u}, 1e-16)) << u;
  }
  expect_undecided_at(lookup, {0, 0});
  EXPECT_GT(cover.count(Verdict::regular), 100u);
  expect_true_claims(cover, [](const CoverBox& box, const Point& at) {
    if (box.free.at(0) == 1) return std::vector<Point>{{std::cbrt(at[1] * at[1]), at[1]}};
    if (at[0] < 0) return std::vector<Point>{};
    return std::vector<Point>{{at[0], std::pow(at[0], 1.5)}, {at[0], -std::pow(at[0], 1.5)}};
  });
}

TEST(Degenerate, CirclesThatTouchOffTheAxesStayUndecidedThere) {
  // About the origin and about (6/5, 8/5), radii 1: they touch at (3/5, 4/5).
  SystemBuilder b;
  const int x = b.variable("x", "-4", "4"), y = b.variable("y", "-4", "4");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-12/5", {{x, 1}}}, {"-16/5", {{y, 1}}}, {"3", {}}});
  for (const double sigma : {1e-2, 1e-6}) {
    const Cover cover = solve_with(b.system(), sigma);
    const test::CoverLookup lookup(cover);
    EXPECT_TRUE(cover.complete());
    EXPECT_EQ(cover.count(Verdict::isolated), 0u);
    ASSERT_EQ(cover.points.size(), 1u);
    EXPECT_TRUE(lookup.holds(Point{0.6, 0.8}, 1e-15));
  }
}

TEST(Degenerate, WhitneysUmbrellaIsProvenAwayFromItsHandle) {
  // x² = y²z: the z axis is singular, a line of double points for z > 0 and a bare line for z < 0.
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1"), z = b.variable("z", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"-1", {{y, 2}, {z, 1}}}});
  const Cover cover = solve_with(b.system(), 0.2);
  EXPECT_TRUE(cover.complete());
  // 408,146 where the gradient of an equation alone is never called small.
  EXPECT_LT(cover.statistics.processed, 20'000u);
  const test::CoverLookup lookup(cover);
  for (int i = -20; i <= 20; ++i)
    for (int k = -20; k <= 20; ++k) {
      const double u = i / 20.0, v = k / 20.0;
      ASSERT_TRUE(lookup.holds(Point{u * v, u, v * v}, 1e-15)) << u << ' ' << v;
    }
  for (int k = -40; k <= 40; ++k) expect_undecided_at(lookup, {0, 0, k / 40.0});
  EXPECT_GT(cover.count(Verdict::regular), 100u);
  expect_true_claims(cover, [](const CoverBox& box, const Point& at) {
    const double u = at[0], v = at[1], w = at[2];
    if (box.free == std::vector<int>{0, 1}) return std::vector<Point>{{u, v, u * u / (v * v)}};
    if (box.free == std::vector<int>{0, 2}) return std::vector<Point>{{u, u / std::sqrt(w), w}, {u, -u / std::sqrt(w), w}};
    return std::vector<Point>{{v * std::sqrt(w), v, w}, {-v * std::sqrt(w), v, w}};
  });
}

TEST(Degenerate, SolidsThatCrossAlongASurfaceAreProvenAwayFromIt) {
  // w (w − x + 13/10 + yz/2) = 0 in two corners of the domain: beside the crossing proofs are as narrow as their distance.
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1"), z = b.variable("z", "-1", "1"),
            w = b.variable("w", "-1", "1");
  b.equation({{"1", {{w, 2}}}, {"-1", {{w, 1}, {x, 1}}}, {"13/10", {{w, 1}}}, {"1/2", {{w, 1}, {y, 1}, {z, 1}}}});
  Options options;
  options.sigma = 2;
  options.max_boxes = 400'000;
  const Cover cover = solve(b.system(), options);
  ASSERT_TRUE(cover.complete());
  EXPECT_GT(cover.count(Verdict::regular), 1000u);
  EXPECT_GT(cover.count(Verdict::undecided), 0u);
  const test::CoverLookup lookup(cover);
  int crossings = 0;
  for (int i = -10; i <= 10; ++i)
    for (int j = -10; j <= 10; ++j)
      for (int k = -10; k <= 10; ++k) {
        const double u = i / 10.0, v = j / 10.0, t = k / 10.0, other = u - 1.3 - v * t / 2;
        EXPECT_TRUE(lookup.holds(Point{u, v, t, 0}, 1e-15));
        EXPECT_TRUE(other < -1 || lookup.holds(Point{u, v, t, other}, 1e-15));
        if (std::fabs(other) < 1e-9) expect_undecided_at(lookup, {u, v, t, 0}), ++crossings;
      }
  EXPECT_GT(crossings, 0);
}

TEST(Degenerate, SpheresThatTouchAreUndecidedAtTheirPointAndAtNoOther) {
  // |p|² = 1 and |p − (4/3, 4/3, 2/3)|² = 1 touch at (2/3, 2/3, 1/3). A plane through that point
  // leaves it a point.
  SystemBuilder b;
  const int x = b.variable("x", "-3", "3"), y = b.variable("y", "-3", "3"), z = b.variable("z", "-3", "3");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"1", {{z, 2}}}, {"-1", {}}});
  b.equation({{"1", {{x, 2}}},
              {"1", {{y, 2}}},
              {"1", {{z, 2}}},
              {"-8/3", {{x, 1}}},
              {"-8/3", {{y, 1}}},
              {"-4/3", {{z, 1}}},
              {"3", {}}});
  Options options;
  options.sigma = 0.01;
  options.max_boxes = 200'000;
  const auto near_touch = [](const CoverBox& box, double distance) {
    for (const auto& [j, at] : {std::pair{0, 2.0 / 3}, {1, 2.0 / 3}, {2, 1.0 / 3}})
      if (std::fabs(box.box[static_cast<std::size_t>(j)].mid() - at) > distance) return false;
    return true;
  };
  const Cover curve = solve(b.system(), options);  // expected to be a curve, is a point
  EXPECT_TRUE(curve.complete());
  EXPECT_TRUE(test::CoverLookup(curve).holds(Point{2.0 / 3, 2.0 / 3, 1.0 / 3}, 1e-15));
  for (const CoverBox& box : curve.boxes) {
    EXPECT_EQ(box.verdict, Verdict::undecided);
    EXPECT_TRUE(near_touch(box, 0.2)) << box.box[0] << box.box[1] << box.box[2];
  }
  b.equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  const Cover point = solve(b.system(), options);
  EXPECT_TRUE(point.complete());
  EXPECT_EQ(point.count(Verdict::isolated), 0u);
  ASSERT_EQ(point.points.size(), 1u);
  EXPECT_TRUE(test::CoverLookup(point).holds(Point{2.0 / 3, 2.0 / 3, 1.0 / 3}, 1e-15));
}

TEST(Degenerate, TwoSpheresAndTheirRadicalPlaneAreOneCircle) {
  // |p|² = 1, |p − (1, 0, 0)|² = 1 and x = 1/2, which follows: a circle of radius √3/2 from three equations, none of them
  // independent.
  SystemBuilder b;
  const int x = b.variable("x", "-3", "3"), y = b.variable("y", "-3", "3"), z = b.variable("z", "-3", "3");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"1", {{z, 2}}}, {"-1", {}}});
  b.equation({{"1", {{x, 2}}}, {"-2", {{x, 1}}}, {"1", {{y, 2}}}, {"1", {{z, 2}}}});
  b.equation({{"2", {{x, 1}}}, {"-1", {}}});
  const Cover cover = solve_with(b.system(), 0.02);
  const test::CoverLookup lookup(cover);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.count(Verdict::isolated), 0u) << "no point of a circle is isolated";
  for (int k = 0; k < 720; ++k) {
    const double t = k * std::numbers::pi / 360, r = std::sqrt(0.75);
    ASSERT_TRUE(lookup.holds(Point{0.5, r * std::cos(t), r * std::sin(t)}, 1e-15)) << k;
  }
  for (const CoverBox& box : cover.boxes) EXPECT_NEAR(std::hypot(box.box[1].mid(), box.box[2].mid()), std::sqrt(0.75), 0.04);
}

}  // namespace
}  // namespace corank::solve
