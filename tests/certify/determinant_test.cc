#include "corank/certify/inertia.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

TEST(DeterminantSign, IsThatOfEveryMatrixWithin) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> entry(-1, 1);
  for (int n = 0; n <= 15; ++n) {
    Eigen::MatrixXd middle(n, n), corner(n, n);
    IntervalMatrix a(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        middle(i, j) = entry(random);
        corner(i, j) = middle(i, j) + (entry(random) > 0 ? 1e-8 : -1e-8);
        a(i, j) = Interval(middle(i, j) - 1e-8, middle(i, j) + 1e-8);
      }
    const int at_middle = middle.determinant() > 0 ? 1 : -1, at_corner = corner.determinant() > 0 ? 1 : -1;
    const UpwardRounding rounding;
    EXPECT_EQ(determinant_sign(a), at_middle) << n;
    EXPECT_EQ(at_corner, at_middle) << n;
  }
}

}  // namespace
}  // namespace corank::certify
