// The determinant of every matrix in an interval matrix.
#pragma once

#include "corank/certify/inertia.h"

namespace corank::certify {

/// Encloses det A for every A in the n×n interval matrix, n ≤ 12; 1 for n = 0. Requires UpwardRounding::active(). Theorem
/// (Laplace): the minor of the first k rows and k columns S is the alternating sum over j ∈ S of the entries of row k with
/// the minors of the first k − 1 rows and S∖{j}.
Interval determinant(const IntervalMatrix& a);

}  // namespace corank::certify
