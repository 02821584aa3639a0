// Exact real constants: rational numbers, pi, and what the elementary functions make of them, kept as an expression that can
// be enclosed to any precision. corank's coefficients are such numbers, never bare doubles: `0.90` is 9/10, `sqrt(2)` stays
// sqrt(2).
//
// What it proves: enclose() returns an interval that contains the number the expression defines, and sign() a sign that it
// has; both also prove that the expression defines a real number. Neither proves two expressions equal: only rationals are
// compared exactly.
#pragma once

#include <compare>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "corank/core/interval.h"

namespace corank {

/// Functions of one real constant.
enum class ConstantFunction { sqrt, sin, cos, tan, asin, acos, atan, exp, log, abs };

/// An exact real number as an immutable expression. Regular value type; copying is cheap (shared nodes).
class ExactNumber {
 public:
  struct Node;  // core/exact_number_node.h

  ExactNumber();  ///< 0
  /*implicit*/ ExactNumber(long n);
  /*implicit*/ ExactNumber(int n) : ExactNumber(static_cast<long>(n)) {}
  ExactNumber(double) = delete;  ///< a double such as 0.1 is not the number it was written as
  /// "12", "-3/4", "0.90", "1e-6", "2.5E3": exact. Throws std::invalid_argument where the text is none of these.
  /// This and all rational arithmetic below throws std::domain_error for a result of more than 10^5 bits.
  static ExactNumber rational(const std::string& text);
  static ExactNumber pi();
  static ExactNumber apply(ConstantFunction f, const ExactNumber& x);

  friend ExactNumber operator+(const ExactNumber& x, const ExactNumber& y);
  friend ExactNumber operator-(const ExactNumber& x, const ExactNumber& y);
  friend ExactNumber operator-(const ExactNumber& x);
  friend ExactNumber operator*(const ExactNumber& x, const ExactNumber& y);
  /// Throws std::domain_error where y is the rational number 0.
  friend ExactNumber operator/(const ExactNumber& x, const ExactNumber& y);
  friend ExactNumber pow(const ExactNumber& x, int n);

  /// Rational arithmetic is folded, so a number built from rationals by + − · / and integer powers always is one; and so are
  /// sums of rational multiples of one expression: 2·√3 − √3 − √3 is 0.
  bool is_rational() const;
  bool is_zero() const;  ///< is the rational number 0 (false says nothing about other expressions)

  /// The number in the model language: "9/10", "sqrt(2)", "2*cos(1/5*pi)" …; parses back to the same number.
  std::string text() const;
  /// The same expression node by node, which text() does not promise: a line such as "3/4 " or "+ 0 2 …".
  std::string prefix() const;
  /// Throws std::invalid_argument where the text is no such line.
  static ExactNumber from_prefix(std::string_view text);
  /// A decimal such as "0.9" or "-12" that equals the number exactly, where one of at most 17 significant digits exists.
  std::optional<std::string> decimal() const;

  /// A double interval that contains the number: the narrowest for a rational, within 2 ulp or so otherwise. Throws
  /// std::domain_error where the expression is no real number (sqrt(-1), log(0), 1/(sqrt(2)*sqrt(2)-2) …).
  /// Independent of the current rounding mode.
  Interval enclose() const;
  /// Rational numbers l ≤ x ≤ u, about 2^−bits |x| apart where x is not 0; both are x where it is rational. Throws like
  /// enclose().
  std::pair<ExactNumber, ExactNumber> bounds(int bits) const;
  /// The double as the rational number it is. Throws std::invalid_argument for infinity and NaN.
  static ExactNumber dyadic(double x);
  /// Sign −1, 0, +1 where it can be decided: by exact arithmetic for rationals, else by enclosures of up to `max_bits` bits
  /// (which can never prove 0). Nothing where undecided.
  std::optional<int> sign(int max_bits = 4096) const;

  /// Structural equality (equal expressions are equal numbers; the converse holds for rationals only).
  friend bool operator==(const ExactNumber& x, const ExactNumber& y);

  const Node& node() const { return *node_; }

 private:
  explicit ExactNumber(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  std::shared_ptr<const Node> node_;
};

std::ostream& operator<<(std::ostream& out, const ExactNumber& x);

}  // namespace corank
