// Bounds without a search domain: never lose a solution, and are found where squares or sines give them.
#include "corank/certify/unbounded.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using test::SystemBuilder;

constexpr unsigned kLinkSeed = 57721;

TEST(Unbounded, FollowsALinkFromItsBoundedEnd) {
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1"), a = b.variable("a", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-4", {}}});                            // |(x, y)| = 2
  b.equation({{"1", {{a, 2}}}, {"-2", {{x, 1}, {a, 1}}}, {"1", {{x, 2}}}, {"-9", {}}});  // (a − x)² = 9
  std::vector<Interval> box(3, Interval::whole());
  ASSERT_TRUE(contract_unbounded(b.system(), box));
  EXPECT_TRUE(box[0].contains(Interval(-2, 2)) && box[0].mag() < 2.0001);
  EXPECT_TRUE(box[2].contains(Interval(-5, 5)) && box[2].mag() < 6) << box[2];
}

TEST(Unbounded, LeavesWhatHasNoBoundsAsItIs) {
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 1}, {y, 1}}}, {"-1", {}}});
  std::vector<Interval> box(2, Interval::whole());
  ASSERT_TRUE(contract_unbounded(b.system(), box));
  EXPECT_EQ(box[0], Interval::whole());
}

TEST(Unbounded, ProvesThatASumOfSquaresIsNotNegative) {
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"-2", {{x, 1}}}, {"2", {{y, 2}}}, {"3/2", {}}});  // (x − 1)² + 2y² = −1/2
  std::vector<Interval> box(2, Interval::whole());
  EXPECT_FALSE(contract_unbounded(b.system(), box));
}

TEST(Unbounded, TakesNoOtherPowerForALinearTerm) {
  SystemBuilder b;  // x² − x³ = −4 at x = 2; x² − x + 4 is positive
  const int x = b.variable("x", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"-1", {{x, 3}}}, {"4", {}}});
  std::vector<Interval> box(1, Interval::whole());
  ASSERT_TRUE(contract_unbounded(b.system(), box));
  EXPECT_TRUE(box[0].contains(2));
}

TEST(Unbounded, TakesNoProductWithASquareForTheSquare) {
  SystemBuilder b;  // x² − y x² + 3 = 0 with y in [0, 4]: x² = 1 at y = 4; without the product it has no solution
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "0", "4");
  b.equation({{"1", {{x, 2}}}, {"-1", {{x, 2}, {y, 1}}}, {"3", {}}});
  std::vector<Interval> box{Interval::whole(), Interval(0, 4)};
  ASSERT_TRUE(contract_unbounded(b.system(), box));
  EXPECT_TRUE(box[0].contains(Interval(-1, 1)));
}

TEST(Unbounded, DividesByTheFactorOfTheSquare) {
  SystemBuilder b;  // (x/2 − 3)² + y² = 1
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1/4", {{x, 2}}}, {"-3", {{x, 1}}}, {"1", {{y, 2}}}, {"8", {}}});
  std::vector<Interval> box(2, Interval::whole());
  ASSERT_TRUE(contract_unbounded(b.system(), box));
  EXPECT_TRUE(box[0].contains(Interval(4, 8)) && Interval(3.999, 8.001).contains(box[0])) << box[0];
}

TEST(Unbounded, TakesAnInequalityInItsDirection) {
  SystemBuilder outside, inside;  // (x − 1)² >= 4 and <= 4
  for (SystemBuilder* b : {&outside, &inside}) b->variable("x", "-1", "1");
  outside.at_least_zero({{"1", {{0, 2}}}, {"-2", {{0, 1}}}, {"-3", {}}});
  inside.at_least_zero({{"-1", {{0, 2}}}, {"2", {{0, 1}}}, {"3", {}}});
  std::vector<Interval> box{Interval::whole()};
  ASSERT_TRUE(contract_unbounded(outside.system(), box));
  EXPECT_EQ(box[0], Interval::whole());
  ASSERT_TRUE(contract_unbounded(inside.system(), box));
  EXPECT_TRUE(box[0].contains(Interval(-1, 3)) && box[0].mag() < 3.001);
}

TEST(Unbounded, LeavesAPartThatMayBeNegative) {
  SystemBuilder b;  // x² + z³ = 1: nothing bounds x
  const int x = b.variable("x", "-1", "1"), z = b.variable("z", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{z, 3}}}, {"-1", {}}});
  std::vector<Interval> box(2, Interval::whole());
  ASSERT_TRUE(contract_unbounded(b.system(), box));
  EXPECT_EQ(box[0], Interval::whole());
}

// Systems made to have a given solution, among them sides without end: it must stay.
TEST(Unbounded, NeverLosesAPlantedSolution) {
  std::mt19937 engine(kLinkSeed);
  std::uniform_int_distribution<int> small(-8, 8), choice(0, 5), some(2, 5);
  std::size_t bounded = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    SystemBuilder b;
    constexpr int kVariables = 4;
    std::array<double, kVariables> solution{};
    for (int j = 0; j < kVariables; ++j) {
      solution[static_cast<std::size_t>(j)] = std::ldexp(small(engine), small(engine));
      b.variable("x" + std::to_string(j), "-1", "1");
    }
    const int equations = some(engine);
    System system = b.system();
    for (int k = 0; k < equations; ++k) {
      Polynomial f;
      ExactNumber value;
      for (int i = 0; i < kVariables; ++i) {
        for (int j = i; j < kVariables; ++j) {
          const int kind = choice(engine);
          const ExactNumber c = i == j && kind < 4 ? ExactNumber(1 + std::abs(small(engine))) : ExactNumber(small(engine));
          if (c.is_zero() || (i != j && kind < 4)) continue;
          f.monomials.emplace_back(c, i == j ? std::vector<Factor>{{i, 2}} : std::vector<Factor>{{i, 1}, {j, 1}});
          value = value + c * ExactNumber::dyadic(solution[static_cast<std::size_t>(i)]) *
                              ExactNumber::dyadic(solution[static_cast<std::size_t>(j)]);
        }
        const ExactNumber c = small(engine);
        if (c.is_zero()) continue;
        f.monomials.emplace_back(c, std::vector<Factor>{{i, 1}});
        value = value + c * ExactNumber::dyadic(solution[static_cast<std::size_t>(i)]);
      }
      if (!value.is_zero()) f.monomials.emplace_back(-value, std::vector<Factor>{});
      if (choice(engine) == 0) {
        system.inequalities.push_back(f);
      } else {
        system.equations.push_back(f);
      }
    }
    std::vector<Interval> box;
    for (const double x : solution) {
      const int kind = choice(engine);
      const double inf = std::numeric_limits<double>::infinity();
      box.push_back(kind == 0   ? Interval(x - 1, x + 2)
                    : kind == 1 ? Interval(-inf, x)
                    : kind == 2 ? Interval(x, inf)
                                : Interval::whole());
    }
    ASSERT_TRUE(contract_unbounded(system, box)) << "seed " << kLinkSeed << ", trial " << trial;
    for (std::size_t j = 0; j < box.size(); ++j) {
      ASSERT_TRUE(box[j].contains(solution[j])) << "seed " << kLinkSeed << ", trial " << trial << ": " << box[j];
      bounded += box[j].is_bounded();
    }
  }
  EXPECT_GT(bounded, 3000u) << "few bounds were found: the test says little";
}

}  // namespace
}  // namespace corank::certify
