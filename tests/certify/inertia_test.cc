// Inertia of planted forms, on kernels too: none false, none lost where the entries are narrow.
#include "corank/certify/inertia.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <random>

#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

class Planter {
 public:
  explicit Planter(unsigned seed) : random_(seed) {}
  int number(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random_); }
  Eigen::MatrixXd matrix(int rows, int columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [this] { return std::uniform_real_distribution<>(-1, 1)(random_); });
  }
  // Of these signs, with eigenvalues of at least 1/10 and directions of its own.
  Eigen::MatrixXd form(const Inertia& signs) {
    const int n = signs.positive + signs.negative;
    Eigen::VectorXd values(n);
    for (int i = 0; i < n; ++i)
      values(i) = (i < signs.positive ? 1 : -1) * std::uniform_real_distribution<>(0.1, 3)(random_);
    const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(matrix(n, n)).householderQ();
    const Eigen::MatrixXd h = q * values.asDiagonal() * q.transpose();
    return 0.5 * (h + h.transpose());
  }

 private:
  std::mt19937 random_;
};

IntervalMatrix about(const Eigen::MatrixXd& m, double radius) {
  IntervalMatrix result(static_cast<int>(m.rows()), static_cast<int>(m.cols()));
  for (int i = 0; i < result.rows; ++i)
    for (int j = 0; j < result.columns; ++j) result(i, j) = Interval(m(i, j) - radius, m(i, j) + radius);
  return result;
}

TEST(Inertia, OfPlantedFormsIsFound) {
  Planter planter(1);
  const UpwardRounding rounding;
  for (int k = 0; k < 300; ++k) {
    const Inertia signs{planter.number(0, 4), planter.number(0, 4)};
    EXPECT_EQ(inertia(about(planter.form(signs), 1e-9)), signs);
  }
}

// On the kernel of A, which has the form's first coordinates in another basis.
TEST(Inertia, OnAKernelIsThatOfTheFormThere) {
  Planter planter(2);
  const UpwardRounding rounding;
  int found = 0;
  for (int k = 0; k < 300; ++k) {
    const Inertia there{planter.number(0, 3), planter.number(0, 3)}, across{planter.number(0, 2), planter.number(0, 2)};
    const int d = there.positive + there.negative, m = across.positive + across.negative, n = d + m;
    const Eigen::MatrixXd basis = planter.matrix(n, n) + 2 * Eigen::MatrixXd::Identity(n, n), back = corank::inverse(basis);
    Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(n, n);
    blocks.topLeftCorner(d, d) = planter.form(there);
    blocks.bottomRightCorner(m, m) = planter.form(across);
    const Eigen::MatrixXd h = back.transpose() * blocks * back, a = back.bottomRows(m);
    if (!(basis.norm() * back.norm() < 1e4)) continue;
    ++found;
    EXPECT_EQ(inertia_on_kernel(about(0.5 * (h + h.transpose()), 1e-11), about(a, 1e-11)), there);
  }
  EXPECT_GT(found, 250);
}

TEST(Inertia, IsNotClaimedWhereAMatrixWithinIsSingular) {
  Planter planter(3);
  const UpwardRounding rounding;
  for (int k = 0; k < 300; ++k) {
    const int n = planter.number(1, 6);
    const Eigen::MatrixXd h = planter.form({n - n / 2, n / 2});
    // h − λ v vᵀ is singular, and no entry of v vᵀ is over 1.
    const double least = symmetric_eigen(h).values.cwiseAbs().minCoeff();
    EXPECT_FALSE(inertia(about(h, least)));
  }
}

// The matrix of ones is within, though no entry of the diagonal may be 0.
TEST(Inertia, IsNotClaimedForAPositiveDiagonalAlone) {
  const UpwardRounding rounding;
  for (int n = 2; n <= 6; ++n) {
    IntervalMatrix h(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) h(i, j) = i == j ? Interval(1.0) : Interval(-1, 1);
    EXPECT_FALSE(inertia(h));
  }
}

