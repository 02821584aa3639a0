// Sines and cosines of intervals, their slopes, and their inverse images. Every function requires UpwardRounding::active().
//
// At a point: x = kπ/2 + r with |r| < 1, and by Taylor's theorem
//   sin r = Σ_{j<n} (−1)^j r^{2j+1}/(2j+1)! + (−1)^n θ r^{2n+1}/(2n+1)!
//   cos r = Σ_{j<n} (−1)^j r^{2j}/(2j)!     + (−1)^n θ r^{2n}/(2n)!
// with θ = cos ξ ∈ [0, 1] for some |ξ| ≤ |r|, evaluated in interval arithmetic with π an interval.
//
// Over an interval: the extremes are taken at its ends and at those points (j + p/2)π, j an integer, that it holds (p = 0
// for the cosine, 1 for the sine), where the value is (−1)^j. A point that may be inside counts as inside.
#pragma once

#include <optional>

#include "corank/core/interval.h"

namespace corank::certify {

/// Beyond this (20 million turns) arguments give no information: the sine and cosine are enclosed by [−1, 1].
inline constexpr double kMaxArgument = 0x1p27;

/// {sin x : x ∈ X}, {cos x : x ∈ X}: within a few units in the last place.
Interval sine(const Interval& x);
Interval cosine(const Interval& x);

/// s with f(x) − f(c) ∈ s·(x − c) for every x ∈ X, c inside X or not. Theorem: with m = (x + c)/2 and h = (x − c)/2,
///   sin x − sin c = 2 cos m sin h,   cos x − cos c = −2 sin m sin h,   1 − h²/6 ≤ sin(h)/h ≤ 1,
/// so that the slope is f'(m)·sin(h)/h. Where X − c is wide: the derivative over the hull of X and c (mean value theorem).
Interval sine_slope(const Interval& x, double c);
Interval cosine_slope(const Interval& x, double c);

/// hull{x ∈ within : sin x ∈ Y}, hull{x ∈ within : cos x ∈ Y}; nothing where that is empty.
/// Theorem: with A = acos(Y ∩ [−1, 1]), cos x ∈ Y ⇔ x ∈ ∪_k (2πk − A) ∪ (2πk + A); and sin x = cos(x − π/2).
std::optional<Interval> inverse_sine(const Interval& y, const Interval& within);
std::optional<Interval> inverse_cosine(const Interval& y, const Interval& within);

}  // namespace corank::certify
