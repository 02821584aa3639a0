// Between intervals and the plain doubles in which proofs look for their real matrices. Inside certify/ only.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/inertia.h"
#include "corank/core/cover.h"

namespace corank::certify {

/// Of each entry its midpoint.
Eigen::MatrixXd middle(const IntervalMatrix& m);

/// The matrix whose only member is m.
IntervalMatrix exactly(const Eigen::MatrixXd& m);

/// The equations' Jacobian at a point, in plain floating point: nothing is proven by it.
Eigen::MatrixXd approximate_jacobian(const CompiledSystem& system, const std::vector<double>& point);

/// ≥ |I − Y·A| for a finite Y and every A in the interval matrix, row by row. Requires UpwardRounding::active().
std::vector<double> distance_from_identity(const Eigen::MatrixXd& y, const IntervalMatrix& a);

/// Is a matrix E ≥ 0, n×n, row by row, a contraction in some norm ‖x‖ = max |x_i|/r_i: E·r ≤ α·r with r > 0 and α < 1,
/// rounded upward? Such an r exists exactly where the spectral radius of E is below 1. The candidates come from power
/// iteration, the first one is `sizes`, so that the units of the unknowns do not matter; false where none of a few
/// passes. Theorem: then I − A is regular for every A with |A| ≤ E, since ‖A‖ ≤ α < 1. Requires UpwardRounding::active().
bool is_contraction(const std::vector<double>& e, const std::vector<double>& sizes);

/// The halves of a box, cut in the middle of one of these sides: the one that is widest in units of its scale. Nothing where
/// there is no side, or where doubles do not cut that one.
std::optional<std::array<Box, 2>> halved(const Box& box, const std::vector<int>& sides, const std::vector<double>& scales);

}  // namespace corank::certify
