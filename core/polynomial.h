// Polynomials with exact coefficients, and multiples of sines and cosines of single variables.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "corank/core/exact_number.h"
#include "corank/core/interval.h"

namespace corank {

/// What a factor takes of its variable.
enum class Function : std::uint8_t { identity, sine, cosine };

/// variable^power, power ≥ 1; or the sine or cosine of the variable: then it is its monomial's only factor, and power = 1.
struct Factor {
  int variable = 0;
  int power = 1;
  Function function = Function::identity;
  friend auto operator<=>(const Factor&, const Factor&) = default;
};

/// A product of factors, sorted by variable, each variable once; without factors it is 1.
using Factors = std::vector<Factor>;

/// coefficient · Π factors.
struct Monomial {
  ExactNumber coefficient;
  Interval enclosure;  ///< of the coefficient; widened where it carries a tolerance
  Factors factors;

  Monomial() = default;
  Monomial(ExactNumber coefficient, Factors factors);
  /// c·sin x or c·cos x.
  bool is_trigonometric() const { return factors.size() == 1 && factors[0].function != Function::identity; }
  int degree() const;  ///< a sine or cosine counts as its variable
};

/// A sparse polynomial and multiples of sines and cosines: monomials with distinct factors.
struct Polynomial {
  std::vector<Monomial> monomials;
  std::string source;  ///< where it comes from, for messages and reports ("dextar.cuik:17", "norm of xi" …)

  int degree() const;
};

/// Widens the enclosure of every coefficient c that is no integer to c·[1 − tolerance, 1 + tolerance] at least, in any
/// rounding mode.
void widen(Polynomial& f, double tolerance);

}  // namespace corank
