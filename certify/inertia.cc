#include "corank/certify/inertia.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "corank/certify/numeric.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

// congruent() for symmetric matrices in M: the entries (i, j) and (j, i) are the same number.
IntervalMatrix congruent_symmetric(const IntervalMatrix& m, const IntervalMatrix& p) {
  IntervalMatrix result = congruent(m, p);
  for (int i = 0; i < p.columns; ++i)
    for (int j = 0; j < i; ++j) {
      CORANK_CHECK(result(i, j).intersect(result(j, i)));
      result(j, i) = result(i, j);
    }
  return result;
}

}  // namespace

IntervalMatrix congruent(const IntervalMatrix& m, const IntervalMatrix& p) {
  IntervalMatrix mp(m.rows, p.columns), result(p.columns, p.columns);
  for (int i = 0; i < m.rows; ++i)
    for (int j = 0; j < p.columns; ++j)
      for (int k = 0; k < m.columns; ++k) mp(i, j) += m(i, k) * p(k, j);
  for (int i = 0; i < p.columns; ++i)
    for (int j = 0; j < p.columns; ++j)
      for (int k = 0; k < m.rows; ++k) result(i, j) += p(k, i) * mp(k, j);
  return result;
}

std::optional<IntervalMatrix> kernel_basis(const IntervalMatrix& a, const std::vector<int>& dependent,
                                           const std::vector<double>& sizes) {
  CORANK_CHECK(static_cast<int>(dependent.size()) == a.rows && UpwardRounding::active());
  const int m = a.rows, n = a.columns;
  const Eigen::MatrixXd middle_a = middle(a);
  if (!middle_a.allFinite() || m > n) return std::nullopt;
  const std::vector<int> free = all_but(dependent, n);
  IntervalMatrix a_d(m, m);
  std::vector<double> weights;
  for (int k = 0; k < m; ++k) {
    for (int i = 0; i < m; ++i) a_d(i, k) = a(i, dependent[k]);
    weights.push_back(sizes.empty() ? 1.0 : sizes[dependent[k]]);
  }
  const Eigen::MatrixXd y = m > 0 ? inverse(middle(a_d)) : middle_a;  // any real matrix will do
  if (!y.allFinite()) return std::nullopt;
  const std::vector<double> magnitudes = distance_from_identity(y, a_d);
  double alpha = 0;
  for (int i = 0; i < m; ++i) {
    double sum = 0;
    for (int j = 0; j < m; ++j) sum += magnitudes[i * m + j] * weights[j];
    alpha = std::max(alpha, sum / weights[i]);
  }
  const double gap = -(alpha - 1);  // downward: α − 1 is rounded up
  if (!(alpha < 1) || !(gap > 0)) return std::nullopt;
  IntervalMatrix basis(n, n - m);
  for (int f = 0; f < n - m; ++f) {
    std::vector<Interval> r;
    double largest = 0;
    for (int i = 0; i < m; ++i) {
      r.emplace_back();
      for (int k = 0; k < m; ++k) r.back() += Interval(y(i, k)) * a(k, free[f]);
      largest = std::max(largest, r.back().mag() / weights[i]);
    }
    const double bound = largest / gap;              // upward: of ‖X‖
    if (!std::isfinite(bound)) return std::nullopt;  // 0·∞ below would be no number
    for (int i = 0; i < m; ++i) {
      double slack = 0;  // upward: of the i-th entry of (I − Y·A_D)X
      for (int j = 0; j < m; ++j) slack += magnitudes[i * m + j] * bound * weights[j];
      basis(dependent[i], f) = -(r[i] + Interval(-slack, slack));
    }
    basis(free[f], f) = Interval(1.0);
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
  const IntervalMatrix t = congruent_symmetric(h, exactly(eigen.vectors));
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
  return inertia(congruent_symmetric(h, *basis));
}

int determinant_sign(IntervalMatrix a) {
  CORANK_CHECK(a.rows == a.columns && UpwardRounding::active());
  const int n = a.rows;
  int sign = 1;
  for (int k = 0; k < n; ++k) {
    int row = k, column = k;
    double best = 0;
    for (int i = k; i < n; ++i)
      for (int j = k; j < n; ++j)
        if (a(i, j).mig() > best) best = a(i, j).mig(), row = i, column = j;
    if (best == 0) return 0;
    if (row != k) sign = -sign;
    if (column != k) sign = -sign;
    for (int j = 0; j < n; ++j) std::swap(a(row, j), a(k, j));
    for (int i = 0; i < n; ++i) std::swap(a(i, column), a(i, k));
    const Interval pivot = a(k, k);
    if (pivot.hi() < 0) sign = -sign;
    for (int i = k + 1; i < n; ++i) {
      const auto share = divide(a(i, k), pivot, Interval::whole());
      if (!share || !share->is_bounded()) return 0;
      for (int j = k + 1; j < n; ++j) a(i, j) -= *share * a(k, j);
    }
  }
  return sign;
}

}  // namespace corank::certify
