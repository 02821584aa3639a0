#include "corank/certify/kernel_bound.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "corank/certify/contraction.h"
#include "corank/core/check.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

constexpr int kMostTries = 3;  // sizes of a submatrix of a given matrix: its rank is full, or nearly, or of no use

std::vector<Polynomial> entries(const KernelMatrix& matrix) {
  std::vector<Polynomial> list;
  for (const auto& row : matrix.rows) list.insert(list.end(), row.begin(), row.end());
  return list;
}

// Rows and columns times positive numbers, by which the largest entries of all are near 1: for the choice of pivots. The
// columns' numbers are sizes of the unknowns, for that of a norm.
struct Balanced {
  Eigen::MatrixXd matrix;
  std::vector<double> sizes;
};
Balanced balanced(Eigen::MatrixXd a) {
  constexpr int kLeastTurns = 3, kMostTurns = 8;
  constexpr double kNear = 2;
  std::vector<double> sizes(static_cast<std::size_t>(a.cols()), 1.0);
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
      sizes[static_cast<std::size_t>(j)] /= by;
    }
  }
  for (double& size : sizes)
    if (!(size > 0) || !std::isfinite(size)) size = 1;
  return {std::move(a), std::move(sizes)};
}

}  // namespace

KernelBound::KernelBound(const System& system) : least_(1), compiled_(system, entries(kernel_matrix(system))) {
  const KernelMatrix matrix = kernel_matrix(system);
  rows_ = static_cast<int>(matrix.rows.size());
  columns_ = static_cast<int>(matrix.unknowns.size());
  note_arguments(entries(matrix));
}

KernelBound::KernelBound(const System& system, const PolynomialMatrix& matrix)
    : rows_(matrix.rows),
      columns_(matrix.columns),
      least_(std::max(0, matrix.columns - matrix.rows)),
      most_tries_(kMostTries),
      compiled_(system, matrix.entries) {
  note_arguments(matrix.entries);
}

void KernelBound::note_arguments(const std::vector<Polynomial>& entries) {
  for (const Polynomial& f : entries)
    for (const Monomial& m : f.monomials)
      for (const Factor& x : m.factors) arguments_.push_back(x.variable);
  std::sort(arguments_.begin(), arguments_.end());
  arguments_.erase(std::unique(arguments_.begin(), arguments_.end()), arguments_.end());
}

bool KernelBound::is_regular(const std::vector<Interval>& m, const std::vector<int>& rows, const std::vector<int>& columns,
                             const std::vector<double>& sizes) const {
  const int s = static_cast<int>(rows.size()), k = columns_;
  const auto entry = [&](int i, int j) -> const Interval& { return m[static_cast<std::size_t>(rows[i] * k + columns[j])]; };
  Eigen::MatrixXd middle(s, s);
  for (int i = 0; i < s; ++i)
    for (int j = 0; j < s; ++j) middle(i, j) = entry(i, j).mid();
  const Eigen::MatrixXd y = inverse(middle);  // any real matrix will do
  if (!y.allFinite()) return false;
  std::vector<std::vector<int>> filled(
      static_cast<std::size_t>(s));  // of each column the rows that are not 0: large M are sparse
  for (int j = 0; j < s; ++j)
    for (int b = 0; b < s; ++b)
      if (entry(b, j).mag() > 0) filled[static_cast<std::size_t>(j)].push_back(b);
  std::vector<double> excess;  // |I − Y·N|, upward
  for (int i = 0; i < s; ++i)
    for (int j = 0; j < s; ++j) {
      Interval e(i == j ? 1.0 : 0.0);
      for (const int b : filled[static_cast<std::size_t>(j)]) e -= Interval(y(i, b)) * entry(b, j);
      excess.push_back(e.mag());
    }
  std::vector<double> typical;
  for (const int column : columns) typical.push_back(sizes[static_cast<std::size_t>(column)]);
  return contraction(excess, std::move(typical)).has_value();
}

int KernelBound::at_most(const Box& box, int halvings) const {
  CORANK_CHECK(applies() && UpwardRounding::active());
  const int whole = at_most_in_one(box);
  if (whole <= least_ || halvings == 0 || arguments_.empty()) return whole;
  const auto relative_width = [&](std::size_t j) { return box[j].width() / compiled_.scales()[j]; };
  auto widest = static_cast<std::size_t>(arguments_.front());
  for (const int v : arguments_)
    if (const auto j = static_cast<std::size_t>(v); relative_width(j) > relative_width(widest)) widest = j;
  const Interval side = box[widest];
  const double middle = side.mid();
  if (!(side.lo() < middle && middle < side.hi())) return whole;
  int most = 0;
  for (const Interval& half : {Interval(side.lo(), middle), Interval(middle, side.hi())}) {
    Box part = box;
    part[widest] = half;
    most = std::max(most, at_most(part, halvings - 1));
    if (most >= whole) return whole;
  }
  return most;
}

int KernelBound::at_most_in_one(const Box& box) const {
  const int rows = rows_, k = columns_;
  if (k == 0) return 0;
  std::vector<Interval> m;
  Eigen::MatrixXd middle(rows, k);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < k; ++j) {
      m.push_back(compiled_.evaluate(compiled_.value_row(i * k + j), box));
      middle(i, j) = m.back().mid();
    }
  // Complete pivoting: the first s pivots belong to a well-conditioned submatrix, for every s.
  const Balanced scaled = balanced(middle);
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
