// From a cosine and a sine back to an angle, with proof.
#pragma once

#include "corank/core/interval.h"

namespace corank::certify {

/// An interval A of radians such that every point (c, s) ≠ 0 of the box C × S has one of its angles in A, a continuous one
/// where the box does not hold the origin: the hull of the angles, rounded outward by MPFR (Fousse et al. 2007, correct
/// rounding). A box across the negative c-axis yields one interval beyond π rather than two pieces; k is chosen so that A
/// lies in `range` where some k makes that possible, otherwise so that it overlaps `range` most (k = 0 where that is a tie).
/// A box that holds the origin says nothing about the angle: [−π, π] + 2πk. Correct in any rounding mode.
///
/// Proves nothing about `range`: A may stick out of it.
Interval angle_enclosure(const Interval& c, const Interval& s, const Interval& range);

}  // namespace corank::certify
