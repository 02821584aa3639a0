// Polynomials with rational coefficients in many unknowns, by FLINT: sparse products and factors, exactly.
#pragma once

#include <flint/fmpq_mpoly.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/core/ended.h"

namespace corank::symbolic {

/// The unknowns are numbered from 0; the order is lexicographic.
class PolynomialRing {
 public:
  explicit PolynomialRing(std::size_t unknowns);
  std::size_t unknowns() const { return context_->zctx->minfo->nvars; }
  fmpq_mpoly_ctx_struct* context() const { return context_.get(); }

 private:
  std::shared_ptr<fmpq_mpoly_ctx_struct> context_;
};

class RationalPolynomial {
 public:
  struct Term {
    std::string coefficient;            ///< "-3/4"
    std::vector<std::uint64_t> powers;  ///< of each unknown
  };

  explicit RationalPolynomial(const PolynomialRing& ring);  ///< 0
  /// A rational number as "-3/4".
  static RationalPolynomial number(const PolynomialRing& ring, const std::string& value);
  static RationalPolynomial unknown(const PolynomialRing& ring, std::size_t index);
  RationalPolynomial(const RationalPolynomial& other);
  RationalPolynomial(RationalPolynomial&& other) noexcept;
  RationalPolynomial& operator=(RationalPolynomial other) noexcept;
  ~RationalPolynomial();

  bool is_zero() const { return size() == 0; }
  bool is_number() const;
  std::size_t size() const;  ///< terms
  std::vector<Term> terms() const;
  bool mentions(std::size_t unknown) const;
  std::size_t unknowns() const;  ///< how many occur in it
  RationalPolynomial power(std::uint64_t exponent) const;
  /// With x^step replaced by a value throughout, x^(k·step + r) by value^k·x^r.
  RationalPolynomial with(std::size_t unknown, std::uint64_t step, const RationalPolynomial& value) const;
  RationalPolynomial over(const RationalPolynomial& number) const;  ///< divided by a number other than 0
  /// The quotient, where it is a polynomial.
  std::optional<RationalPolynomial> divided_by(const RationalPolynomial& divisor) const;
  /// The irreducible factors over the rationals that are no numbers, each once. Nothing where they are not found within 10 s
  /// of processor time, or before `ended` says so.
  std::optional<std::vector<RationalPolynomial>> factors(const Ended& ended = {}) const;

  friend RationalPolynomial operator+(const RationalPolynomial& a, const RationalPolynomial& b);
  friend RationalPolynomial operator-(const RationalPolynomial& a, const RationalPolynomial& b);
  friend RationalPolynomial operator*(const RationalPolynomial& a, const RationalPolynomial& b);
  friend bool operator==(const RationalPolynomial& a, const RationalPolynomial& b);

 private:
  template <auto flint>
  static RationalPolynomial made_of(const RationalPolynomial& a, const RationalPolynomial& b);
  std::string text() const;
  static RationalPolynomial parsed(const PolynomialRing& ring, const std::string& text);
  std::vector<RationalPolynomial> factors_here() const;
  PolynomialRing ring_;
  fmpq_mpoly_t value_;
};

}  // namespace corank::symbolic
