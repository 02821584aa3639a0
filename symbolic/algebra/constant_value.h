// Exact real constants in arithmetic that recognizes equal numbers: what a polynomial's coefficients are made of while like
// terms are collected. GiNaC simplifies (sqrt(2)·sqrt(2) = 2, sin(pi/6) = 1/2); every operation first proves, by enclosures,
// that its result is a real number.
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>

#include "corank/core/exact_number.h"

namespace corank::symbolic {

/// Every operation throws std::domain_error where the result is no real number, cannot be proven to be one, or would be
/// absurdly long (numbers of 10^5 bits, expressions of 20,000 parts).
class ConstantValue {
 public:
  ConstantValue() : value_(0) {}
  /*implicit*/ ConstantValue(int n) : value_(n) {}
  static ConstantValue number(const std::string& decimal);
  static ConstantValue pi();

  friend ConstantValue operator+(const ConstantValue& x, const ConstantValue& y);
  friend ConstantValue operator-(const ConstantValue& x, const ConstantValue& y);
  friend ConstantValue operator-(const ConstantValue& x);
  friend ConstantValue operator*(const ConstantValue& x, const ConstantValue& y);
  friend ConstantValue operator/(const ConstantValue& x, const ConstantValue& y);
  friend ConstantValue pow(const ConstantValue& x, const ConstantValue& exponent);
  static ConstantValue function(const std::string& name, const ConstantValue& x);

  /// Recognized as 0 (false says nothing: see sign()).
  bool is_zero() const { return value_.is_zero(); }
  /// The integer, where the number is recognized as one that fits.
  std::optional<int> integer() const;
  bool is_rational() const;
  /// Nothing where enclosures of 4096 bits leave it open.
  std::optional<int> sign() const;
  /// With cos² replaced by 1 − sin²: recognizes more zeros, but is longer to read.
  ConstantValue without_squared_cosines() const;

  ExactNumber exact() const;

 private:
  explicit ConstantValue(GiNaC::ex value);
  static ConstantValue as_is(const GiNaC::ex& value) {
    ConstantValue result;
    result.value_ = value;
    return result;
  }
  GiNaC::ex value_;
};

}  // namespace corank::symbolic
