// Covers of systems whose solutions are known.
#include "corank/tests/solve/cover_questions.h"

#include <gtest/gtest.h>

#include <xmmintrin.h>

#include <cfenv>
#include <cmath>
#include <random>

namespace corank::solve {
namespace {

// The product of the lines x + 2y = 1/3 and 3x − y = 1/7: they cross at an angle to the axes.
SystemBuilder crossing_lines() {
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation(
      {{"3", {{x, 2}}}, {"5", {{x, 1}, {y, 1}}}, {"-2", {{y, 2}}}, {"-8/7", {{x, 1}}}, {"1/21", {{y, 1}}}, {"1/21", {}}});
  return b;
}

TEST(Solve, FindsAndProvesBothPointsOfACircleAndALine) {
  const Cover cover = solve_with(circle_and_diagonal().system(), 1e-6);
  EXPECT_TRUE(cover.complete());
  ASSERT_EQ(cover.points.size(), 2u);
  for (const auto& p : cover.points) {
    EXPECT_EQ(p.verdict, Verdict::isolated);
    EXPECT_NEAR(std::fabs(p.box[0].mid()), std::sqrt(0.5), 1e-12);
    EXPECT_LE(p.box[0].width(), 1e-12);
  }
}

TEST(Solve, SaysThatAnEmptySetIsEmpty) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}}).equation({{"1", {{x, 1}}}, {"1", {{y, 1}}}, {"-3/2", {}}});
  const Cover cover = solve_with(b.system(), 1e-3);
  EXPECT_TRUE(cover.complete());
  EXPECT_TRUE(cover.boxes.empty());
}

TEST(Solve, CountsASolutionOnTheFirstBisectionPlaneOnce) {
  // The plane x = 0.47·4 − 2 = −0.12 of the first cut, and others: no solution is counted twice wherever it lies.
  for (int k = -40; k <= 40; ++k) {
    SystemBuilder b;
    const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
    b.equation({{"1", {{x, 1}}}, {std::to_string(-3 * k) + "/100", {}}});
    b.equation({{"1", {{y, 2}}}, {"-0.0144", {}}});  // y = ±0.12
    if (std::abs(3 * k) > 199) continue;
    const Cover cover = solve_with(b.system(), 1e-6);
    ASSERT_EQ(cover.points.size(), 2u) << k;
    ASSERT_EQ(cover.count(Verdict::isolated), 2u) << k;
  }
}

TEST(Solve, LosesNothingWhereLinesCross) {
  const Cover cover = solve_with(crossing_lines().system(), 0.01);
  EXPECT_TRUE(cover.complete());
  EXPECT_LE(widest(cover), 0.01);
  for (int k = -1000; k <= 1000; ++k) {
    const double t = k / 1000.0;
    const double x = 1.0 / 3 - 2 * t;  // rounded: the exact point lies between x's neighbours
    if (std::fabs(x) > 0.999) continue;
    EXPECT_TRUE(covers(cover, {x, t}) || covers(cover, {std::nextafter(x, 2), t}) ||
                covers(cover, {std::nextafter(x, -2), t}))
        << t;
  }
  // Only boxes next to the crossing (13/147, 6/49) may be undecided.
  for (const auto& b : cover.boxes)
    if (b.verdict == Verdict::undecided) {
      EXPECT_NEAR(b.box[0].mid(), 13.0 / 147, 0.1);
      EXPECT_NEAR(b.box[1].mid(), 6.0 / 49, 0.1);
    }
  EXPECT_GT(cover.count(Verdict::undecided), 0u);
  EXPECT_GT(cover.count(Verdict::regular), 100u);
}

TEST(Solve, LeavesADoublePointUndecided) {
  // Circles that touch at (1, 0): x² + y² = 1 and (x − 2)² + y² = 1.
  SystemBuilder b;
  const int x = b.variable("x", "-4", "4"), y = b.variable("y", "-4", "4");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
  b.equation({{"1", {{x, 2}}}, {"-4", {{x, 1}}}, {"1", {{y, 2}}}, {"3", {}}});
  const Cover cover = solve_with(b.system(), 1e-4);
  EXPECT_TRUE(cover.complete());
  ASSERT_EQ(cover.points.size(), 1u);
  EXPECT_EQ(cover.points[0].verdict, Verdict::undecided);
  EXPECT_TRUE(covers(cover, {1.0, 0.0}));
}

