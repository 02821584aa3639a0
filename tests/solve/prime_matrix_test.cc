// Elimination modulo a prime.
#include <gtest/gtest.h>

#include <random>

#include "corank/solve/reduction/flint.h"

namespace corank::solve {
namespace {

TEST(PrimeMatrices, HaveTheReducedEchelonFormOfFlint) {
  std::mt19937 random(7);
  for (int k = 0; k < 200; ++k) {
    const std::size_t rows = 1 + random() % 12, columns = 1 + random() % 12;
    PrimeMatrix ours(rows, columns);
    nmod_mat_t theirs;
    nmod_mat_init(theirs, rows, columns, PrimeMatrix::kPrime);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)  // sparse, with rows that others add up to
        if (random() % 3 == 0)
          ours.at(i, j) = nmod_mat_entry(theirs, i, j) = random() % 2 == 0 ? 1 : PrimeMatrix::kPrime - 2;
    EXPECT_TRUE(ours.reduce({}));
    nmod_mat_rref(theirs);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) EXPECT_EQ(ours.at(i, j), nmod_mat_entry(theirs, i, j)) << k;
    nmod_mat_clear(theirs);
  }
}

TEST(PrimeMatrices, StopWhereTheyAreAskedTo) {
  PrimeMatrix matrix(2, 2);
  matrix.at(0, 0) = matrix.at(1, 1) = 1;
  EXPECT_FALSE(matrix.reduce([] { return true; }));
}

}  // namespace
}  // namespace corank::solve
