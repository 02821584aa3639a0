// How large a kernel is anywhere in a box, at most.
#include "corank/certify/kernel_bound.h"

#include <gtest/gtest.h>

#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

// M(x) = [x 1 0; −1 x 0; 0 0 x + 1]: the block is regular for every x, the entry where x ≠ −1.
class KernelBoundOfABlock : public ::testing::Test {
 protected:
  KernelBoundOfABlock() {
    const int x = builder_.variable("x", "-2", "2");
    int xi[3];
    for (int k = 0; k < 3; ++k) xi[k] = builder_.variable("xi" + std::to_string(k + 1), "-1", "1", VariableKind::kernel);
    builder_.equation({{"1", {{x, 1}, {xi[0], 1}}}, {"1", {{xi[1], 1}}}});
    builder_.equation({{"-1", {{xi[0], 1}}}, {"1", {{x, 1}, {xi[1], 1}}}});
    builder_.equation({{"1", {{x, 1}, {xi[2], 1}}}, {"1", {{xi[2], 1}}}});
  }
  int at_most(double lower, double upper, int halvings) const {
    const Interval unit(-1, 1);
    return KernelBound(builder_.system()).at_most({Interval(lower, upper), unit, unit, unit}, halvings);
  }

  test::SystemBuilder builder_;
  UpwardRounding rounding_;
};

TEST_F(KernelBoundOfABlock, IsTheLargestOfItsHalves) {
  EXPECT_EQ(at_most(-1.5, 1.5, 0), 2) << "too wide for more than one pivot";
  EXPECT_EQ(at_most(-1.5, 1.5, 1), 1) << "the lower half holds -1, the upper one nothing";
  EXPECT_EQ(at_most(-1.5, 0, 0), 1);
  EXPECT_EQ(at_most(0, 1.5, 0), 0);
  EXPECT_EQ(at_most(-1.0, -1.0, 0), 1) << "never less than there is";
}

}  // namespace
}  // namespace corank::certify
