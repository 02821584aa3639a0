#include "corank/kinematics/urdf/urdf_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "corank/kinematics/robot/vectors.h"
#include "corank/symbolic/model/expression_words.h"

namespace corank::kinematics {
namespace {

using symbolic::in_quotes;
using symbolic::ModelError;

constexpr long double kPi = 3.14159265358979323846264338327950288L;
constexpr int kHalfTurn = 360;  ///< pi, in half degrees
constexpr std::string_view kWhiteSpace = " \t\r\n";

// What a decimal in its normal form says of its digits.
struct Digits {
  std::size_t significant = 0;
  long double unit = 1;  ///< of the last digit
  bool is_zero = true, is_whole = true;
};

Digits digits_of(const std::string& decimal) {
  Digits digits;
  bool in_fraction = false;
  for (std::size_t i = 0; i < decimal.size(); ++i) {
    const char c = decimal[i];
    if (c == '.') {
      in_fraction = true;
    } else if (c == 'e') {
      digits.is_whole = false;
      int exponent = 0;
      std::from_chars(decimal.data() + i + 1, decimal.data() + decimal.size(), exponent);
      digits.unit *= std::pow(10.0L, exponent);
      break;
    } else {
      if (c != '0') digits.is_zero = false;
      if (c != '0' && in_fraction) digits.is_whole = false;
      if (!digits.is_zero) ++digits.significant;
      if (in_fraction) digits.unit /= 10;
    }
  }
  return digits;
}

// "1.570800", a program's print of 1.5708.
std::string without_last_zeros(std::string decimal) {
  const std::size_t end = std::min(decimal.find('e'), decimal.size());
  if (decimal.find('.') > end) return decimal;
  const std::size_t last = decimal.find_last_not_of('0', end - 1);
  return decimal.erase(last + 1, end - last - 1);
}

std::size_t digits_asked_for(int half_degrees) {
  if (half_degrees % (kHalfTurn / 2) == 0 || half_degrees == kHalfTurn / 4) return 3;
  return half_degrees % (kHalfTurn / 8) == 0 || half_degrees % (kHalfTurn / 12) == 0 ? 4 : 6;
}

// The multiple of half a degree that a positive decimal means.
std::optional<int> meant_half_degrees(const std::string& decimal, const Digits& digits) {
  long double x = 0;
  std::from_chars(decimal.data(), decimal.data() + decimal.size(), x);
  if (!(x > 0 && x <= 4 * kPi + 1)) return {};
  const int nearest = static_cast<int>(std::lround(x / kPi * kHalfTurn));
  if (nearest == 0 || nearest > 4 * kHalfTurn || digits.significant < digits_asked_for(nearest)) return {};
  const long double missing = nearest * kPi / kHalfTurn - x;
  const bool has_its_digits = missing >= -digits.unit / 2 && missing <= digits.unit;
  const bool is_its_double = digits.significant >= 15 && std::fabs(missing) <= std::ldexp(x, -50);
  if (!has_its_digits && !is_its_double) return {};
  return nearest;
}

// k pi/360 in lowest terms.
Expression multiple_of_pi(int half_degrees) {
  const int divisor = std::gcd(half_degrees, kHalfTurn);
  const int numerator = half_degrees / divisor, denominator = kHalfTurn / divisor;
  const Expression product = numerator == 1 ? symbolic::pi() : Expression(numerator) * symbolic::pi();
  return denominator == 1 ? product : product / Expression(denominator);
}

// Of the angle without its sign, how many quarter turns it is beyond whole turns.
std::optional<int> quarters_of(const UrdfNumber& angle) {
  if (!angle.half_degrees || *angle.half_degrees % (kHalfTurn / 2) != 0) return std::nullopt;
  return std::abs(*angle.half_degrees / (kHalfTurn / 2)) % 4;
}
// The positive one, so that equal functions are equal trees.
Expression size_of(const UrdfNumber& angle) {
  return angle.approximate < 0 ? folded_difference(0, angle.value) : angle.value;
}

}  // namespace

UrdfNumber urdf_number(std::string_view text, const SourceLocation& where, const std::string& what) {
  std::string_view unsigned_text = text;
  const bool is_negative = text.starts_with('-');
  if (is_negative || text.starts_with('+')) unsigned_text.remove_prefix(1);
  if (unsigned_text.empty() || unsigned_text.find_first_not_of("0123456789.eE+-") != std::string_view::npos)
    throw ModelError(where, what + " is " + in_quotes(text) + ", not a number", "a decimal such as 0.25 or -1e-3");
  std::string decimal = symbolic::normal_decimal(unsigned_text, where);
  const Digits digits = digits_of(decimal);
  UrdfNumber number;
  if (digits.is_zero) {
    number.is_zero = true;
    return number;
  }
  if (digits.is_whole) decimal.resize(std::min(decimal.size(), decimal.find('.')));
  const auto read = std::from_chars(decimal.data(), decimal.data() + decimal.size(), number.approximate);
  if (read.ec != std::errc() || !std::isnormal(number.approximate))
    throw ModelError(where, what + " is " + in_quotes(text) + ", out of range", "0, or between 1e-300 and 1e300");
  number.value = Expression::number(decimal, where);
  if (is_negative) {
    number.approximate = -number.approximate;
    number.value = -number.value;
  }
  return number;
}

UrdfNumber urdf_angle(std::string_view text, const SourceLocation& where, const std::string& what) {
  UrdfNumber number = urdf_number(text, where, what);
  if (number.is_zero) {
    number.half_degrees = 0;
    return number;
  }
  const bool is_negative = text.starts_with('-');
  if (is_negative || text.starts_with('+')) text.remove_prefix(1);
  const std::string decimal = without_last_zeros(symbolic::normal_decimal(text, where));
  const std::optional<int> meant = meant_half_degrees(decimal, digits_of(decimal));
  if (!meant) return number;
  const double sign = is_negative ? -1 : 1;
  number.half_degrees = is_negative ? -*meant : *meant;
  number.approximate = sign * static_cast<double>(*meant * kPi / kHalfTurn);
  number.value = is_negative ? -multiple_of_pi(*meant) : multiple_of_pi(*meant);
  number.reading = (is_negative ? "-" : "") + symbolic::shortened(text) + " read as " + number.value.text();
  return number;
}

std::array<UrdfNumber, 3> urdf_numbers(std::string_view text, const SourceLocation& where, const std::string& what,
                                       UrdfNumber (*read)(std::string_view, const SourceLocation&, const std::string&)) {
  std::array<UrdfNumber, 3> numbers;
  std::size_t count = 0;
  std::string_view rest = text;
  for (; count <= 3; ++count) {
    rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(kWhiteSpace)));
    if (rest.empty()) break;
    const std::string_view word = rest.substr(0, rest.find_first_of(kWhiteSpace));
    if (count < 3) numbers[count] = read(word, where, what);
    rest.remove_prefix(word.size());
  }
  if (count != 3)
    throw ModelError(where,
                     what + " is " + in_quotes(text) + ", " + (count > 3 ? "more than 3" : std::to_string(count)) +
                         (count == 1 ? " number" : " numbers"),
                     "three, separated by spaces");
  return numbers;
}

Expression exact_cos(const UrdfNumber& angle) {
  if (const auto quarters = quarters_of(angle)) return *quarters == 0 ? 1 : *quarters == 2 ? -Expression(1) : Expression(0);
  return cos(size_of(angle));
}

Expression exact_sin(const UrdfNumber& angle) {
  const auto quarters = quarters_of(angle);
  const Expression sine = !quarters        ? sin(size_of(angle))
                          : *quarters == 1 ? Expression(1)
                          : *quarters == 3 ? -Expression(1)
                                           : Expression(0);
  return angle.approximate < 0 ? folded_difference(0, sine) : sine;
}

}  // namespace corank::kinematics
