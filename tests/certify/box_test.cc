#include "corank/core/box.h"

#include <gtest/gtest.h>

namespace corank::certify {
namespace {

TEST(Box, PartsOfASideShareTheirEndsAndFillIt) {
  const Interval side(-1, 0.1);
  for (const int n : {1, 2, 3, 7}) {
    EXPECT_EQ(part_of(side, 0, n).lo(), side.lo());
    EXPECT_EQ(part_of(side, n - 1, n).hi(), side.hi());
    for (int k = 1; k < n; ++k) {
      EXPECT_EQ(part_of(side, k - 1, n).hi(), part_of(side, k, n).lo());
      EXPECT_NEAR(part_of(side, k, n).width(), side.width() / n, 1e-15);
    }
  }
}

}  // namespace
}  // namespace corank::certify
