// Sheets over parameters: x² = p over p in [1, 2], whose two solutions never meet, and what is to be told of them.
#include "corank/certify/solution_count.h"

#include <gtest/gtest.h>

#include <cmath>

#include "corank/certify/newton.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

// x² − p = 0, x in [lower, upper].
System square_root(const std::string& lower, const std::string& upper) {
  test::SystemBuilder builder;
  const int x = builder.variable("x", lower, upper), p = builder.variable("p", "1", "2");
  builder.equation({{"1", {{x, 2}}}, {"-1", {{p, 1}}}});
  System system = builder.system();
  system.variables[1].lower_implied = system.variables[1].upper_implied = true;
  return system;
}

class SheetsOverAParameter : public ::testing::Test {
 protected:
  Sheet prove(const System& system, Interval x, Interval p) {
    const CompiledSystem compiled(system);
    const std::vector<Interval> box{x, p};
    return newton_prove(compiled, midpoint_preconditioner(compiled, {x.mid(), p.mid()}, {0}), box, workspace_);
  }
  std::optional<int> inside(const System& system, std::vector<Sheet> sheets) {
    const CompiledSystem compiled(system);
    const auto inside = sheets_inside(compiled, DomainTest(system), sheets, workspace_);
    return inside ? std::optional(static_cast<int>(inside->size())) : std::nullopt;
  }

  const UpwardRounding rounding_;
  NewtonWorkspace workspace_;
  const System system_ = square_root("-3", "3");
  const CompiledSystem compiled_{system_};
  const Interval all_{1.0, 1.5};
};

TEST_F(SheetsOverAParameter, AreDifferentWhereTheirImagesNeverMeet) {
  const Sheet plus = prove(system_, {1.0, 1.3}, all_), minus = prove(system_, {-1.3, -1.0}, all_);
  ASSERT_TRUE(plus.proven && minus.proven);
  EXPECT_EQ(compare_over(compiled_, plus, minus, workspace_), Identity::different);
  std::vector<Sheet> both{plus, minus};
  EXPECT_TRUE(keep_distinct(compiled_, both, workspace_));
  EXPECT_EQ(both.size(), 2U);
  EXPECT_EQ(inside(system_, both), 2);
}

TEST_F(SheetsOverAParameter, AreOneWhereABoxFindsItFromAnotherPart) {
  // Of each box a part of the sheet leaves it: the proof goes beyond the box.
  const Sheet lower = prove(system_, {1.0, 1.1}, all_), upper = prove(system_, {1.1, 1.25}, all_);
  ASSERT_TRUE(lower.proven && upper.proven);
  EXPECT_EQ(compare_over(compiled_, lower, upper, workspace_), Identity::same);
  std::vector<Sheet> both{lower, upper};
  EXPECT_TRUE(keep_distinct(compiled_, both, workspace_));
  EXPECT_EQ(both.size(), 1U);
}

// An image is any enclosure inside the region: where neither region holds the other's, one value of the parameter tells.
TEST_F(SheetsOverAParameter, AreOneWhereTheyAreOverOneValue) {
  Sheet a = prove(system_, {1.0, 1.25}, all_), b = a;
  ASSERT_TRUE(a.proven);
  const double lower = a.region[0].lo(), upper = a.region[0].hi();
  a.region[0] = Interval(lower, upper + 0.02), a.image[0] = Interval(lower + 1e-3, upper + 0.01);
  b.region[0] = Interval(lower - 0.02, upper), b.image[0] = Interval(lower - 0.01, upper - 1e-3);
  EXPECT_EQ(compare_over(compiled_, a, b, workspace_), Identity::same);
}

TEST_F(SheetsOverAParameter, OfDifferentParametersAreNotCompared) {
  const Sheet a = prove(system_, {1.0, 1.3}, all_), b = prove(system_, {1.0, 1.3}, {1.0, 1.25});
  ASSERT_TRUE(a.proven && b.proven);
  EXPECT_THROW(compare_over(compiled_, a, b, workspace_), InvariantError);
}

TEST_F(SheetsOverAParameter, AreCountedWhereTheyAreInTheDomainForEveryValue) {
  const Sheet plus = prove(system_, {1.0, 1.3}, all_);
  EXPECT_EQ(inside(system_, {plus}), 1);
  EXPECT_EQ(inside(square_root("-3", "1.2"), {plus}), std::nullopt);  // sqrt(1.5) = 1.22 …
  EXPECT_EQ(inside(square_root("-3", "1.3"), {plus}), 1);
  EXPECT_EQ(inside(square_root("-3", "0.9"), {plus}), 0);
  EXPECT_EQ(inside(square_root("1", "3"), {plus}), std::nullopt);  // sqrt(1) is on the end, as far as doubles tell
}

TEST_F(SheetsOverAParameter, HoldOverAPartOfTheirValues) {
  const Sheet plus = prove(system_, {1.0, 1.3}, all_);
  const Sheet part = restricted(compiled_, plus, std::vector<Interval>{Interval(), Interval(1.0, 1.1)}, workspace_);
  EXPECT_TRUE(part.proven);
  EXPECT_TRUE(part.image[0].contains(1.0) && part.image[0].contains(std::sqrt(1.1)));
  EXPECT_LT(part.image[0].hi(), 1.2);
  EXPECT_THROW(restricted(compiled_, plus, std::vector<Interval>{Interval(), Interval(1.0, 1.6)}, workspace_),
               InvariantError);
  EXPECT_TRUE(lies_on(plus, std::vector<Interval>{{1.1, 1.2}, all_}));
  EXPECT_FALSE(lies_on(plus, std::vector<Interval>{{-1.2, 1.2}, all_}));
}

TEST_F(SheetsOverAParameter, AreNotProvenOverAFold) { EXPECT_FALSE(prove(system_, {-0.5, 0.5}, {-0.1, 0.1}).proven); }

}  // namespace
}  // namespace corank::certify
