// The determinant of every matrix in an interval matrix, and its sign.
#pragma once

#include "corank/certify/inertia.h"

namespace corank::certify {

/// Encloses det A for every A in the n×n interval matrix, n ≤ 12; 1 for n = 0. Requires UpwardRounding::active(). Theorem
/// (Laplace): the minor of the first k rows and k columns S is the alternating sum over j ∈ S of the entries of row k with
/// the minors of the first k − 1 rows and S∖{j}.
Interval determinant(const IntervalMatrix& a);

/// ±1, or 0 where it is not shown. Requires a square matrix and UpwardRounding::active(). Theorem (interval Gaussian
/// elimination, key Neumaier1990, ch. 4): for each matrix A in the interval matrix, elimination with rows and columns
/// exchanged alike keeps det A but for the exchanges' signs; the pivots of A lie in the interval pivots, so none is 0 where
/// none of those has a 0, and det A is their product.
int determinant_sign(IntervalMatrix a);

}  // namespace corank::certify
