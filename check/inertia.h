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

/// A basis V of ker A, row by row, for every A in the enclosures (m×n, row by row), whose columns are m dependent and n − m
/// free ones. The free rows of V, in the order of `free`, are the identity. Nothing where no basis is shown.
/// Theorem: (Y·A_D)·V_D = −Y·A_F for every real Y, here about the inverse of A_D. Elimination without a pivot that may be 0
/// shows that A_D is regular, and encloses the one solution V_D.
std::optional<std::vector<Sides>> kernel_basis(const std::vector<Sides>& a, const std::vector<int>& dependent,
                                               const std::vector<int>& free);

/// The form v ↦ vᵀHv on ker A in such a basis, for every symmetric H and every A in the enclosures (n×n; m×n, row by row):
/// ker A has the dimension n − m. Nothing where that is not shown.
std::optional<std::vector<Sides>> form_on_kernel(const std::vector<Sides>& h, const std::vector<Sides>& a);

/// QᵀTQ for every symmetric T in the enclosures. The columns of the one real Q are about eigenvectors. Nothing where there
/// is no such T, or no such Q is found.
std::optional<std::vector<Sides>> nearly_diagonal(const std::vector<Sides>& t);

/// The inertia that every symmetric T in the enclosures has; each of them is regular. Nothing where that is not shown.
/// Theorem (Gauss; Sylvester): with any real Q, here that of nearly_diagonal(), QᵀTQ = L·D·Lᵀ by elimination without
/// exchange, where no pivot in D may be 0: so Q is regular, and T has as many positive and negative eigenvalues as D has
/// such entries.
std::optional<Inertia> inertia(const std::vector<Sides>& t);
/// That of form_on_kernel().
std::optional<Inertia> inertia_on_kernel(const std::vector<Sides>& h, const std::vector<Sides>& a);

/// The sign of the determinant of every matrix in the enclosures, row by row, by the pivots of its elimination; 0 where it
/// is not shown.
int determinant_sign(std::vector<Sides> a);

}  // namespace corank::check
