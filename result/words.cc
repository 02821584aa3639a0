#include "corank/result/words.h"

#include <array>
#include <cctype>
#include <cfenv>
#include <cmath>
#include <cstdio>

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

}  // namespace

std::string noun(std::size_t n, const std::string& word) {
  if (n == 1) return word;
  return word.ends_with('y') ? word.substr(0, word.size() - 1) + "ies" : word + (word.ends_with('x') ? "es" : "s");
}

std::string counted(std::size_t n, const std::string& word) { return std::to_string(n) + " " + noun(n, word); }

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

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

}  // namespace corank::result
