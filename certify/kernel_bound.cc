#include "corank/certify/kernel_bound.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "corank/certify/numeric.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/core/check.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

// Rows and columns times positive numbers, by which the largest entries of all are near 1: for the choice of pivots. The
// columns' numbers are sizes of the unknowns, for that of a norm.
struct Balanced {
  Eigen::MatrixXd matrix;
  std::vector<double> sizes;
};
Balanced balanced(Eigen::MatrixXd a) {
  constexpr int kLeastTurns = 3, kMostTurns = 8;
  constexpr double kNear = 2;
  std::vector<double> sizes(a.cols(), 1.0);
  bool uneven = true;
  for (int turn = 0; turn < kLeastTurns || (uneven && turn < kMostTurns); ++turn) {
    uneven = false;
    const auto factor = [&](const auto& line) {
      const double largest = line.cwiseAbs().maxCoeff();
      if (!(largest > 0)) return 1.0;
      uneven = uneven || largest > kNear || largest < 1 / kNear;
      return std::sqrt(largest);
    };
    for (Eigen::Index i = 0; i < a.rows(); ++i) a.row(i) /= factor(a.row(i));
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      const double by = factor(a.col(j));
      a.col(j) /= by;
      sizes[j] /= by;
    }
  }
  for (double& size : sizes)
    if (!(size > 0) || !std::isfinite(size)) size = 1;
  return {std::move(a), std::move(sizes)};
}

// The theorem, for the submatrix N of these rows and columns of M(B).
bool is_regular(const IntervalMatrix& m, const std::vector<int>& rows, const std::vector<int>& columns,
                const std::vector<double>& sizes) {
  const int s = static_cast<int>(rows.size());
  IntervalMatrix n(s, s);
  std::vector<double> typical;
  for (int j = 0; j < s; ++j) {
    for (int i = 0; i < s; ++i) n(i, j) = m(rows[i], columns[j]);
    typical.push_back(sizes[columns[j]]);
  }
  const Eigen::MatrixXd y = inverse(middle(n));  // any real matrix will do
  return y.allFinite() && is_contraction(distance_from_identity(y, n), typical);
}

}  // namespace

KernelBound::KernelBound(const System& system) : KernelBound(system, kernel_matrix(system)) {
  least_ = 1;
  most_tries_ = std::numeric_limits<int>::max();
}

KernelBound::KernelBound(const System& system, const PolynomialMatrix& matrix)
    : rows_(matrix.rows),
      columns_(matrix.columns),
      least_(std::max(0, matrix.columns - matrix.rows)),
      arguments_(variables_of(matrix.entries)),
      compiled_(system, matrix.entries) {}

int KernelBound::at_most(const Box& box, int halvings) const {
  CORANK_CHECK(applies() && UpwardRounding::active());
  const int whole = at_most_in_one(box);
  if (whole <= least_ || halvings == 0) return whole;
  const auto halves = halved(box, arguments_, compiled_.scales());
  if (!halves) return whole;
  int most = 0;
  for (const Box& half : *halves) {
    most = std::max(most, at_most(half, halvings - 1));
    if (most >= whole) return whole;
  }
  return most;
}

int KernelBound::at_most_in_one(const Box& box) const {
  const int rows = rows_, k = columns_;
  if (k == 0) return 0;
  IntervalMatrix m(rows, k);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < k; ++j) m(i, j) = compiled_.evaluate(compiled_.value_row(i * k + j), box);
  // Complete pivoting: the first s pivots belong to a well-conditioned submatrix, for every s.
  const Balanced scaled = balanced(middle(m));
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(scaled.matrix);
  std::vector<int> row_order, column_order;
  for (int i = 0; i < std::min(rows, k); ++i) {
    // (P·M·Q)_{ii}: row i of P·M is M's row P⁻¹(i), column i of M·Q is M's column Q(i).
    for (int r = 0; r < rows; ++r)
      if (lu.permutationP().indices()(r) == i) row_order.push_back(r);
    column_order.push_back(lu.permutationQ().indices()(i));
  }
  for (int tries = 0; !row_order.empty() && tries < most_tries_; ++tries) {
    if (is_regular(m, row_order, column_order, scaled.sizes)) return k - static_cast<int>(row_order.size());
    row_order.pop_back();
    column_order.pop_back();
  }
  return k;
}

}  // namespace corank::certify
