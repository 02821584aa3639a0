// How large can the kernel of M(q) be in a box? M is the kernel matrix of a system (certify/exact_verification.h), or any
// other matrix of polynomials in its variables; k its number of columns.
//
// Theorem: let N(q) be an s×s submatrix of M(q), Y real and r > 0. If |I − Y·N(B)| r < r, N(q) is regular for every q in the
// box B (a matrix A with ‖I − Y·A‖ < 1 in the norm max |x_i|/r_i is regular), so M(q) has rank ≥ s and its kernel a
// dimension ≤ k − s. At a solution of M(q) ξ = 0, ‖ξ‖ = 1 it is at least 1: where the bound is 1, the dimension is
// proven.
#pragma once

#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/exact_verification.h"
#include "corank/core/cover.h"
#include "corank/core/singularity_types.h"

namespace corank::certify {

class KernelBound {
 public:
  explicit KernelBound(const System& system);
  /// Of another matrix: its rank is k − at_most() at least.
  KernelBound(const System& system, const PolynomialMatrix& matrix);

  /// False: the system has no kernel equations.
  bool applies() const { return rows_ > 0; }
  /// No q in the box has a kernel of larger dimension. The largest s for which the theorem applies to the submatrix that
  /// elimination at the midpoint picks (of another matrix only the three largest s are tried); k where none does. Where that
  /// is above the least that a kernel may have (1; of another matrix the columns that it has more than rows), the largest
  /// bound of the box's parts: its sides that M depends on are halved, the widest first, `halvings` times at most. Requires
  /// applies() and UpwardRounding::active().
  int at_most(const Box& box, int halvings = 0) const;

 private:
  int at_most_in_one(const Box& box) const;

  int rows_, columns_, least_;
  int most_tries_ = 3;          // sizes of a submatrix of another matrix: its rank is full, or nearly, or of no use
  std::vector<int> arguments_;  // variables in M
  CompiledSystem compiled_;     // value rows: M's entries, row by row
};

}  // namespace corank::certify
