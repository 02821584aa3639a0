#include "corank/result/values/words.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "corank/certify/algebraic_number.h"

namespace corank::result {
namespace {

// glibc's printf rounds decimals in the current rounding mode (exactly, at any number of digits).
std::string decimal(double x, int digits, int rounding_mode) {
  const int former = std::fegetround();
  std::fesetround(rounding_mode);
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*g", digits, x == 0 ? 0.0 : x);
  std::fesetround(former);
  return text.data();
}

struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;  ///< in bytes; 0: no UTF-8
};

// The first character of a text that is not empty (Unicode standard, table 3-7).
Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
  std::uint32_t code = lead & (0xffu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool shortest = length == 2 || code >= (length == 3 ? 0x800u : 0x10000u);
  if (!shortest || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return {};
  return {code, length};
}

bool is_harmless(std::uint32_t c, bool one_line) {
  if (c == '\n' || c == '\t') return !one_line;
  const bool control = c < 0x20 || (c >= 0x7f && c <= 0x9f);
  const bool direction =
      c == 0x61c || c == 0x200e || c == 0x200f || (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
  return !control && !direction;
}

std::string made_visible(std::string_view text, bool one_line) {
  std::string result;
  while (!text.empty()) {
    const Character c = first_character(text);
    const std::size_t length = c.length == 0 ? 1 : c.length;
    if (c.length > 0 && is_harmless(c.code, one_line)) {
      result += text.substr(0, length);
    } else if (length == 1) {
      result += fmt::format("\\x{:02x}", static_cast<std::uint8_t>(text[0]));
    } else {
      result += fmt::format("\\u{:04x}", c.code);
    }
    text.remove_prefix(length);
  }
  return result;
}

/// The cosine of kπ/12 for the multiples of π/6 and π/4, as exact_coordinate() writes it.
std::optional<std::string> cosine_of_twelfths(int k) {
  k = ((k % 24) + 24) % 24;
  const int acute = k <= 6 ? k : k < 18 ? std::abs(12 - k) : 24 - k;  // |cos| is that of this one
  const auto half_root = [](int n) { return ExactNumber::rational("1/2") * ExactNumber::apply(ConstantFunction::sqrt, n); };
  ExactNumber value;
  switch (acute) {
    case 0: value = 1; break;
    case 2: value = half_root(3); break;
    case 3: value = half_root(2); break;
    case 4: value = ExactNumber::rational("1/2"); break;
    case 6: return "0";
    default: return std::nullopt;
  }
  return (k > 6 && k < 18 ? -value : value).text();
}

int turns(const Interval& enclosure, double angle) {
  return static_cast<int>(std::lround((enclosure.mid() - angle) / (2 * std::numbers::pi)));
}

}  // namespace

std::string capitalized(std::string sentence) {
  sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
  return sentence;
}

std::string outward_text(const Interval& x, int digits) {
  constexpr double kNothing = 1e-12;  // nobody wants to read 9.88131292e-324
  const auto outward = [](double far) { return 0 < far && far < kNothing ? kNothing : far; };
  const auto inward = [](double near) { return 0 < near && near < kNothing ? 0 : near; };
  const double lo = x.lo() < 0 ? -outward(-x.lo()) : inward(x.lo()), hi = x.hi() > 0 ? outward(x.hi()) : -inward(-x.hi());
  const std::string lower = decimal(lo, digits, FE_DOWNWARD), upper = decimal(hi, digits, FE_UPWARD);
  return lower == upper ? lower : "[" + lower + ", " + upper + "]";
}

std::string printable(std::string_view text) { return made_visible(text, false); }

std::string printable_line(std::string_view text) { return made_visible(text, true); }

std::optional<std::string> exact_coordinate(const ExactPoint& point, int variable) {
  const RationalPolynomial& x = point.coordinates[variable];
  if (x.empty()) return std::nullopt;
  try {
    return certify::text({point.polynomial, point.lower, point.upper}, x);
  } catch (const std::invalid_argument&) {  // no polynomial with one root in the interval
    return std::nullopt;
  } catch (const std::domain_error&) {  // numbers of too many bits
    return std::nullopt;
  }
}

std::optional<std::string> multiple_of_pi(const ExactPoint& point, const Angle& angle, const Interval& enclosure) {
  const auto cosine = exact_coordinate(point, angle.cosine), sine = exact_coordinate(point, angle.sine);
  if (!cosine || !sine) return std::nullopt;
  for (int k = -11; k <= 12; ++k) {
    if (cosine_of_twelfths(k) != cosine || cosine_of_twelfths(k - 6) != sine) continue;
    const int twelfths = k + 24 * turns(enclosure, k * std::numbers::pi / 12);
    if (twelfths == 0) return "0";
    const int common = std::gcd(twelfths, 12), top = std::abs(twelfths / common), bottom = 12 / common;
    return fmt::format("{}{}pi{}", twelfths < 0 ? "-" : "", top == 1 ? "" : fmt::format("{}*", top),
                       bottom == 1 ? "" : fmt::format("/{}", bottom));
  }
  return std::nullopt;
}

std::optional<std::string> exact_angle(const ExactPoint& point, const Angle& angle, const Interval& enclosure) {
  if (const auto multiple = multiple_of_pi(point, angle, enclosure)) return multiple;
  const auto cosine = exact_coordinate(point, angle.cosine), sine = exact_coordinate(point, angle.sine);
  if (!cosine || !sine) return std::nullopt;
  const certify::AlgebraicNumber t(point.polynomial, point.lower, point.upper);
  const auto middle = [&](int v) { return t.enclose(point.coordinates[v]).mid(); };
  const int k = turns(enclosure, std::atan2(middle(angle.sine), middle(angle.cosine)));
  const std::string base = fmt::format("atan2({}, {})", *sine, *cosine);
  return k == 0 ? base : fmt::format("{} {} {}*pi", base, k < 0 ? "-" : "+", 2 * std::abs(k));
}

}  // namespace corank::result