TEST(Inertia, IsNotClaimedOnAKernelThatMayBeLarger) {
  Planter planter(4);
  const UpwardRounding rounding;
  for (int k = 0; k < 300; ++k) {
    const int m = planter.number(1, 3), n = m + planter.number(0, 3);
    Eigen::MatrixXd a = planter.matrix(m, n);
    a.row(m - 1) = m > 1 ? Eigen::MatrixXd(2 * a.row(0)) : Eigen::MatrixXd::Zero(1, n);
    EXPECT_FALSE(inertia_on_kernel(about(planter.form({n, 0}), 1e-12), about(a, 1e-6)));
  }
}

// V holds a kernel's basis: A·V has 0 in it, and no wider than the entries make it.
TEST(KernelBasis, HoldsThatOfEachMatrix) {
  Planter planter(5);
  const UpwardRounding rounding;
  int found = 0;
  for (int k = 0; k < 300; ++k) {
    const int m = planter.number(1, 3), n = m + planter.number(1, 3);
    const double radius = k % 2 == 0 ? 1e-9 : 0.02;
    const Eigen::MatrixXd middle = planter.matrix(m, n), other = middle + radius * planter.matrix(m, n);
    std::vector<int> dependent;
    for (int j = 0; j < m; ++j) dependent.push_back(n - 1 - j);
    std::vector<double> sizes;  // any
    for (int j = 0; j < n && k % 3 != 0; ++j) sizes.push_back(std::pow(10.0, planter.number(-3, 6)));
    const auto basis = kernel_basis(about(middle, radius), dependent, sizes);
    if (!basis) continue;
    ++found;
    Eigen::MatrixXd a_d(m, m);
    for (int j = 0; j < m; ++j) a_d.col(j) = other.col(dependent[static_cast<std::size_t>(j)]);
    const Eigen::MatrixXd v = -a_d.fullPivLu().solve(other.leftCols(n - m));
    for (int f = 0; f < n - m; ++f)
      for (int i = 0; i < m; ++i) {
        const Interval side = (*basis)(dependent[static_cast<std::size_t>(i)], f);
        const double room = 1e-9 * (1 + std::fabs(v(i, f)));  // of the doubles with which v is found
        EXPECT_TRUE(side.lo() - room <= v(i, f) && v(i, f) <= side.hi() + room) << v(i, f);
      }
  }
  EXPECT_GT(found, 150);
}

// With sizes in the same unit the entries are as wide, in that unit, as without.
TEST(KernelBasis, DoesNotDependOnUnits) {
  Planter planter(6);
  const UpwardRounding rounding;
  for (int k = 0; k < 100; ++k) {
    const int m = planter.number(1, 3), n = m + planter.number(1, 3);
    const Eigen::MatrixXd middle = planter.matrix(m, n);
    std::vector<int> dependent;
    std::vector<double> sizes;
    for (int j = 0; j < m; ++j) dependent.push_back(j);
    for (int j = 0; j < n; ++j) sizes.push_back(std::ldexp(1.0, planter.number(-20, 20)));
    IntervalMatrix here = about(middle, 0.01), there = here;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < n; ++j) there(i, j) = here(i, j) * Interval(1 / sizes[static_cast<std::size_t>(j)]);
    const auto plain = kernel_basis(here, dependent), scaled = kernel_basis(there, dependent, sizes);
    ASSERT_EQ(plain.has_value(), scaled.has_value());
    if (!plain) continue;
    for (int f = 0; f < n - m; ++f)
      for (int i = 0; i < m; ++i) {
        const double unit = sizes[static_cast<std::size_t>(i)] / sizes[static_cast<std::size_t>(m + f)];
        EXPECT_NEAR((*scaled)(i, f).width(), (*plain)(i, f).width() * unit, 1e-9 * unit * (1 + (*plain)(i, f).mag()));
      }
  }
}

// 2⁻⁷⁰⁰·x + 2⁷⁰⁰·y = 0: x = −2¹⁴⁰⁰·y is beyond doubles, and the residue of 1/2⁻⁷⁰⁰ is 0, which times ∞ is no number.
TEST(KernelBasis, IsNotShownWhereItsEntriesOverflow) {
  const UpwardRounding rounding;
  IntervalMatrix a(1, 2);
  a(0, 0) = Interval(std::ldexp(1.0, -700));
  a(0, 1) = Interval(std::ldexp(1.0, 700));
  EXPECT_FALSE(kernel_basis(a, {0}));
  EXPECT_TRUE(kernel_basis(a, {1}));
}

}  // namespace
}  // namespace corank::certify
