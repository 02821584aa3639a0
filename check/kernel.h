// How large can the kernel of M(q) be in a box? M(q) ξ = 0 are the equations that are linear in the variables of kind
// kernel; of several kernel vectors those in ξ¹ alone.
//
// Theorem: let N(q) be an s×s submatrix of M(q) and Y real. If |I − Y·N(B)| x < x for some x > 0, N(q) is regular for every
// q in B, so M(q) has rank ≥ s there, and its kernel a dimension ≤ k − s, k the number of columns.
#pragma once

#include <vector>

#include "corank/check/rows.h"
#include "corank/check/stop.h"
#include "corank/core/cover.h"
#include "corank/core/singularity_types.h"

namespace corank::check {

/// M(q), over the variables of the system: no columns where it has no kernel.
PolynomialMatrix kernel_matrix(const System& system);

class KernelCheck {
 public:
  explicit KernelCheck(const System& system, const StopFlag& stop = {})
      : KernelCheck(system, kernel_matrix(system), stop, system.coefficient_tolerance) {}
  /// Of any other matrix, over the variables of the system.
  KernelCheck(const System& system, const PolynomialMatrix& matrix, const StopFlag& stop, double tolerance = 0);

  /// Number of kernel variables of one vector; columns of the other matrix.
  int columns() const { return columns_; }
  /// Is there no q in the box with a kernel of a dimension > most? Bisects the box where need be; false: not shown.
  bool is_at_most(int most, const Box& box) const;

 private:
  bool has_rank(std::size_t s, const Sides& x) const;

  StopFlag stop_;
  int columns_ = 0;
  RowMatrix rows_;
  std::vector<int> arguments_;   // the variables that M depends on
  std::vector<double> lengths_;  // of the variables' domains
};

}  // namespace corank::check
