// Inside, outside or across, at the ends of the exact domain.
#include "corank/certify/domain.h"

#include <gtest/gtest.h>

#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using test::SystemBuilder;

// 1/3 lies between these neighbours.
constexpr double kBelow = 0x1.5555555555555p-2, kAbove = 0x1.5555555555556p-2;

class DomainEnds : public testing::Test {
 protected:
  static Location located(const SystemBuilder& b, const std::vector<Interval>& x, double tolerance = 0) {
    return DomainTest(b.system()).locate(CompiledSystem(b.system()), x, tolerance);
  }
  UpwardRounding rounding_;
};

TEST_F(DomainEnds, AreTheExactOnes) {
  SystemBuilder lower, upper;
  lower.variable("x", "1/3", "1"), upper.variable("x", "0", "1/3");
  EXPECT_EQ(located(lower, {Interval(kAbove, 0.5)}), Location::inside);
  EXPECT_EQ(located(lower, {Interval(kBelow, 0.5)}), Location::across) << "a little less than 1/3";
  EXPECT_EQ(located(upper, {Interval(0.25, kBelow)}), Location::inside);
  EXPECT_EQ(located(upper, {Interval(0.25, kAbove)}), Location::across);
}

TEST_F(DomainEnds, OfOneSideThatIsImpliedLeaveTheOther) {
  SystemBuilder b;  // the circle implies x >= −1 and y <= 1
  const int x = b.variable("x", "-1", "1/2"), y = b.variable("y", "-1/2", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
  EXPECT_EQ(located(b, {Interval(-1.1, 0.4), Interval(0, 1.1)}), Location::inside);
  EXPECT_EQ(located(b, {Interval(-1, 0.6), Interval(0, 1)}), Location::across);
  EXPECT_EQ(located(b, {Interval(-1, 0), Interval(-0.6, 1)}), Location::across);
}

TEST_F(DomainEnds, HaveATolerancePerUnitAndPerSize) {
  SystemBuilder small, large;
  small.variable("x", "0", "1"), large.variable("x", "0", "100");
  EXPECT_EQ(located(small, {Interval(0.5, 1.009)}, 0.01), Location::inside);
  EXPECT_EQ(located(small, {Interval(0.5, 1.011)}, 0.01), Location::across) << "0.01 · max(1, 1)";
  EXPECT_EQ(located(large, {Interval(-0.99, 1)}, 0.01), Location::inside);
  EXPECT_EQ(located(large, {Interval(-1.01, 1)}, 0.01), Location::across) << "0.01 · max(1, 100)";
}

TEST_F(DomainEnds, OfAnInequalityAreInside) {
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1");
  b.at_least_zero({{"-1", {{x, 1}}}});
  EXPECT_EQ(located(b, {Interval(-0.5, 0)}), Location::inside);
  EXPECT_EQ(located(b, {Interval(0, 0.5)}), Location::across) << "0 satisfies it";
  EXPECT_EQ(located(b, {Interval(0.001, 0.5)}), Location::outside);
  EXPECT_EQ(located(b, {Interval(-0.5, 0.015)}, 0.01), Location::across);
  EXPECT_EQ(located(b, {Interval(-0.5, 0.009)}, 0.01), Location::inside);
}

TEST_F(DomainEnds, ClipEachSideToItsOwn) {
  SystemBuilder b;
  b.variable("x", "0", "1"), b.variable("y", "-2", "1/2");
  std::vector<Interval> x{Interval(-3, 3), Interval(-3, 3)};
  clip_to_domain(b.system(), x);
  EXPECT_EQ(x, (std::vector<Interval>{Interval(0, 1), Interval(-2, 0.5)}));
}

// x = y, y free: a free side may reach as far beyond an end as that is rounded, and no farther.
TEST_F(DomainEnds, HoldForFreeSidesButForTheirRounding) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "0", "1/3");
  b.equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}}).at_least_zero({{"1", {{x, 1}}}, {"-1", {{y, 1}}}, {"1/10", {}}});
  const CompiledSystem f(b.system());
  NewtonWorkspace workspace;
  const DomainTest domain(b.system());
  const auto located_zeros = [&](Interval free) {
    std::vector<Interval> box{Interval(-1, 1), free};
    const NewtonStep step(f, {{0}, {x}, {1.0}}, box, workspace);
    return domain.locate_zeros(step, box);
  };
  EXPECT_EQ(located_zeros({0, kAbove}), Location::inside);
  EXPECT_EQ(located_zeros({0, 0.35}), Location::across);
  EXPECT_EQ(located_zeros({-0.01, 0.3}), Location::across);
}

}  // namespace
}  // namespace corank::certify
