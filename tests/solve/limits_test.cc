// Searches that a limit or a stop ends, and what is reported meanwhile.
#include "corank/tests/solve/cover_questions.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cfenv>
#include <cmath>
#include <string>

#include "corank/solve/step/branching.h"

namespace corank::solve {
namespace {

// A grid of the torus' two angles.
void expect_covers_torus(const Cover& cover) {
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 60; ++k) {
      const double u = 0.0628 * i, v = 0.105 * k, r = 1 + 0.5 * std::cos(v);
      ASSERT_TRUE(covers(cover, {r * std::cos(u), r * std::sin(u), 0.5 * std::sin(v)}));
    }
}

TEST(Solve, ABoxLimitGivesAValidIncompleteCover) {
  Options options;
  options.sigma = 0.1;
  options.max_boxes = 50;
  const Cover cover = solve(torus().system(), options);
  EXPECT_FALSE(cover.complete());
  EXPECT_GT(cover.count(Verdict::pending), 0u);
  expect_covers_torus(cover);
}

std::size_t proven(const Cover& cover) {
  return cover.boxes.size() - cover.count(Verdict::undecided) - cover.count(Verdict::pending);
}

TEST(Solve, EndsAfterSoManyProvenBoxesWithAValidIncompleteCover) {
  Options options;
  options.sigma = 0.1;
  for (const std::uint64_t wanted : {1u, 40u, 1000u}) {
    options.max_solutions = wanted;
    const Cover cover = solve(torus().system(), options);
    EXPECT_GE(proven(cover), wanted);
    EXPECT_LE(proven(cover), wanted + 20) << "a sheet is left after a few pieces";
    EXPECT_FALSE(cover.complete());
    expect_covers_torus(cover);
    const Cover again = solve(torus().system(), options);
    ASSERT_EQ(cover.boxes.size(), again.boxes.size());
    for (std::size_t k = 0; k < cover.boxes.size(); ++k) {
      ASSERT_EQ(cover.boxes[k].box, again.boxes[k].box);
      ASSERT_EQ(cover.boxes[k].verdict, again.boxes[k].verdict);
    }
  }
  options.threads = 3;
  const Cover cover = solve(torus().system(), options);
  EXPECT_GE(proven(cover), 1000u);
  expect_covers_torus(cover);
}

TEST(Solve, EndsAfterSoManyFoundBoxesWhateverTheirVerdict) {
  // A double curve, (x² + y² − 1)² = 0: nothing can be proven.
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 4}}}, {"2", {{x, 2}, {y, 2}}}, {"1", {{y, 4}}}, {"-2", {{x, 2}}}, {"-2", {{y, 2}}}, {"1", {}}});
  Options options;
  options.sigma = 0.01;
  const std::size_t all = solve(b.system(), options).boxes.size();
  options.max_found = 50;
  for (const int threads : {1, 2}) {
    options.threads = threads;
    const Cover cover = solve(b.system(), options);
    EXPECT_FALSE(cover.complete());
    EXPECT_GE(cover.count(Verdict::undecided), 50u);
    EXPECT_LT(cover.boxes.size(), all / 2);
    for (int k = 0; k < 100; ++k) EXPECT_TRUE(covers(cover, {std::cos(0.0628 * k), std::sin(0.0628 * k)}));
  }
}

TEST(Solve, FindsAllWhereThereAreFewerSolutionsThanAskedFor) {
  Options options;
  options.max_solutions = 1;
  const Cover one = solve(circle_and_diagonal().system(), options);
  EXPECT_FALSE(one.complete());
  EXPECT_EQ(one.points.size(), 1u);
  EXPECT_TRUE(covers(one, {std::sqrt(0.5), std::sqrt(0.5)}) && covers(one, {-std::sqrt(0.5), -std::sqrt(0.5)}));
  options.max_solutions = 3;
  const Cover both = solve(circle_and_diagonal().system(), options);
  EXPECT_TRUE(both.complete());
  EXPECT_EQ(both.points.size(), 2u);
}

TEST(Solve, CountsASolutionThatTwoBoxesProveOnceTowardsTheLimit) {
  // x² + y² = 1, (x − p)(y + 1/2) = 0 where x = p is the first bisection: through two of the four solutions.
  const double p = *split_point(Interval(-1, 1));
  const auto exact = [](double value) {
    std::array<char, 80> text;
    std::snprintf(text.data(), text.size(), "%.60f", value);
    return std::string(text.data());
  };
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
  b.equation({{"2", {{x, 1}, {y, 1}}}, {"1", {{x, 1}}}, {exact(-2 * p), {{y, 1}}}, {exact(-p), {}}});
  Options options;
  for (const std::uint64_t wanted : {1u, 2u, 3u, 4u}) {
    options.max_solutions = wanted;
    EXPECT_EQ(solve(b.system(), options).points.size(), wanted);
  }
}

TEST(Solve, ATimeLimitEndsTheCuttingOfAWideSheet) {
  // y = x² / 8 is one sheet, to be cut into 10⁸ pieces.
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"8", {{y, 1}}}, {"-1", {{x, 2}}}});
  Options options;
  options.sigma = 2e-8;
  options.time_limit = 0.05;
  const Cover cover = solve(b.system(), options);
  EXPECT_FALSE(cover.complete());
  for (int k = -100; k <= 100; ++k) EXPECT_TRUE(covers(cover, {k / 128.0, k * k / 131072.0})) << k;
}

TEST(Solve, AStopAndATimeLimitEndTheSearch) {
  std::atomic<bool> stop{true};
  Options options;
  options.sigma = 0.001;
  Control control({.stop = &stop});
  EXPECT_FALSE(solve(prepare(torus().system(), options, control), control).complete());
  options.time_limit = 1e-6;
  options.threads = 2;
  EXPECT_FALSE(solve(torus().system(), options).complete());
}

TEST(Solve, ReportsProgressThatEndsWithAllOfTheDomain) {
  Options options;
  options.sigma = 0.2;
  Control control;
  control.search_progress_interval = 0;
  std::vector<SearchProgress> reports;
  control.search_progress = [&](const SearchProgress& p) {
    EXPECT_EQ(std::fegetround(), FE_TONEAREST) << "a callback runs under the caller's rounding mode";
    reports.push_back(p);
  };
  const Cover cover = solve(prepare(torus().system(), options, control), control);
  ASSERT_GT(reports.size(), 2u);
  for (std::size_t k = 1; k < reports.size(); ++k) {
    EXPECT_GE(reports[k].excluded, reports[k - 1].excluded - 1e-12);
    EXPECT_GE(reports[k].processed, reports[k - 1].processed);
  }
  EXPECT_NEAR(reports.back().excluded, 1.0, 1e-9);
  EXPECT_EQ(reports.back().waiting, 0u);
  EXPECT_EQ(reports.back().verdicts[static_cast<std::size_t>(Verdict::regular)], cover.count(Verdict::regular));
}

}  // namespace
}  // namespace corank::solve
