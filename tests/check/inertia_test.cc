// Signs of forms and determinants: those of matrices with known eigenvalues, and nothing where one may be 0.
#include "corank/check/inertia.h"

#include <gtest/gtest.h>

#include <random>

namespace corank::check {
namespace {

std::vector<Sides> matrix(const std::vector<std::vector<double>>& rows, double radius = 0) {
  std::vector<Sides> result;
  for (const auto& row : rows) {
    result.emplace_back();
    for (const double x : row) result.back().emplace_back(x - radius, x + radius);
  }
  return result;
}

TEST(Inertia, CountsUpAndDown) {
  EXPECT_EQ(inertia_on_kernel(matrix({{2, 0, 0}, {0, -3, 0}, {0, 0, 5}}), {}), (Inertia{2, 1}));
  // Its diagonal is 0: no pivot without a turn.
  EXPECT_EQ(inertia_on_kernel(matrix({{0, 1}, {1, 0}}), {}), (Inertia{1, 1}));
  EXPECT_EQ(inertia_on_kernel(matrix({{0, 1}, {1, 0}}, 0.1), {}), (Inertia{1, 1}));
}

TEST(Inertia, OnAKernelIsThatOfTheFormThere) {
  // x² − y² + 3z² where x = y: 3z², degenerate; where x = 2y: 3y² + 3z²; where 2x = y: −3x² + 3z².
  const auto form = matrix({{1, 0, 0}, {0, -1, 0}, {0, 0, 3}});
  EXPECT_FALSE(inertia_on_kernel(form, matrix({{1, -1, 0}})));
  EXPECT_EQ(inertia_on_kernel(form, matrix({{1, -2, 0}})), (Inertia{2, 0}));
  EXPECT_EQ(inertia_on_kernel(form, matrix({{2, -1, 0}})), (Inertia{1, 1}));
  EXPECT_EQ(inertia_on_kernel(form, matrix({{0, 0, 1}, {1, -2, 0}})), (Inertia{1, 0}));
  EXPECT_FALSE(inertia_on_kernel(form, matrix({{1, -2, 0}, {2, -4, 0}})));
  // 2xy where x = y, and where x = −y.
  EXPECT_EQ(inertia_on_kernel(matrix({{0, 1}, {1, 0}}), matrix({{1, -1}})), (Inertia{1, 0}));
  EXPECT_EQ(inertia_on_kernel(matrix({{0, 1}, {1, 0}}), matrix({{1, 1}})), (Inertia{0, 1}));
}

TEST(Inertia, IsNotShownWhereAnEigenvalueMayBeZero) {
  EXPECT_FALSE(inertia_on_kernel(matrix({{1, 1}, {1, 1}}), {}));
  EXPECT_TRUE(inertia_on_kernel(matrix({{1, 0}, {0, 0.2}}, 0.05), {}));
  EXPECT_FALSE(inertia_on_kernel(matrix({{1, 0}, {0, 0.2}}, 0.25), {}));
}

TEST(DeterminantSign, IsThatOfThePivotsAndExchanges) {
  EXPECT_EQ(determinant_sign(matrix({{0, 1}, {1, 0}})), -1);
  EXPECT_EQ(determinant_sign(matrix({{0, 0, 1}, {1, 0, 0}, {0, 1, 0}})), 1);
  EXPECT_EQ(determinant_sign(matrix({{-2, 1}, {1, -3}})), 1);
  EXPECT_EQ(determinant_sign(matrix({{1, 2}, {2, 4}})), 0);
  EXPECT_EQ(determinant_sign(matrix({{1, 2}, {2, 4.5}}, 0.3)), 0);
}

// Against the sign of the sum over all permutations.
TEST(DeterminantSign, OfRandomMatricesIsThatOfTheExpansion) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> entry(-4, 4);
  int known = 0;
  for (int k = 0; k < 200; ++k) {
    double a[3][3];
    std::vector<std::vector<double>> rows;
    for (auto& row : a) {
      for (double& x : row) x = entry(random);
      rows.emplace_back(row, row + 3);
    }
    const double det = a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
                       a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) + a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
    const int sign = determinant_sign(matrix(rows));
    EXPECT_EQ(sign, det > 0 ? 1 : det < 0 ? -1 : 0);
    known += sign != 0;
  }
  EXPECT_GT(known, 100);
}

}  // namespace
}  // namespace corank::check
