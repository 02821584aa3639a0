// How many directions lead up and down at a critical point: the checker's own.
#pragma once

#include <optional>
#include <vector>

#include "corank/check/rows.h"

namespace corank::check {

struct Inertia {
  int positive = 0, negative = 0;
  friend bool operator==(const Inertia&, const Inertia&) = default;
};

/// Of the form v ↦ vᵀHv on ker A, for every symmetric H and every A in the enclosures (n×n; m×n, row by row): ker A has the
/// dimension n − m, and the form is regular on it. Nothing where that is not shown.
///
/// Theorem (Gauss; Sylvester): eliminating A with pivots none of which may be 0 turns every A into (I, G) but for the
/// order of its columns, with the same kernel, whose basis V is (−G; I). The form in it is T = VᵀHV. With any real Q, QᵀTQ
/// = L·D·Lᵀ by elimination without exchange, where no pivot in D may be 0: so Q is regular, and T has as many positive and
/// negative eigenvalues as D has such entries.
std::optional<Inertia> inertia_on_kernel(const std::vector<Sides>& h, std::vector<Sides> a);

/// The sign of the determinant of every matrix in the enclosures, row by row, by the pivots of its elimination; 0 where it
/// is not shown.
int determinant_sign(std::vector<Sides> a);

}  // namespace corank::check
