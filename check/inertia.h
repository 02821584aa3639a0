// Kernels of matrices, and forms on them: the checker's own.
#pragma once

#include <optional>
#include <vector>

#include "corank/check/rows.h"

namespace corank::check {

struct Inertia {
  int positive = 0, negative = 0;
  friend bool operator==(const Inertia&, const Inertia&) = default;
};

/// Of every matrix A in m rows of enclosures, whose columns are as many dependent ones and the free ones: the basis V of its
/// kernel whose block of the free columns, in their order, is the identity, column by column; nothing where none is shown.
/// Theorem: (Y·A_D)·V_D = −Y·A_F for every real Y, here about the inverse of A_D. Elimination without a pivot that may be 0
/// encloses the one solution.
std::optional<std::vector<Sides>> kernel_basis(const std::vector<Sides>& a, const std::vector<int>& dependent,
                                               const std::vector<int>& free);

/// The form v ↦ vᵀHv on ker A in such a basis, for every symmetric H and every A in the enclosures (n×n; m×n, row by row):
/// ker A has the dimension n − m. Nothing where that is not shown.
std::optional<std::vector<Sides>> form_on_kernel(const std::vector<Sides>& h, const std::vector<Sides>& a);

/// QᵀTQ for every symmetric T in the enclosures, with one real Q, of about its eigenvectors. Nothing where there is no T.
std::optional<std::vector<Sides>> nearly_diagonal(const std::vector<Sides>& t);

/// Of every symmetric T in the enclosures, which is regular; nothing where that is not shown. Theorem (Gauss; Sylvester):
/// QᵀTQ = L·D·Lᵀ by elimination without exchange, where no pivot in D may be 0: so Q is regular, and T has as many positive
/// and negative eigenvalues as D has such entries.
std::optional<Inertia> inertia(const std::vector<Sides>& t);
std::optional<Inertia> inertia_on_kernel(const std::vector<Sides>& h, const std::vector<Sides>& a);

/// The sign of the determinant of every matrix in the enclosures, row by row, by the pivots of its elimination; 0 where it
/// is not shown.
int determinant_sign(std::vector<Sides> a);

}  // namespace corank::check
