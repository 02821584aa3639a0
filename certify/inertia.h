// How many eigenvalues of a symmetric matrix are positive and negative, on all of space or on the kernel of another matrix:
// the index of a critical point, the sign of a second-order form; and the signs of determinants.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/interval.h"

namespace corank::certify {

struct Inertia {
  int positive = 0, negative = 0;
  friend bool operator==(const Inertia&, const Inertia&) = default;
};

/// Row-major, rows × columns.
struct IntervalMatrix {
  int rows = 0, columns = 0;
  std::vector<Interval> entries;

  IntervalMatrix(int r, int c) : rows(r), columns(c), entries(r * c) {}
  Interval& operator()(int i, int j) { return entries[i * columns + j]; }
  const Interval& operator()(int i, int j) const { return entries[i * columns + j]; }
};

/// Encloses PᵀMP. Requires UpwardRounding::active().
IntervalMatrix congruent(const IntervalMatrix& m, const IntervalMatrix& p);

/// The inertia that every symmetric matrix in H has, none of whose eigenvalues is 0 then; nothing where it is not shown.
/// Requires UpwardRounding::active(). Theorem (Sylvester, Gershgorin): let Q be any real matrix and T = QᵀHQ have |T_ii| >
/// Σ_{j≠i} |T_ij| in each row. Then T, and each diag(T) + t·(T − diag(T)) with 0 ≤ t ≤ 1, is regular: its eigenvalues keep
/// their signs from t = 0 on, where they are T's diagonal. T is regular, so Q is, and H has T's inertia.
std::optional<Inertia> inertia(const IntervalMatrix& h);

/// A basis of ker A as the columns of an interval matrix, n×(n − m), the dependent rows of a vector expressed by the
/// others, whose block is the identity, in ascending order: what every A in the interval matrix has. Nothing where A_D is
/// not shown to be regular. `sizes`: positive, typical of each unknown, for the choice of a norm; none: all are 1.
/// Theorem: let A_D be the m dependent columns of A, A_F the others, Y real, |I − Y·A_D|·r ≤ α·r with α < 1 and r the
/// sizes of the dependent unknowns. Then A_D is regular, and the columns of V, V_F = I and V_D = −A_D⁻¹A_F, are a basis of
/// ker A: X = A_D⁻¹A_F obeys X = R + (I − Y·A_D)X with R = Y·A_F, so, in the norm max |x_i|/r_i and column by column,
/// ‖X‖ ≤ ‖R‖/(1 − α), and X ∈ R + |I − Y·A_D|·r·‖R‖/(1 − α)·[−1, 1].
std::optional<IntervalMatrix> kernel_basis(const IntervalMatrix& a, const std::vector<int>& dependent,
                                           const std::vector<double>& sizes = {});

/// The inertia of the form v ↦ vᵀHv on ker A, for every H and A in the interval matrices (n×n symmetric, m×n): ker A has
/// the dimension n − m then. Nothing where it is not shown. Requires UpwardRounding::active(). The form's matrix in the
/// basis V of kernel_basis() is VᵀHV.
std::optional<Inertia> inertia_on_kernel(const IntervalMatrix& h, const IntervalMatrix& a);

/// The sign of a determinant: ±1, or 0 where it is not shown. Requires a square matrix and UpwardRounding::active(). Theorem
/// (interval Gaussian elimination, key Neumaier1990, ch. 4): for each matrix A in the interval matrix, elimination with rows
/// and columns exchanged alike keeps det A but for the exchanges' signs; the pivots of A lie in the interval pivots, so none
/// is 0 where none of those has a 0, and det A is their product.
int determinant_sign(IntervalMatrix a);

}  // namespace corank::certify
