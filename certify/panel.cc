#include "corank/certify/panel.h"

#include <algorithm>
#include <cmath>

// The same loops for wider registers, chosen when the program starts. No fused operations: -ffp-contract=off.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define CORANK_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define CORANK_WIDE
#endif

namespace corank::certify {
namespace {

// One column of Y, split by sign, and the entries of S that it multiplies.
struct ColumnOfY {
  const double* positive;
  const double* negative;
  std::size_t rows;
};

// For each of `count` entries s in column columns[k]: (−lo, hi) of that column += y·(−lo_s, hi_s) by rows; y⁺ takes the ends as they are,
// y⁻ exchanges them.
CORANK_WIDE void add_scaled(const ColumnOfY& y, const Interval* entries, const int* columns, int count,
                            double* negated_lower, double* upper) {
  const double* __restrict const positive = y.positive;
  const double* __restrict const negative = y.negative;
  for (int k = 0; k < count; ++k) {
    const double l = -entries[k].lo(), h = entries[k].hi();
    double* __restrict const sum_l = negated_lower + static_cast<std::size_t>(columns[k]) * y.rows;
    double* __restrict const sum_h = upper + static_cast<std::size_t>(columns[k]) * y.rows;
    for (std::size_t a = 0; a < y.rows; ++a) {
      sum_l[a] += positive[a] * l + negative[a] * h;
      sum_h[a] += positive[a] * h + negative[a] * l;
    }
  }
}

// sums += P·[−o1, o2] with o1, o2 ≥ 0: hi = max(hi_P·o2, −lo_P·o1), −lo = max(hi_P·o1, −lo_P·o2).
CORANK_WIDE void add_product(const double* __restrict negated_lower, const double* __restrict upper, double o1, double o2,
                             double* __restrict sum_negated_lower, double* __restrict sum_upper, std::size_t rows) {
  for (std::size_t a = 0; a < rows; ++a) {
    const double h1 = upper[a] * o2, h2 = negated_lower[a] * o1, l1 = upper[a] * o1, l2 = negated_lower[a] * o2;
    sum_upper[a] += h1 > h2 ? h1 : h2;
    sum_negated_lower[a] += l1 > l2 ? l1 : l2;
  }
}

// `count` is a multiple of kLanes. ∞ and NaN times 0 are NaN; sums apart from each other need not wait for one another.
constexpr std::size_t kLanes = 4;
CORANK_WIDE bool all_finite(const double* __restrict a, const double* __restrict b, std::size_t count) {
  double witness[kLanes] = {};
  for (std::size_t k = 0; k < count; k += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) witness[lane] += 0 * a[k + lane] + 0 * b[k + lane];
  return witness[0] + witness[1] + witness[2] + witness[3] == 0;
}

}  // namespace

void Panel::set_matrix(const std::vector<double>& y, int r) {
  r_ = r;
  stride_ = (static_cast<std::size_t>(r) + kLanes - 1) / kLanes * kLanes;
  positive_.resize(static_cast<std::size_t>(r) * stride_);
  negative_.resize(positive_.size());
  for (int b = 0; b < r; ++b) {
    double* const positive = &positive_[index(0, b)];
    double* const negative = &negative_[index(0, b)];
    const double* value = y.data() + b;
    for (int a = 0; a < r; ++a, value += r) positive[a] = std::max(*value, 0.0), negative[a] = std::max(-*value, 0.0);
    std::fill(positive + r, positive + stride_, 0.0);
    std::fill(negative + r, negative + stride_, 0.0);
  }
}

bool Panel::assign_product(const CompiledSystem& system, const std::vector<int>& equations,
                           const std::vector<Interval>& sparse) {
  n_ = system.variables();
  negated_lower_.assign(static_cast<std::size_t>(n_) * stride_, 0.0);
  upper_.assign(static_cast<std::size_t>(n_) * stride_, 0.0);
  for (int b = 0; b < r_; ++b) {
    const int i = equations[static_cast<std::size_t>(b)];
    const int begin = system.row_begin(i);
    add_scaled({&positive_[index(0, b)], &negative_[index(0, b)], stride_}, sparse.data() + begin, system.columns() + begin,
               system.row_begin(i + 1) - begin, negated_lower_.data(), upper_.data());
  }
  return all_finite(negated_lower_.data(), upper_.data(), upper_.size());
}

void Panel::multiply(const std::vector<Interval>& values, std::vector<Interval>& result) const {
  std::vector<double> negated_lower(stride_, 0.0), upper(stride_, 0.0);
  const int one_column = 0;
  for (int b = 0; b < r_; ++b)
    add_scaled({&positive_[index(0, b)], &negative_[index(0, b)], stride_}, &values[static_cast<std::size_t>(b)],
               &one_column, 1, negated_lower.data(), upper.data());
  result.resize(static_cast<std::size_t>(r_));
  for (std::size_t a = 0; a < result.size(); ++a) result[a] = Interval(-negated_lower[a], upper[a]);
}

void Panel::accumulate(const Interval* offset, const std::vector<int>& dependent, Diagonal diagonal,
                       std::vector<Interval>& sums) {
  sum_negated_lower_.assign(stride_, 0.0);
  sum_upper_.assign(stride_, 0.0);
  for (std::size_t a = 0; a < static_cast<std::size_t>(r_); ++a) {
    sum_negated_lower_[a] = -sums[a].lo();
    sum_upper_[a] = sums[a].hi();
  }
  // The diagonal's own entries come back at the end.
  std::vector<Interval> own(dependent.size());
  bool finite = true;  // largest + 1 rounds to infinity
  for (int a = 0; a < r_; ++a) {
    const std::size_t k = index(a, dependent[static_cast<std::size_t>(a)]);
    own[static_cast<std::size_t>(a)] = Interval(-negated_lower_[k], upper_[k]);
    negated_lower_[k] = diagonal == Diagonal::zero ? 0 : negated_lower_[k] + 1;
    upper_[k] = diagonal == Diagonal::zero ? 0 : upper_[k] - 1;
    finite = finite && std::isfinite(negated_lower_[k]) && std::isfinite(upper_[k]);
  }
  for (int j = 0; j < n_; ++j) {
    double o1 = -offset[j].lo(), o2 = offset[j].hi();
    const std::size_t column = index(0, j);
    if (finite && o1 >= 0 && o2 >= 0 && std::isfinite(o1 + o2)) {  // no 0·∞
      add_product(&negated_lower_[column], &upper_[column], o1, o2, sum_negated_lower_.data(), sum_upper_.data(), stride_);
      continue;
    }
    for (int a = 0; a < r_; ++a) {
      const Interval term = at(a, j) * offset[j];
      sum_negated_lower_[static_cast<std::size_t>(a)] += -term.lo();
      sum_upper_[static_cast<std::size_t>(a)] += term.hi();
    }
  }
  for (int a = 0; a < r_; ++a) {
    const std::size_t k = index(a, dependent[static_cast<std::size_t>(a)]);
    negated_lower_[k] = -own[static_cast<std::size_t>(a)].lo();
    upper_[k] = own[static_cast<std::size_t>(a)].hi();
    sums[static_cast<std::size_t>(a)] =
        Interval(-sum_negated_lower_[static_cast<std::size_t>(a)], sum_upper_[static_cast<std::size_t>(a)]);
  }
}

}  // namespace corank::certify
