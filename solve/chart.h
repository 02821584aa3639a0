// Which variables to leave free in a proof, so that the proven sheet is covered by few boxes. Heuristic: a proof is valid
// for any choice.
//
// The tangent space of the set at a point is spanned by the k columns of an n×k matrix T: row a holds ∂(variable a)/∂(free
// f), a unit vector where a is free. Exchanging the free f for a dependent a multiplies the volume of a piece, as measured
// in the free variables, by |T_af|: the chart in which that volume is largest has |T_af| ≤ 1 throughout, so that a box with
// free sides w has no side beyond Σ w_f.
#pragma once

#include <vector>

namespace corank::solve {

struct Chart {
  std::vector<double> tangent;  ///< n×k, row-major
  std::vector<int> free;        ///< k row indices
};

constexpr double kChartGain = 1.05;  ///< an exchange costs a new elimination

/// Exchanges free variables for others until no exchange multiplies the volume by more than `gain`. Source: maximal-volume
/// submatrices, key Goreinov2010.
void improve(Chart& chart, double gain = kChartGain);

}  // namespace corank::solve
