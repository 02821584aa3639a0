// The checker's own steps and search: they lose no solution, and a limit proves nothing.
#include "corank/check/search.h"

#include <gtest/gtest.h>

#include "corank/tests/check/covers.h"
#include "corank/tests/check/enclosed_rows.h"

namespace corank::check {
namespace {

TEST(NewtonStep, HoldsTheSolutionsInEachVariable) {
  const System system = plain("[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\n[SYSTEM EQS]\nx + 2*y = 1;\n");  // x = 1 − 2 y
  const Problem problem(system, {});
  Search search(problem);
  for (const int dependent : {0, 1}) {
    Sides x{{-1, 5}, {0, 1}};
    ASSERT_TRUE(search.newton(x, {{0}, {dependent}, Eigen::MatrixXd{{1}}}, {2, 0.5}));
    for (const double end : {-1.0, 1.0}) EXPECT_TRUE(holds(x[0], end)) << dependent;
    for (const double end : {0.0, 1.0}) EXPECT_TRUE(holds(x[1], end)) << dependent;
    EXPECT_LE(x[0].hi(), 1 + 1e-9) << dependent;
  }
}

class Circle : public testing::Test {
 protected:
  bool confined(const Interval& x, const Interval& y) {
    Sides sides{{-2, 2}, {-2, 2}};
    bool empty = false;
    return Search(problem_).confine(sides, {x, y}, empty);
  }
  const System system_ = plain("[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\n");
  const Problem problem_{system_, {}};
};

TEST_F(Circle, IsConfinedToBoundsThatHoldItOnAllSides) {
  const Interval all(-1.1, 1.1);
  EXPECT_TRUE(confined(all, all));
  for (const Interval& part : {Interval(-1.1, 0.99), Interval(-0.99, 1.1)}) {
    EXPECT_FALSE(confined(part, all));
    EXPECT_FALSE(confined(all, part));
    EXPECT_FALSE(confined(part, {-2, 2}));
    EXPECT_FALSE(confined({-2, 2}, part));
  }
}

TEST_F(Circle, IsNotEmptyWhereALimitEndsTheSearch) {
  for (const std::size_t most : {0u, 1u, 10u}) EXPECT_FALSE(Search(problem_).is_empty(problem_.domain(), most));
}

TEST_F(Circle, IsNotEmptyInEitherHalf) {
  EXPECT_FALSE(Search(problem_).is_empty({{-0.5, 2}, {-0.5, 0.5}}));
  EXPECT_FALSE(Search(problem_).is_empty({{-2, 0.5}, {-0.5, 0.5}}));
  EXPECT_TRUE(Search(problem_).is_empty({{-0.6, 0.6}, {-0.6, 0.6}}));
}

TEST_F(Circle, IsNotEmptyAtAPoint) { EXPECT_FALSE(Search(problem_).is_empty({1.0, 0.0})); }

TEST(Search, LosesNoSolutionThatAnInequalityHoldsAt) {
  const System system =
      plain("[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\nx + y <= 3/2;\nx >= 1/2;\n");
  const Problem problem(system, {});
  EXPECT_FALSE(Search(problem).is_empty(problem.domain()));
  EXPECT_TRUE(Search(problem).is_empty({{-2, 0.49}, {-2, 2}}));
}

}  // namespace
}  // namespace corank::check