TEST(Solve, MakesNoFalseClaimOnGriewankAndOsborne) {
  // 29/16 x³ − 2xy = 0, y − x² = 0: a triple root at the origin where Newton's method diverges.
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"29/16", {{x, 3}}}, {"-2", {{x, 1}, {y, 1}}}}).equation({{"1", {{y, 1}}}, {"-1", {{x, 2}}}});
  const Cover cover = solve_with(b.system(), 1e-5);
  EXPECT_EQ(cover.count(Verdict::isolated), 0u);
  ASSERT_EQ(cover.points.size(), 1u);
  EXPECT_TRUE(cover.points[0].box[0].contains(0.0) && cover.points[0].box[1].contains(0.0));
}

TEST(Solve, SeparatesTheRootsOfAWilkinsonPolynomial) {
  // Π_{k=1}^{8} (x − k/10), expanded in exact arithmetic.
  std::vector<ExactNumber> c{1};
  for (int k = 1; k <= 8; ++k) {
    std::vector<ExactNumber> next(c.size() + 1);
    for (std::size_t i = 0; i < c.size(); ++i) {
      next[i + 1] = next[i + 1] + c[i];
      next[i] = next[i] - c[i] * ExactNumber(k) / ExactNumber(10);
    }
    c = next;
  }
  SystemBuilder b;
  b.variable("x", "-3", "3");
  System system = b.system();
  Polynomial p;
  for (std::size_t i = 0; i < c.size(); ++i)
    p.monomials.emplace_back(c[i], i == 0 ? std::vector<Factor>{} : std::vector<Factor>{{0, static_cast<int>(i)}});
  system.equations.push_back(p);
  const Cover cover = solve_with(system, 1e-6);
  EXPECT_TRUE(cover.complete());
  ASSERT_EQ(cover.count(Verdict::isolated), 8u);
  ASSERT_EQ(cover.points.size(), 8u);
  for (int k = 1; k <= 8; ++k) EXPECT_NEAR(cover.points[static_cast<std::size_t>(k - 1)].box[0].mid(), k / 10.0, 1e-9);
}

TEST(Solve, CoversATorusWithRegularBoxesNoWiderThanSigma) {
  const Cover cover = solve_with(torus().system(), 0.25);
  EXPECT_TRUE(cover.complete());
  EXPECT_LE(widest(cover), 0.25);
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
  EXPECT_GT(cover.count(Verdict::regular), 300u);
  const auto near = [&](double u, double v) {  // a point computed with rounding errors may lie just outside a box
    const double r = 1 + 0.5 * std::cos(v), p[3] = {r * std::cos(u), r * std::sin(u), 0.5 * std::sin(v)};
    for (const auto& b : cover.boxes) {
      bool inside = true;
      for (int j = 0; j < 3 && inside; ++j) inside = p[j] >= b.box[j].lo() - 1e-12 && p[j] <= b.box[j].hi() + 1e-12;
      if (inside) return true;
    }
    return false;
  };
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 60; ++k) ASSERT_TRUE(near(0.0628 * i, 0.105 * k)) << i << ' ' << k;
}

TEST(Solve, CutsASheetAlongManyFreeVariables) {
  // 2y² = 2 + Σ x_j²/8 with six free x_j in [0, 1]: three parts along each.
  SystemBuilder b;
  std::vector<SystemBuilder::Term> terms{{"-2", {}}};
  for (int j = 0; j < 6; ++j) terms.push_back({"-1/8", {{b.variable("x" + std::to_string(j), "0", "1"), 2}}});
  const int y = b.variable("y", "1", "2");
  terms.push_back({"2", {{y, 2}}});
  const Cover cover = solve_with(b.equation(terms).system(), 0.4);
  EXPECT_TRUE(cover.complete());
  EXPECT_LE(widest(cover), 0.4);
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
  EXPECT_GE(cover.boxes.size(), 729u);
  EXPECT_LE(cover.boxes.size(), 4096u);
  double volume = 0;
  for (const auto& box : cover.boxes) {
    double v = 1;
    for (int j = 0; j < 6; ++j) v *= box.box[j].width();
    volume += v;
  }
  EXPECT_NEAR(volume, 1, 1e-9) << "neither gaps nor overlaps in the free variables";
}

