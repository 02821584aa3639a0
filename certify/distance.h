// Are two convex bodies (core/requirement.h) as far apart as required at every zero of a system in a box, or at none?
#pragma once

#include <span>

#include "corank/certify/requirement.h"

namespace corank::certify {

/// satisfied (violated): at every zero at which the forms hold they are (are not). Requires UpwardRounding::active().
///
/// Theorem (apart): let e(q) be any vector, a_i(q) the points of one body and b_j(q) those of the other. e·(a − b) of a
/// point of each hull is a mean of the e·(a_i − b_j), and at most ‖e‖ ‖a − b‖. So where e·(a_i − b_j) ≥ least·‖e‖ > 0 for
/// all i and j, the hulls are `least` or more apart. e turns with the offsets as the faces do that hold the nearest points
/// at their centre; to first order nothing is lost then.
/// Theorem (near): let λ and μ be weights, none negative, each of sum 1. V = Σ λ_i a_i − Σ μ_j b_j goes from one hull to the
/// other. With any vector e and c = e·V: ‖V‖² = c² (2 − ‖e‖²) + ‖V − c e‖². So where that is below least², they are nearer.
Standing standing(const DistanceTest& test, const FormOfVariable& form, std::span<const Interval> offsets);

}  // namespace corank::certify
