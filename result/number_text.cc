#include "corank/result/number_text.h"

#include <array>
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

std::string outward_text(const Interval& x, int digits) {
  constexpr double kNothing = 1e-12;  // nobody wants to read 9.88131292e-324
  const auto outward = [](double far) { return 0 < far && far < kNothing ? kNothing : far; };
  const auto inward = [](double near) { return 0 < near && near < kNothing ? 0 : near; };
  const double lo = x.lo() < 0 ? -outward(-x.lo()) : inward(x.lo()), hi = x.hi() > 0 ? outward(x.hi()) : -inward(-x.hi());
  const std::string lower = decimal(lo, digits, FE_DOWNWARD), upper = decimal(hi, digits, FE_UPWARD);
  return lower == upper ? lower : "[" + lower + ", " + upper + "]";
}

}  // namespace corank::result
