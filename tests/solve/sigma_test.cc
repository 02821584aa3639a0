// The default of σ: a share of a set's size, by its dimension and by how many sides its boxes have.
#include "corank/solve/step/sigma.h"

#include <gtest/gtest.h>

#include <string>

namespace corank::solve {
namespace {

// Of a set whose hull has these sides, all of them lengths.
double default_of(int variables, int dimension, double size = 1) {
  System system;
  for (int j = 0; j < variables; ++j) system.variables.emplace_back("x" + std::to_string(j), VariableKind::length, 0, 1);
  return default_sigma(system, Box(variables, Interval(0, size)), dimension).length;
}

TEST(DefaultSigma, IsCoarserForLargerSets) {
  EXPECT_EQ(default_of(10, 0), 1e-6);
  EXPECT_EQ(default_of(10, 1), 0.005);
  EXPECT_EQ(default_of(10, 2), 0.016);
  EXPECT_EQ(default_of(10, 3), 0.05);
  EXPECT_EQ(default_of(10, 4), 0.1);
}

TEST(DefaultSigma, IsADecimalOfTwoOrThreeDigits) {
  for (const double sigma : {0.071, 0.0036, 0.14, 0.00125, 7.1, 560.0, 1.1e5, 7.1e-9})
    EXPECT_EQ(default_of(10, 3, 20 * sigma), sigma) << "as it is written";
}

TEST(DefaultSigma, OfSurfacesIsCoarserWhereBoxesHaveManySides) {
  EXPECT_EQ(default_of(20, 2), default_of(2, 2));
  EXPECT_EQ(default_of(80, 2), 2 * default_of(20, 2)) << "a quarter of the boxes";
  EXPECT_EQ(default_of(160, 3), 2 * default_of(20, 3)) << "an eighth";
  EXPECT_EQ(default_of(80, 1), default_of(20, 1)) << "a curve has few boxes";
}

}  // namespace
}  // namespace corank::solve
