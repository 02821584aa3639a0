#include "corank/certify/inertia.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "corank/core/check.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

Eigen::MatrixXd middle(const IntervalMatrix& m) {
  Eigen::MatrixXd result(m.rows, m.columns);
  for (int i = 0; i < m.rows; ++i)
    for (int j = 0; j < m.columns; ++j) result(i, j) = m(i, j).mid();
  return result;
}

// Pᵀ·M·P for symmetric matrices in M: the entries (i, j) and (j, i) are the same number.
template <class Matrix>
IntervalMatrix congruent(const IntervalMatrix& m, const Matrix& p, int columns) {
  IntervalMatrix mp(m.rows, columns), result(columns, columns);
  for (int i = 0; i < m.rows; ++i)
    for (int j = 0; j < columns; ++j)
      for (int k = 0; k < m.columns; ++k) mp(i, j) += m(i, k) * Interval(p(k, j));
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < columns; ++j)
      for (int k = 0; k < m.rows; ++k) result(i, j) += Interval(p(k, i)) * mp(k, j);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < i; ++j) {
      CORANK_CHECK(result(i, j).intersect(result(j, i)));
      result(j, i) = result(i, j);
    }
  return result;
}

}  // namespace

std::optional<IntervalMatrix> kernel_basis(const IntervalMatrix& a, const std::vector<int>& dependent,
                                           const std::vector<double>& sizes) {
  CORANK_CHECK(static_cast<int>(dependent.size()) == a.rows && UpwardRounding::active());
  const int m = a.rows, n = a.columns;
  const Eigen::MatrixXd middle_a = middle(a);
  if (!middle_a.allFinite() || m > n) return std::nullopt;
  std::vector<int> free;
  for (int k = 0; k < n; ++k)
    if (std::find(dependent.begin(), dependent.end(), k) == dependent.end()) free.push_back(k);
  Eigen::MatrixXd a_d(m, m);
  for (int k = 0; k < m; ++k) a_d.col(k) = middle_a.col(dependent[static_cast<std::size_t>(k)]);
  const Eigen::MatrixXd y = inverse(a_d);  // any real matrix will do
  if (!y.allFinite()) return std::nullopt;
  const auto y_times = [&](int row, int column) {
    Interval sum;
    for (int k = 0; k < m; ++k) sum += Interval(y(row, k)) * a(k, column);
    return sum;
  };
  std::vector<double> magnitudes, weights;  // the former of I − Y·A_D, upward
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < m; ++j) {
      magnitudes.push_back((Interval(i == j ? 1.0 : 0.0) - y_times(i, dependent[static_cast<std::size_t>(j)])).mag());
    }
    weights.push_back(sizes.empty() ? 1.0 : sizes[static_cast<std::size_t>(dependent[static_cast<std::size_t>(i)])]);
  }
  double alpha = 0;
  for (int i = 0; i < m; ++i) {
    double sum = 0;
    for (int j = 0; j < m; ++j)
      sum += magnitudes[static_cast<std::size_t>(i * m + j)] * weights[static_cast<std::size_t>(j)];
    alpha = std::max(alpha, sum / weights[static_cast<std::size_t>(i)]);
  }
  const double gap = -(alpha - 1);  // downward: α − 1 is rounded up
  if (!(alpha < 1) || !(gap > 0)) return std::nullopt;
  IntervalMatrix basis(n, n - m);
  for (int f = 0; f < n - m; ++f) {
    std::vector<Interval> r;
    double largest = 0;
    for (int i = 0; i < m; ++i) {
      r.push_back(y_times(i, free[static_cast<std::size_t>(f)]));
      largest = std::max(largest, r.back().mag() / weights[static_cast<std::size_t>(i)]);
    }
    const double bound = largest / gap;  // upward: of ‖X‖
    for (int i = 0; i < m; ++i) {
      double slack = 0;  // upward: of the i-th entry of (I − Y·A_D)X
      for (int j = 0; j < m; ++j)
        slack += magnitudes[static_cast<std::size_t>(i * m + j)] * bound * weights[static_cast<std::size_t>(j)];
      basis(dependent[static_cast<std::size_t>(i)], f) = -(r[static_cast<std::size_t>(i)] + Interval(-slack, slack));
    }
    basis(free[static_cast<std::size_t>(f)], f) = Interval(1.0);
  }
  return basis;
}

std::optional<Inertia> inertia(const IntervalMatrix& h) {
  CORANK_CHECK(h.rows == h.columns && UpwardRounding::active());
  if (h.rows == 0) return Inertia{};
  const Eigen::MatrixXd middle_h = middle(h);
  if (!middle_h.allFinite()) return std::nullopt;
  const SymmetricEigen eigen = symmetric_eigen(0.5 * (middle_h + middle_h.transpose()));
  if (!eigen.vectors.allFinite()) return std::nullopt;
  const IntervalMatrix t = congruent(h, eigen.vectors, h.rows);
  Inertia result;
  for (int i = 0; i < t.rows; ++i) {
    double others = 0;
    for (int j = 0; j < t.columns; ++j)
      if (j != i) others += t(i, j).mag();
    if (!(t(i, i).mig() > others)) return std::nullopt;
    ++(t(i, i).lo() > 0 ? result.positive : result.negative);
  }
  return result;
}

std::optional<Inertia> inertia_on_kernel(const IntervalMatrix& h, const IntervalMatrix& a) {
  CORANK_CHECK(h.rows == h.columns && h.rows == a.columns && UpwardRounding::active());
  if (a.rows == 0) return inertia(h);
  const Eigen::MatrixXd middle_a = middle(a);
  if (!middle_a.allFinite() || a.rows > a.columns) return std::nullopt;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(middle_a);
  std::vector<int> dependent;
  for (int k = 0; k < a.rows; ++k) dependent.push_back(qr.colsPermutation().indices()(k));
  const std::optional<IntervalMatrix> basis = kernel_basis(a, dependent);
  if (!basis) return std::nullopt;
  return inertia(congruent(h, *basis, basis->columns));
}

}  // namespace corank::certify