TEST(Solve, MarksPiecesThatLeaveTheDomainOrAnInequality) {
  // y = x on [0, 1]², x ≥ 1/2: the piece at x = 1/2 crosses the inequality, no other does.
  SystemBuilder b;
  const int x = b.variable("x", "0", "1"), y = b.variable("y", "0", "1");
  b.equation({{"1", {{y, 1}}}, {"-1", {{x, 1}}}, {"-1/100", {{x, 1}, {y, 1}}}});
  b.at_least_zero({{"1", {{x, 1}}}, {"-1/2", {}}});
  const Cover cover = solve_with(b.system(), 0.05);
  EXPECT_GT(cover.count(Verdict::boundary), 0u);
  for (const auto& box : cover.boxes) {
    const bool cut = box.box[x].lo() < 0.5 || !Interval(0, 1).contains(box.box[y]);
    EXPECT_EQ(box.verdict, cut ? Verdict::boundary : Verdict::regular) << box.box[x] << box.box[y];
  }
}

TEST(Solve, GivesTheSameSortedResultForAnyNumberOfThreads) {
  for (const System& system : {torus().system(), crossing_lines().system(), circle_and_diagonal().system()}) {
    const Cover one = solve_with(system, 0.05, 1), two = solve_with(system, 0.05, 2), five = solve_with(system, 0.05, 5);
    for (const Cover& other : {two, five}) {
      ASSERT_EQ(one.boxes.size(), other.boxes.size());
      for (std::size_t k = 0; k < one.boxes.size(); ++k) {
        ASSERT_EQ(one.boxes[k].verdict, other.boxes[k].verdict);
        ASSERT_EQ(one.boxes[k].box, other.boxes[k].box);
        ASSERT_EQ(one.boxes[k].free, other.boxes[k].free);
      }
      EXPECT_EQ(one.statistics.processed, other.statistics.processed);
    }
  }
}

TEST(Solve, RecordsTheSameProofForAnyNumberOfThreads) {
  const auto recorded = [](int threads) {
    Options options;
    options.sigma = 0.05;
    options.threads = threads;
    options.proof = true;
    return solve(torus().system(), options);
  };
  const Cover one = recorded(1), four = recorded(4);
  ASSERT_TRUE(one.proof && four.proof);
  EXPECT_EQ(one.regions, four.regions);
  EXPECT_EQ(one.proof->combinations, four.proof->combinations);
  EXPECT_EQ(one.proof->steps, four.proof->steps);
  EXPECT_EQ(one.proof->integers, four.proof->integers);
  EXPECT_EQ(one.proof->reals, four.proof->reals);
}

TEST(Solve, KeepsSubnormalNumbersWhateverTheCallersMode) {
  // y = 1e-160·x at x = 1e-200: y = 1e-360 lies in no box [0, 0].
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 1}}}, {"-1e-200", {}}}).equation({{"1", {{y, 1}}}, {"-1e-160", {{x, 1}}}});
  const unsigned former = _mm_getcsr();
  _mm_setcsr(former | 0x8040);  // flush to zero, denormals are zero
  const Cover cover = solve_with(b.system(), 1e-6);
  const unsigned after = _mm_getcsr();
  _mm_setcsr(former);
  EXPECT_EQ(after & ~0x3fu, (former | 0x8040) & ~0x3fu) << "restored";
  ASSERT_EQ(cover.points.size(), 1u);
  EXPECT_GT(cover.points[0].box[y].hi(), 0);
}

TEST(Solve, ProvesWhatTheReductionAloneSolves) {
  // 2x = 1, x + y = 2, and z in [0, 1] that no equation mentions.
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-2", "2");
  b.equation({{"2", {{x, 1}}}, {"-1", {}}}).equation({{"1", {{x, 1}}}, {"1", {{y, 1}}}, {"-2", {}}});
  const Cover point = solve_with(b.system(), 1e-6);
  ASSERT_EQ(point.points.size(), 1u);
  EXPECT_EQ(point.points[0].verdict, Verdict::isolated);
  EXPECT_TRUE(covers(point, {0.5, 1.5}));
  b.variable("z", "0", "1");
  const Cover segment = solve_with(b.system(), 0.25);
  EXPECT_EQ(segment.dimension, 1);
  EXPECT_EQ(segment.count(Verdict::regular), segment.boxes.size());
  EXPECT_GE(segment.boxes.size(), 4u);
  EXPECT_LE(segment.boxes.size(), 8u);
}

TEST(Solve, ASystemWithoutVariablesHasOneSolution) {
  const Cover cover = solve(System{});
  ASSERT_EQ(cover.boxes.size(), 1u);
  EXPECT_EQ(cover.boxes[0].verdict, Verdict::isolated);
}

