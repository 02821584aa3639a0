// The default of σ: a share of a set's size, by its dimension and by how many sides its boxes have.
#include "corank/solve/step/sigma.h"

#include <gtest/gtest.h>

#include <string>

namespace corank::solve {
namespace {

// Of lengths in [0, 1], the set's hull.
double default_of(int variables, int dimension) {
  System system;
  for (int j = 0; j < variables; ++j) system.variables.emplace_back("x" + std::to_string(j), VariableKind::length, 0, 1);
  return default_sigma(system, system.domain(), dimension).length;
}

TEST(DefaultSigma, IsCoarserForLargerSets) {
  EXPECT_EQ(default_of(10, 0), 1e-6);
  EXPECT_EQ(default_of(10, 1), 0.005);
  EXPECT_EQ(default_of(10, 2), 0.016);
  EXPECT_EQ(default_of(10, 3), 0.05);
  EXPECT_EQ(default_of(10, 4), 0.1);
}

TEST(DefaultSigma, OfSurfacesIsCoarserWhereBoxesHaveManySides) {
  EXPECT_EQ(default_of(20, 2), default_of(2, 2));
  EXPECT_EQ(default_of(80, 2), 2 * default_of(20, 2)) << "a quarter of the boxes";
  EXPECT_EQ(default_of(160, 3), 2 * default_of(20, 3)) << "an eighth";
  EXPECT_EQ(default_of(80, 1), default_of(20, 1)) << "a curve has few boxes";
}

}  // namespace
}  // namespace corank::solve
