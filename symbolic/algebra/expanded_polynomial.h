// Polynomials in the variables of a compiled system while they are being expanded: like terms are collected at every step.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "corank/core/system.h"
#include "corank/symbolic/algebra/constant_value.h"

namespace corank::symbolic {

/// A sparse polynomial. No coefficient is recognized as zero. Operations throw std::length_error beyond kMaxTerms terms or
/// kMaxDegree, and std::domain_error as ConstantValue does.
class ExpandedPolynomial {
 public:
  /// (variable, power) pairs, sorted by variable. The constant term comes first in the order of terms.
  using Key = std::vector<std::pair<int, int>>;
  static constexpr std::size_t kMaxTerms = 200'000;
  static constexpr int kMaxDegree = 256;

  ExpandedPolynomial() = default;
  /*implicit*/ ExpandedPolynomial(const ConstantValue& constant) { add({}, constant); }
  /*implicit*/ ExpandedPolynomial(int constant) : ExpandedPolynomial(ConstantValue(constant)) {}
  static ExpandedPolynomial variable(int index);

  /// The value, where the polynomial is a constant.
  std::optional<ConstantValue> constant() const;
  const std::map<Key, ConstantValue>& terms() const { return terms_; }

  ExpandedPolynomial& operator+=(const ExpandedPolynomial& y);
  friend ExpandedPolynomial operator+(ExpandedPolynomial x, const ExpandedPolynomial& y) { return x += y; }
  friend ExpandedPolynomial operator-(const ExpandedPolynomial& x) { return ConstantValue(-1) * x; }
  friend ExpandedPolynomial operator-(ExpandedPolynomial x, const ExpandedPolynomial& y) { return x += -y; }
  friend ExpandedPolynomial operator*(const ExpandedPolynomial& x, const ExpandedPolynomial& y);
  friend ExpandedPolynomial operator*(const ConstantValue& c, const ExpandedPolynomial& x);
  friend ExpandedPolynomial pow(const ExpandedPolynomial& x, int n);

  /// Exact coefficients; drops those that only sin² + cos² = 1 shows to be zero.
  Polynomial compile(const std::string& source) const;

 private:
  void add(const Key& key, const ConstantValue& coefficient);
  std::map<Key, ConstantValue> terms_;
};

/// cos(nθ) and sin(nθ) in c = cos θ and s = sin θ by Chebyshev's polynomials: T_n(c) and s·U_{n−1}(c), n any integer.
std::pair<ExpandedPolynomial, ExpandedPolynomial> multiple_angle(int n, const ExpandedPolynomial& c,
                                                                 const ExpandedPolynomial& s);

}  // namespace corank::symbolic
