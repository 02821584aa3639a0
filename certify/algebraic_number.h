// Exact arithmetic with polynomials in one real algebraic number t: the ring Q[t]/(p) and the real number that each of its
// elements is.
//
// t is given by a rational polynomial p and an interval (l, u) with rational ends that holds exactly one of its roots
// (Sturm's theorem; key BasuPollackRoy2006, ch. 2). p need not be irreducible: what is 0 modulo p is 0 at every root of p.
#pragma once

#include <optional>
#include <string>

#include "corank/core/exact_point.h"
#include "corank/core/interval.h"

namespace corank::certify {

class AlgebraicNumber {
 public:
  /// Throws std::invalid_argument where a coefficient or an end is not rational, or (lower, upper) does not hold exactly one
  /// root of p, where p changes its sign.
  AlgebraicNumber(RationalPolynomial p, ExactNumber lower, ExactNumber upper);

  const RationalPolynomial& polynomial() const { return p_; }
  const ExactNumber& lower() const { return lower_; }
  const ExactNumber& upper() const { return upper_; }

  /// f modulo p. Of lower degree than p, without leading zeros.
  RationalPolynomial reduced(RationalPolynomial f) const;
  RationalPolynomial product(const RationalPolynomial& f, const RationalPolynomial& g) const;

  /// Sign of f(t): 0 is proven by f ≡ 0 mod p, ±1 by an enclosure. Nothing where neither succeeds.
  std::optional<int> sign(const RationalPolynomial& f) const;
  /// A double interval, narrow, that contains f(t). Correct in any rounding mode.
  Interval enclose(const RationalPolynomial& f) const;
  /// Rational bounds of f(t) no farther apart than `width`.
  struct Bounds {
    ExactNumber lower, upper;
  };
  Bounds bounds(const RationalPolynomial& f, const ExactNumber& width) const;

 private:
  void halve() const;

  RationalPolynomial p_;
  mutable ExactNumber lower_, upper_;  // narrowed where more digits are asked for
  int sign_at_upper_ = 0;
};

/// f(t) in the model language where t has degree 1 or 2: "-3/5", "59/100 + 1/180*sqrt(28919)"; nothing beyond.
std::optional<std::string> text(const AlgebraicNumber& t, const RationalPolynomial& f);

RationalPolynomial sum(const RationalPolynomial& f, const RationalPolynomial& g);
RationalPolynomial scaled(const RationalPolynomial& f, const ExactNumber& factor);

}  // namespace corank::certify
