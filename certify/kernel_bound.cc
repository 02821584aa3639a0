#include "corank/certify/kernel_bound.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

std::vector<Polynomial> entries(const KernelMatrix& matrix) {
  std::vector<Polynomial> list;
  for (const auto& row : matrix.rows) list.insert(list.end(), row.begin(), row.end());
  return list;
}

}  // namespace

KernelBound::KernelBound(const System& system) : matrix_(kernel_matrix(system)), compiled_(system, entries(matrix_)) {}

bool KernelBound::is_regular(const std::vector<Interval>& m, const std::vector<int>& rows,
                             const std::vector<int>& columns) const {
  const int s = static_cast<int>(rows.size()), k = static_cast<int>(matrix_.unknowns.size());
  const auto entry = [&](int i, int j) -> const Interval& { return m[static_cast<std::size_t>(rows[i] * k + columns[j])]; };
  Eigen::MatrixXd middle(s, s);
  for (int i = 0; i < s; ++i)
    for (int j = 0; j < s; ++j) middle(i, j) = entry(i, j).mid();
  const Eigen::MatrixXd y = middle.inverse();  // any real matrix will do
  if (!y.allFinite()) return false;
  for (int i = 0; i < s; ++i) {
    double sum = 0;
    for (int j = 0; j < s; ++j) {
      Interval e(i == j ? 1.0 : 0.0);
      for (int b = 0; b < s; ++b) e -= Interval(y(i, b)) * entry(b, j);
      sum += e.mag();  // upward
    }
    if (!(sum < 1)) return false;
  }
  return true;
}

int KernelBound::at_most(const Box& box, int halvings) const {
  CORANK_CHECK(applies() && UpwardRounding::active());
  const int whole = at_most_in_one(box);
  if (whole <= 1 || halvings == 0) return whole;
  const auto is_unknown = [&](std::size_t j) {
    return std::find(matrix_.unknowns.begin(), matrix_.unknowns.end(), static_cast<int>(j)) != matrix_.unknowns.end();
  };
  std::size_t widest = 0;
  for (std::size_t j = 1; j < box.size(); ++j)
    if (!is_unknown(j) && box[j].width() > box[widest].width()) widest = j;
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
  const int rows = static_cast<int>(matrix_.rows.size()), k = static_cast<int>(matrix_.unknowns.size());
  std::vector<Interval> m;
  Eigen::MatrixXd middle(rows, k);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < k; ++j) {
      m.push_back(compiled_.evaluate(compiled_.value_row(i * k + j), box));
      middle(i, j) = m.back().mid();
    }
  // Complete pivoting: the first s pivots belong to a well-conditioned submatrix, for every s.
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(middle);
  std::vector<int> row_order, column_order;
  for (int i = 0; i < std::min(rows, k); ++i) {
    // (P·M·Q)_{ii}: row i of P·M is M's row P⁻¹(i), column i of M·Q is M's column Q(i).
    for (int r = 0; r < rows; ++r)
      if (lu.permutationP().indices()(r) == i) row_order.push_back(r);
    column_order.push_back(lu.permutationQ().indices()(i));
  }
  while (!row_order.empty()) {
    if (is_regular(m, row_order, column_order)) return k - static_cast<int>(row_order.size());
    row_order.pop_back();
    column_order.pop_back();
  }
  return k;
}

}  // namespace corank::certify
