// Y·S for a real r×r matrix Y and a sparse interval matrix S, and its products with interval vectors: the inner loops of the
// interval Newton operator.
//
// Stored by columns, lower ends negated and apart from upper ones, so that one instruction works on several rows of a
// column. Every sum and product is rounded upward, which bounds −lo and hi from above. Functions require
// UpwardRounding::active().
#pragma once

#include <cstddef>
#include <vector>

#include "corank/certify/compiled_system.h"

namespace corank::certify {

class SlopeMatrix {
 public:
  /// Y, r×r row-major. False where an entry is not finite: then nothing else may be called. A matrix that is set already
  /// stays as it is.
  bool set_matrix(const std::vector<double>& y, int r);

  /// The matrix becomes Y·S, r×n, S the rows `equations` of a matrix in the system's sparsity pattern. False where an entry
  /// is not finite: then it may not be used.
  bool assign_product(const CompiledSystem& system, const std::vector<int>& equations, const std::vector<Interval>& sparse);

  /// result[a] := Σ_b Y_ab values[b], for finite values.
  void multiply(const std::vector<Interval>& values, std::vector<Interval>& result);

  /// sums[a] += Σ_j P_aj offset[j], P the matrix with `diagonal` in place of the entries (a, dependent[a]).
  enum class Diagonal { zero, minus_one };  ///< 0; the entry − 1
  void accumulate(const Interval* offset, const std::vector<int>& dependent, Diagonal diagonal, std::vector<Interval>& sums);

  /// The largest weighted row sum Σ_k |I − P_D|_ak w_k / w_a, D the columns dependent[0], dependent[1], …, and w_a > 0 the
  /// weight of the variable dependent[a].
  double distance_from_identity(const std::vector<int>& dependent, const std::vector<double>& weights);

  /// row[j] −= factor·P_aj for every column j, for a finite factor.
  void subtract_row(double factor, int a, Interval* row) const {
    const bool negative = factor < 0;
    const double* lower = (negative ? negated_lower_ : upper_).data() + a;
    const double* upper = (negative ? upper_ : negated_lower_).data() + a;
    const __m128d size = _mm_set1_pd(std::fabs(factor));
    for (int j = 0; j < n_; ++j, lower += stride_, upper += stride_)
      row[j] += Interval::from_register(_mm_mul_pd(size, _mm_set_pd(*upper, *lower)));
  }

  Interval at(int a, int j) const { return {-negated_lower_[index(a, j)], upper_[index(a, j)]}; }
  int rows() const { return r_; }
  int columns() const { return n_; }

 private:
  std::size_t index(int a, int j) const { return j * stride_ + a; }

  int r_ = 0, n_ = 0;
  std::size_t stride_ = 0;                     // r rounded up to a multiple of 4
  std::vector<double> y_;                      // as it was set
  bool finite_ = false;                        // all of y_
  std::vector<double> positive_, negative_;    // column b: max(Y_ab, 0), max(−Y_ab, 0)
  std::vector<double> negated_lower_, upper_;  // column j of the matrix
  std::vector<double> sum_negated_lower_, sum_upper_;
  std::vector<double> diagonal_;  // of each column the row whose dependent it is, −1: none; doubles, to be compared in lanes
};

}  // namespace corank::certify
