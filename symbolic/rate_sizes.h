// How large the rates of a mechanism's own velocity equation are beside one another, so that its kernel vectors do not depend
// on the unit of length.
//
// An angular rate is 1. A linear rate v_j in a row Σ_k L_ik m_k = 0 with an angular rate ω_k is as fast as |L_ik| / |L_ij|
// where ω_k is 1: a lever arm. A row with linear rates only passes the size of one on to the others. All lengths times f: a
// coefficient of dimension length^p becomes f^p times as large, and each of these numbers f times.
#pragma once

#include <vector>

#include "corank/core/interval.h"
#include "corank/symbolic/singularity_system.h"

namespace corank::symbolic {

/// max |M_ij(q)| over a box of the model's polynomial system, in doubles, a row for each of M's.
std::vector<std::vector<double>> entry_sizes(const Mechanism& mechanism, const ExpressionMatrix& matrix,
                                             const std::vector<Interval>& box);

/// Of each column of M: 0 for an angular rate; else the largest of those numbers. Linear rates that no row ties to an
/// angular one get the largest of the others, 1 where there is none.
std::vector<double> rate_sizes(const Mechanism& mechanism, const ExpressionMatrix& matrix,
                               const std::vector<std::vector<double>>& entries);

}  // namespace corank::symbolic
