#include "corank/certify/inertia.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>
#include <utility>

#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

TEST(Determinant, OfPermutationsIsTheirSign) {
  const UpwardRounding rounding;
  IntervalMatrix swap(3, 3), turn(3, 3);
  for (const auto& [i, j] : {std::pair(0, 1), {1, 0}, {2, 2}}) swap(i, j) = Interval(1);
  for (const auto& [i, j] : {std::pair(0, 1), {1, 2}, {2, 0}}) turn(i, j) = Interval(1);
  EXPECT_EQ(determinant(swap), Interval(-1));
  EXPECT_EQ(determinant(turn), Interval(1));
  EXPECT_EQ(determinant(IntervalMatrix(0, 0)), Interval(1));
}

TEST(Determinant, EnclosesThatOfEveryMatrixWithin) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> entry(-1, 1);
  for (int n = 1; n <= 7; ++n) {
    Eigen::MatrixXd middle(n, n), corner(n, n);
    IntervalMatrix a(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        middle(i, j) = entry(random);
        corner(i, j) = middle(i, j) + (entry(random) > 0 ? 1e-6 : -1e-6);
        a(i, j) = Interval(middle(i, j) - 1e-6, middle(i, j) + 1e-6);
      }
    const double at_middle = middle.determinant(), at_corner = corner.determinant();
    const UpwardRounding rounding;
    const Interval all = determinant(a);
    EXPECT_TRUE(all.contains(at_middle) && all.contains(at_corner)) << n;
    EXPECT_LT(all.width(), 1e-2);
  }
}

}  // namespace
}  // namespace corank::certify
