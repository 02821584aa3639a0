#include "corank/certify/numeric.h"

#include <algorithm>
#include <cmath>

#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {

Eigen::MatrixXd middle(const IntervalMatrix& m) {
  Eigen::MatrixXd result(m.rows, m.columns);
  for (int i = 0; i < m.rows; ++i)
    for (int j = 0; j < m.columns; ++j) result(i, j) = m(i, j).mid();
  return result;
}

IntervalMatrix exactly(const Eigen::MatrixXd& m) {
  IntervalMatrix result(static_cast<int>(m.rows()), static_cast<int>(m.cols()));
  for (int i = 0; i < result.rows; ++i)
    for (int j = 0; j < result.columns; ++j) result(i, j) = Interval(m(i, j));
  return result;
}

Eigen::MatrixXd approximate_jacobian(const CompiledSystem& system, const std::vector<double>& point) {
  std::vector<double> entries(system.entries());
  system.approximate_jacobian(point.data(), entries.data());
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(system.equations(), system.variables());
  for (int i = 0; i < system.equations(); ++i)
    for (int k = system.row_begin(i); k < system.row_begin(i + 1); ++k) j(i, system.column(k)) = entries[k];
  return j;
}

std::vector<double> distance_from_identity(const Eigen::MatrixXd& y, const IntervalMatrix& a) {
  CORANK_CHECK(UpwardRounding::active());
  std::vector<std::vector<int>> filled(a.columns);  // of each column the rows that are not 0: large matrices are sparse
  for (int j = 0; j < a.columns; ++j)
    for (int b = 0; b < a.rows; ++b)
      if (a(b, j).mag() > 0) filled[j].push_back(b);
  std::vector<double> result;
  for (int i = 0; i < a.rows; ++i)
    for (int j = 0; j < a.columns; ++j) {
      Interval e(i == j ? 1.0 : 0.0);
      for (const int b : filled[j]) e -= Interval(y(i, b)) * a(b, j);
      result.push_back(e.mag());
    }
  return result;
}

bool is_contraction(const std::vector<double>& e, const std::vector<double>& sizes) {
  constexpr int kCandidates = 6;
  const std::size_t n = sizes.size();
  CORANK_CHECK(e.size() == n * n && UpwardRounding::active());
  thread_local std::vector<double> r, next;  // both are written before they are read
  r = sizes;
  next.resize(n);
  for (int candidate = 0; candidate < kCandidates; ++candidate) {
    bool passes = true;
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0;  // rounded upward
      for (std::size_t j = 0; j < n; ++j) sum += e[i * n + j] * r[j];
      if (!std::isfinite(sum)) return false;
      next[i] = sum;
      passes = passes && sum < r[i];
      largest = std::max(largest, sum / sizes[i]);
    }
    if (passes) return true;
    for (std::size_t i = 0; i < n; ++i) r[i] = next[i] / largest + 0.05 * sizes[i];
  }
  return false;
}

std::optional<std::array<Box, 2>> halved(const Box& box, const std::vector<int>& sides, const std::vector<double>& scales) {
  if (sides.empty()) return std::nullopt;
  int widest = sides.front();
  for (const int j : sides)
    if (box[j].width() / scales[j] > box[widest].width() / scales[widest]) widest = j;
  const double lo = box[widest].lo(), middle = box[widest].mid(), hi = box[widest].hi();
  if (!(lo < middle && middle < hi)) return std::nullopt;
  std::array<Box, 2> halves{box, box};
  halves[0][widest] = Interval(lo, middle);
  halves[1][widest] = Interval(middle, hi);
  return halves;
}

}  // namespace corank::certify
