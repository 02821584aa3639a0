// A solution that is known exactly: all its coordinates are polynomials, with rational coefficients, in one real algebraic
// number t.
//
// t is the only root of `polynomial` between `lower` and `upper`, where the polynomial has opposite signs. So an equation
// F(x) = 0 with rational coefficients holds at the point if F(x(t)) is divisible by the polynomial: exact arithmetic with
// rational numbers decides.
#pragma once

#include <vector>

#include "corank/core/exact_number.h"
#include "corank/core/singularity_types.h"

namespace corank {

/// Coefficients of 1, t, t² … ; rational.
using RationalPolynomial = std::vector<ExactNumber>;

struct ExactPoint {
  RationalPolynomial polynomial;  ///< t itself where the point is rational
  ExactNumber lower, upper;       ///< rational
  /// Of each variable of the system. No coefficients: nothing is said of that variable (the kernel vector where it is a
  /// continuum).
  std::vector<RationalPolynomial> coordinates;
  /// Dimension of the kernel of the matrix M(q) in the system's kernel equations M(q) ξ = 0 at this point; −1: the system
  /// has none.
  int corank = -1;
  /// > 0: no other solution has all its variables within this distance of the point's (proven by blow-up,
  /// certify/blow_up.h). 0: nothing is said.
  double sole_within = 0;
  TypeLabels types = {};  ///< of its configuration, by exact ranks

  friend bool operator==(const ExactPoint&, const ExactPoint&) = default;
};

}  // namespace corank
