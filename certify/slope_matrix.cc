#include "corank/certify/slope_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "corank/core/lanes.h"

namespace corank::certify {
namespace {

// A real matrix, split by sign. `rows` is a multiple of kLanes.
struct SplitMatrix {
  const double* positive;
  const double* negative;
  std::size_t rows;
};

// (−lo, hi) of the matrix's columns += Y·S by rows, S's rows `equations` sparse: y⁺ takes the ends of an entry as they are,
// y⁻ exchanges them.
CORANK_WIDE void add_sparse_product(const SplitMatrix& y, const CompiledSystem& system, const std::vector<int>& equations,
                                    const Interval* sparse, double* negated_lower, double* upper) {
  const std::size_t rows = y.rows;
  const double* positive = y.positive;
  const double* negative = y.negative;
  for (const int i : equations) {
    const int end = system.row_begin(i + 1);
    for (int k = system.row_begin(i); k < end; ++k) {
      const double l = sparse[k].neg_lo(), h = sparse[k].hi();
      const std::size_t column = system.column(k) * rows;
      for (std::size_t a = 0; a < rows; a += kLanes) {
        lanes(negated_lower + column + a) += lanes(positive + a) * l + lanes(negative + a) * h;
        lanes(upper + column + a) += lanes(positive + a) * h + lanes(negative + a) * l;
      }
    }
    positive += rows;
    negative += rows;
  }
}

// (−lo, hi) of the result := Y·x.
CORANK_WIDE void multiply_vector(const SplitMatrix& y, const Interval* x, int count, double* negated_lower, double* upper) {
  for (std::size_t a = 0; a < y.rows; a += kLanes) {
    Lanes sum_l = {}, sum_h = {};
    for (int b = 0; b < count; ++b) {
      const double l = x[b].neg_lo(), h = x[b].hi();
      const std::size_t k = b * y.rows + a;
      sum_l += lanes(y.positive + k) * l + lanes(y.negative + k) * h;
      sum_h += lanes(y.positive + k) * h + lanes(y.negative + k) * l;
    }
    lanes(negated_lower + a) = sum_l;
    lanes(upper + a) = sum_h;
  }
}

// sums := P·o for finite offsets o = [−o1, o2], P = [−l, h]. −lo and hi of an entry's product are the larger of two
// products, chosen by the signs of o1, o2. In row diagonal[j] of column j (−1: none) stands the entry less 1 if
// minus_one, else 0: exchanged in registers, since a store would delay the loads after it.
CORANK_WIDE void multiply_matrix(const double* negated_lower, const double* upper, std::size_t rows, const Interval* offset,
                                 int columns, const double* diagonal, bool minus_one, double* sum_negated_lower,
                                 double* sum_upper) {
  for (std::size_t a = 0; a < rows; a += kLanes) {
    const double first = static_cast<double>(a);
    const Lanes row = {first, first + 1, first + 2, first + 3};
    Lanes sum_l = {}, sum_h = {};
    for (int j = 0; j < columns; ++j) {
      const double o1 = offset[j].neg_lo(), o2 = offset[j].hi();
      const std::size_t k = j * rows + a;
      const Lanes l = lanes(negated_lower + k), h = lanes(upper + k), zero = {};
      const auto exchange = row == diagonal[j];
      const Lanes p_l = exchange ? (minus_one ? l + 1 : zero) : l, p_h = exchange ? (minus_one ? h - 1 : zero) : h;
      Lanes h1, h2, l1, l2;
      if (o1 >= 0 && o2 >= 0) {
        h1 = p_h * o2, h2 = p_l * o1;
        l1 = p_h * o1, l2 = p_l * o2;
      } else if (o1 < 0) {
        h1 = p_h * o2, h2 = p_h * -o1;
        l1 = p_l * o2, l2 = p_l * -o1;
      } else {
        h1 = p_l * o1, h2 = p_l * -o2;
        l1 = p_h * o1, l2 = p_h * -o2;
      }
      sum_h += h1 > h2 ? h1 : h2;
      sum_l += l1 > l2 ? l1 : l2;
    }
    lanes(sum_negated_lower + a) = sum_l;
    lanes(sum_upper + a) = sum_h;
  }
}

// sums += weight·|P_j|, by rows.
CORANK_WIDE void add_magnitudes(const double* negated_lower, const double* upper, std::size_t rows, double weight,
                                double* sums) {
  for (std::size_t a = 0; a < rows; a += kLanes) {
    const Lanes l = lanes(negated_lower + a), h = lanes(upper + a);
    lanes(sums + a) += weight * (l > h ? l : h);
  }
}

// `count` is a multiple of kLanes. ∞ and NaN times 0 are NaN; sums apart from each other need not wait for one another.
CORANK_WIDE bool all_finite(const double* __restrict a, const double* __restrict b, std::size_t count) {
  double witness[kLanes] = {};
  for (std::size_t k = 0; k < count; k += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) witness[lane] += 0 * a[k + lane] + 0 * b[k + lane];
  return witness[0] + witness[1] + witness[2] + witness[3] == 0;
}

}  // namespace

bool SlopeMatrix::set_matrix(const std::vector<double>& y, int r) {
  if (r > 0 && r == r_ && y.size() == y_.size() && std::memcmp(y.data(), y_.data(), y.size() * sizeof(double)) == 0)
    return finite_;
  y_ = y;
  finite_ = std::ranges::all_of(y, [](double entry) { return std::isfinite(entry); });
  r_ = r;
  stride_ = whole_lanes(r);
  positive_.resize(r * stride_);
  negative_.resize(positive_.size());
  for (int b = 0; b < r; ++b) {
    double* const positive = &positive_[index(0, b)];
    double* const negative = &negative_[index(0, b)];
    const double* value = y.data() + b;
    for (int a = 0; a < r; ++a, value += r) positive[a] = std::max(*value, 0.0), negative[a] = std::max(-*value, 0.0);
    std::fill(positive + r, positive + stride_, 0.0);
    std::fill(negative + r, negative + stride_, 0.0);
  }
  return finite_;
}

bool SlopeMatrix::assign_product(const CompiledSystem& system, const std::vector<int>& equations,
                                 const std::vector<Interval>& sparse) {
  n_ = system.variables();
  negated_lower_.assign(n_ * stride_, 0.0);
  upper_.assign(n_ * stride_, 0.0);
  add_sparse_product({positive_.data(), negative_.data(), stride_}, system, equations, sparse.data(), negated_lower_.data(),
                     upper_.data());
  return all_finite(negated_lower_.data(), upper_.data(), upper_.size());
}

void SlopeMatrix::multiply(const std::vector<Interval>& values, std::vector<Interval>& result) {
  sum_negated_lower_.resize(stride_);
  sum_upper_.resize(stride_);
  multiply_vector({positive_.data(), negative_.data(), stride_}, values.data(), r_, sum_negated_lower_.data(),
                  sum_upper_.data());
  result.resize(r_);
  for (std::size_t a = 0; a < result.size(); ++a) result[a] = Interval(-sum_negated_lower_[a], sum_upper_[a]);
}

void SlopeMatrix::accumulate(const Interval* offset, const std::vector<int>& dependent, Diagonal diagonal,
                             std::vector<Interval>& sums) {
  const bool minus_one = diagonal == Diagonal::minus_one;
  bool plain = true;  // no 0·∞
  for (int j = 0; j < n_; ++j) plain = plain && offset[j].is_bounded();
  const auto entry = [&](int a, int d) { return minus_one ? at(a, d) - Interval(1.0) : Interval(); };
  for (int a = 0; a < r_ && plain && minus_one; ++a)
    plain = entry(a, dependent[a]).is_bounded();  // largest + 1 rounds to infinity
  if (plain) {
    diagonal_.assign(n_, -1.0);
    for (int a = 0; a < r_; ++a) diagonal_[dependent[a]] = a;
    sum_negated_lower_.resize(stride_);
    sum_upper_.resize(stride_);
    multiply_matrix(negated_lower_.data(), upper_.data(), stride_, offset, n_, diagonal_.data(), minus_one,
                    sum_negated_lower_.data(), sum_upper_.data());
    for (int a = 0; a < r_; ++a) sums[a] += Interval(-sum_negated_lower_[a], sum_upper_[a]);
    return;
  }
  for (int a = 0; a < r_; ++a) {
    const int d = dependent[a];
    for (int j = 0; j < n_; ++j) sums[a] += (j == d ? entry(a, d) : at(a, j)) * offset[j];
  }
}

double SlopeMatrix::distance_from_identity(const std::vector<int>& dependent, const std::vector<double>& weights) {
  sum_upper_.assign(stride_, 0.0);
  for (std::size_t a = 0; a < dependent.size(); ++a) {
    const std::size_t column = index(0, dependent[a]);
    const double others = sum_upper_[a], weight = weights[dependent[a]];
    add_magnitudes(&negated_lower_[column], &upper_[column], stride_, weight, sum_upper_.data());
    sum_upper_[a] = others + weight * (Interval(1.0) - at(static_cast<int>(a), dependent[a])).mag();
  }
  double largest = 0;
  for (std::size_t a = 0; a < dependent.size(); ++a) largest = std::max(largest, sum_upper_[a] / weights[dependent[a]]);
  return largest;
}

}  // namespace corank::certify
