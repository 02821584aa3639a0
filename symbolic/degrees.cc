#include "corank/symbolic/degrees.h"

#include <numeric>

namespace corank::symbolic {

Expression degrees(const std::string& decimal, const SourceLocation& where) {
  using Kind = Expression::Kind;
  constexpr std::size_t kFewDigits = 10;  // whose fraction is reduced by machine numbers
  const Expression circle = Expression::symbol("pi", where);
  if (decimal.size() > kFewDigits || decimal.find('e') != std::string::npos) {
    return Expression::node(
        Kind::quotient,
        {Expression::node(Kind::product, {Expression::number(decimal, where), circle}, where), Expression(180)}, where);
  }
  long long numerator = 0, denominator = 180;
  bool behind_point = false;
  for (const char c : decimal) {
    if (c == '.') {
      behind_point = true;
      continue;
    }
    numerator = 10 * numerator + (c - '0');
    if (behind_point) denominator *= 10;
  }
  const long long common = std::gcd(numerator, denominator);
  numerator /= common, denominator /= common;
  if (numerator == 0) return Expression::number("0", where);
  const Expression top =
      numerator == 1
          ? circle
          : Expression::node(Kind::product, {Expression::number(std::to_string(numerator), where), circle}, where);
  if (denominator == 1) return top;
  return Expression::node(Kind::quotient, {top, Expression::number(std::to_string(denominator), where)}, where);
}

}  // namespace corank::symbolic
