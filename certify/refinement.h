// Many digits of a solution, proven by Krawczyk's test with as many bits as it takes.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "corank/core/ended.h"
#include "corank/core/system.h"

namespace corank::certify {

struct ProvenZero {
  std::vector<std::pair<ExactNumber, ExactNumber>> sides;  ///< rational bounds of each variable
  int bits = 0;                                            ///< of the arithmetic that proved them
};

/// For a square system: a box about a zero near `start`, no wider than 10^−digits · max(1, |x|), in which there is **exactly
/// one** zero.
/// Theorem (Krawczyk; keys Krawczyk1969, Neumaier1990 ch. 5): c a point, Y real, K = c − Y·F(c) + (I − Y·J(X))(X − c), J(X)
/// the interval Jacobian. K ⊂ int X ⇒ exactly one zero in X, and it lies in K. The arithmetic (MPFI) has 53, 106, 212 …
/// bits, until the test succeeds and the box is narrow enough, or `max_bits` are not enough, or `ended` is true: then
/// nothing is proven. Says nothing about the domain and the inequalities.
std::optional<ProvenZero> prove_zero(const System& system, const std::vector<ExactNumber>& start, int digits,
                                     int max_bits = 8192, const Ended& ended = {});

/// Rational bounds of {f(x) : x within the sides}, computed with `bits` bits.
std::pair<ExactNumber, ExactNumber> bounds(const Polynomial& f,
                                           const std::vector<std::pair<ExactNumber, ExactNumber>>& sides, int bits);

/// A decimal of the number in [lower, upper] that is wrong by less than one unit of its last digit, with as many digits
/// after the point as that allows, `digits` at most: "0.7071067811". A rational number with a short decimal is that decimal.
std::string proven_decimal(const ExactNumber& lower, const ExactNumber& upper, int digits);

}  // namespace corank::certify