TEST(Solve, AFixedVariableDoesNotStopTheSearch) {
  // x² + y² = a, x = y, with a in [1/10, 1/10]: between two doubles.
  SystemBuilder b;
  const int a = b.variable("a", "1/10", "1/10"), x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {{a, 1}}}}).equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  const Cover cover = solve_with(b.system(), 0.01);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
  EXPECT_LE(widest(cover), 0.01);
  EXPECT_TRUE(covers(cover, {0.1, std::sqrt(0.05), std::sqrt(0.05)}));
}

TEST(Solve, SaysNothingIsInsideBeyondTheExactDomain) {
  // x = 0.100000000000000001 lies outside [0, 1/10], though not outside its enclosure by doubles.
  SystemBuilder b;
  const int x = b.variable("x", "0", "1/10");
  b.equation({{"1", {{x, 1}}}, {"-0.100000000000000001", {}}});
  EXPECT_EQ(solve_with(b.system(), 1e-6).count(Verdict::isolated), 0u);
}

TEST(Solve, EndsWhereRoundingKeepsASheetWide) {
  // 9u² = 16, y = 1e8·u³ − 237037037.037: the box of y stays as wide as the rounding of 1e8·u³.
  SystemBuilder b;
  const int u = b.variable("u", "1", "2"), y = b.variable("y", "-1", "1");
  b.equation({{"9", {{u, 2}}}, {"-16", {}}});
  b.equation({{"1", {{y, 1}}}, {"-1e8", {{u, 3}}}, {"237037037.037", {}}});
  Options options;
  options.sigma = 3e-9;
  options.max_boxes = 1000;
  options.time_limit = 20;
  const Cover cover = solve(b.system(), options);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.wider_than_sigma, cover.boxes.size());
}

TEST(Solve, EndsWhereThePivotOfASheetIsTiny) {
  // 1e-10·d + t² = 0: proven at t ≈ 0 with d dependent, whose coefficient is tiny beside t's elsewhere.
  SystemBuilder b;
  const int d = b.variable("d", "-2e10", "2e10"), t = b.variable("t", "-1", "1");
  b.equation({{"1e-10", {{d, 1}}}, {"1", {{t, 2}}}});
  Options options;
  options.sigma = 1e6;
  options.time_limit = 30;
  const Cover cover = solve(b.system(), options);
  EXPECT_TRUE(cover.complete());
  EXPECT_LE(widest(cover), 1e6);
}

TEST(Solve, RefusesANonsensicalSigma) {
  for (double sigma : {0.0, -1.0, std::nan(""), -HUGE_VAL, 1e-20})
    EXPECT_THROW(solve_with(circle_and_diagonal().system(), sigma), std::invalid_argument) << sigma;
}

TEST(Solve, LeavesTheRoundingModeAsItWas) {
  solve_with(circle_and_diagonal().system(), 0.1);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

// Random quadratic systems with a planted rational solution: it must lie in a box.
TEST(Solve, NeverLosesAPlantedSolution) {
  std::mt19937 random(5);
  const auto integer = [&](int lo, int hi) { return lo + static_cast<int>(random() % static_cast<unsigned>(hi - lo + 1)); };
  for (int trial = 0; trial < 100; ++trial) {
    SystemBuilder b;
    std::vector<double> root;
    std::vector<ExactNumber> exact;
    for (int j = 0; j < 3; ++j) {
      b.variable("x" + std::to_string(j), "-1", "1");
      const int n = integer(-16, 16);
      root.push_back(n / 16.0);
      exact.push_back(ExactNumber(n) / ExactNumber(16));
    }
    System system = b.system();
    for (int e = 0; e < 3; ++e) {
      Polynomial p;
      ExactNumber sum;
      for (int i = 0; i < 3; ++i)
        for (int j = i; j <= 3; ++j) {
          const ExactNumber c(integer(-3, 3));
          if (c.is_zero()) continue;
          std::vector<Factor> factors{{i, 1}};
          if (j == i) factors[0].power = 2;
          if (j > i && j < 3) factors.push_back({j, 1});
          p.monomials.emplace_back(c, factors);
          sum = sum + c * exact[i] * (j == 3 ? ExactNumber(1) : exact[j]);
        }
      if (p.monomials.empty()) continue;
      p.monomials.emplace_back(-sum, std::vector<Factor>{});
      system.equations.push_back(p);
    }
    Options options;
    options.sigma = 0.05;
    options.max_boxes = 20000;
    const Cover cover = solve(system, options);
    ASSERT_TRUE(covers(cover, root)) << "trial " << trial;
  }
}

}  // namespace
}  // namespace corank::solve
