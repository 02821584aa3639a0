// Bounds of a kernel's dimension over a box.
#include "corank/check/kernel.h"

#include <gtest/gtest.h>

#include "corank/tests/check/covers.h"

namespace corank::check {
namespace {

// Variables x, y, and the kernel vector (a, b).
System system_with_kernel(const std::string& equations) {
  System system = plain("[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\na : [-1, 1]\nb : [-1, 1]\n[SYSTEM EQS]\n" + equations +
                        "a^2 + b^2 = 1;\n");
  for (const std::size_t j : {2u, 3u}) system.variables[j].kind = VariableKind::kernel;
  system.configuration_size = 2;
  return system;
}

bool at_most(const std::string& equations, int most, const Interval& x, const Interval& y, double tolerance = 0) {
  System system = system_with_kernel(equations);
  system.coefficient_tolerance = tolerance;
  return KernelCheck(system).is_at_most(most, {x, y, {0.5, 1}, {0.5, 1}});
}

const char* const kDiagonal = "x*a = 0;\ny*b = 0;\n";

TEST(KernelsDimension, IsThatOfTheWholeBox) {
  const Interval positive(1, 2);
  EXPECT_TRUE(at_most(kDiagonal, 0, positive, positive));
  for (const Interval& zero : {Interval(-0.5, 2), Interval(-2, 0.5), Interval(0, 0)}) {
    EXPECT_FALSE(at_most(kDiagonal, 0, zero, positive));
    EXPECT_FALSE(at_most(kDiagonal, 0, positive, zero));
    EXPECT_TRUE(at_most(kDiagonal, 1, positive, zero));
    EXPECT_FALSE(at_most(kDiagonal, 1, zero, zero)) << "M is 0 at the origin";
    EXPECT_TRUE(at_most(kDiagonal, 2, zero, zero));
  }
}

TEST(KernelsDimension, HoldsForEveryChoiceWithinTheTolerance) {
  const char* const third = "x*a - 1/3*a = 0;\nb - y*b = 0;\n";
  EXPECT_TRUE(at_most(third, 0, {0.334, 0.34}, {2, 3}));
  EXPECT_FALSE(at_most(third, 0, {0.334, 0.34}, {2, 3}, 0.05));
}

TEST(KernelsDimension, IsBoundedByEquationsThatAreLinearInTheKernelVectorOnly) {
  const Interval positive(1, 2);
  EXPECT_FALSE(at_most("a^2 + y*b^2 = 0;\n", 1, positive, positive));
  EXPECT_FALSE(at_most("a*b = 0;\n", 1, positive, positive));
  EXPECT_TRUE(at_most("a + y*b = 0;\n", 1, positive, positive));
}

}  // namespace
}  // namespace corank::check
