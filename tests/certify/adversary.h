// Hard inputs, from bit patterns, and an oracle that shares no code with certify/: Arb's balls, at a precision where sums
// and products of doubles are exact.
#pragma once

#include <arb.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "corank/core/interval.h"
#include "corank/core/rounding.h"

namespace corank::certify::adversary {

/// RapidCheck prints the seed; without this it would be another one at each run.
inline const int kSeeded = setenv("RC_PARAMS", "seed=20261121 max_success=4000", 0);

inline constexpr slong kExact = 20'000;  ///< bits for polynomials of doubles; what is no polynomial needs fewer
inline constexpr slong kBits = 2'400;    ///< more than the range of doubles: x and x + denorm_min are told apart

/// A ball of reals with the number asked for in it; a single number for polynomials.
class Ball {
 public:
  Ball() { arb_init(x_); }
  /*implicit*/ Ball(double x) : Ball() { arb_set_d(x_, x); }
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball& operator=(const Ball& other) {
    arb_set(x_, other.x_);
    return *this;
  }
  ~Ball() { arb_clear(x_); }
  arb_ptr get() { return x_; }
  arb_srcptr get() const { return x_; }

  friend Ball operator+(const Ball& a, const Ball& b) { return binary(arb_add, a, b, kExact); }
  friend Ball operator-(const Ball& a, const Ball& b) { return binary(arb_sub, a, b, kExact); }
  friend Ball operator*(const Ball& a, const Ball& b) { return binary(arb_mul, a, b, kExact); }
  friend Ball operator/(const Ball& a, const Ball& b) { return binary(arb_div, a, b, kBits); }
  friend Ball pow(const Ball& a, int p) {
    Ball r;
    arb_pow_ui(r.x_, a.x_, static_cast<ulong>(p), kExact);
    return r;
  }
  template <class F>
  static Ball unary(F f, const Ball& a, slong bits = kBits) {
    Ball r;
    f(r.x_, a.x_, bits);
    return r;
  }
  template <class F>
  static Ball binary(F f, const Ball& a, const Ball& b, slong bits) {
    Ball r;
    f(r.x_, a.x_, b.x_, bits);
    return r;
  }

  bool certainly_above(double x) const { return x == -HUGE_VAL || (x != HUGE_VAL && arb_gt(x_, Ball(x).x_) != 0); }
  bool certainly_below(double x) const { return x == HUGE_VAL || (x != -HUGE_VAL && arb_lt(x_, Ball(x).x_) != 0); }
  /// The number lies in X as far as the ball tells (a single number tells all): the claim under test.
  bool in(const Interval& x) const {
    return !std::isnan(x.lo()) && !std::isnan(x.hi()) && arb_is_finite(x_) != 0 &&
           !(x.lo() > -HUGE_VAL && certainly_below(x.lo())) && !(x.hi() < HUGE_VAL && certainly_above(x.hi()));
  }
  /// The number lies in X, with proof: for what a test supposes.
  bool certainly_in(const Interval& x) const {
    const bool above = x.lo() == -HUGE_VAL || arb_ge(x_, Ball(x.lo()).x_) != 0;
    return above && (x.hi() == HUGE_VAL || arb_le(x_, Ball(x.hi()).x_) != 0);
  }

 private:
  arb_t x_;
};

inline Ball sin(const Ball& x) { return Ball::unary(arb_sin, x); }
inline Ball cos(const Ball& x) { return Ball::unary(arb_cos, x); }

/// Bit for bit: "[0x1.8p+1, 0x1p+2]".
inline std::string shown(const Interval& x) {
  std::ostringstream text;
  text << std::hexfloat << '[' << x.lo() << ", " << x.hi() << ']';
  return text.str();
}
inline std::string shown(const std::optional<Interval>& x) { return x ? shown(*x) : "nothing"; }

/// Evaluates f() under upward rounding; Arb and RapidCheck run under the caller's mode.
template <class F>
auto upward(F f) {
  const UpwardRounding rounding;
  return f();
}

/// x moved by a number of units in the last place; finite.
inline double moved(double x, int ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, std::numeric_limits<double>::max());
  for (; ulps < 0; ++ulps) x = std::nextafter(x, std::numeric_limits<double>::lowest());
  return x;
}

/// Finite doubles: ±0, subnormal, smallest and largest ones, any bit pattern, neighbours of integers, of powers of two, of
/// multiples of π/2.
inline double finite_double() {
  using std::numbers::pi;
  using Limits = std::numeric_limits<double>;
  static const std::vector<double> kSpecial{0.0,
                                            -0.0,
                                            Limits::denorm_min(),
                                            -Limits::denorm_min(),
                                            Limits::min(),
                                            -Limits::min(),
                                            Limits::max(),
                                            -Limits::max(),
                                            1.0,
                                            -1.0,
                                            0.5,
                                            0.1,
                                            -0.9,
                                            3.0,
                                            0x1p27,
                                            -0x1p27,
                                            1e154,
                                            1e-162};
  const auto integer = [](int lo, int hi) { return *rc::gen::inRange(lo, hi + 1); };
  const std::uint64_t bits = *rc::gen::resize(1000, rc::gen::arbitrary<std::uint64_t>());
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63, kMantissa = (std::uint64_t{1} << 52) - 1;
  switch (integer(0, 7)) {
    case 0: return kSpecial[static_cast<std::size_t>(integer(0, static_cast<int>(kSpecial.size()) - 1))];
    case 1: return moved(*rc::gen::elementOf(kSpecial), integer(-2, 2));
    case 2: return std::bit_cast<double>(bits & (kSign | kMantissa));  // subnormal
    case 3: return moved(integer(-4, 4), integer(-2, 2));
    case 4: return moved((bits >> 63 ? -1 : 1) * std::ldexp(1.0, integer(-1074, 1023)), integer(-2, 2));
    case 5: return moved(static_cast<double>(static_cast<std::int64_t>(bits) >> integer(36, 62)) * (pi / 2), integer(-2, 2));
    case 6:
      return std::bit_cast<double>((bits & (kSign | kMantissa)) | (static_cast<std::uint64_t>(integer(1003, 1043)) << 52));
    default: {
      const double x = std::bit_cast<double>(bits);
      return std::isfinite(x) ? x : *rc::gen::elementOf(kSpecial);
    }
  }
}

/// Points, neighbours, balanced and any other intervals.
inline Interval bounded_interval() {
  const double a = finite_double();
  switch (*rc::gen::inRange(0, 5)) {
    case 0: return a;
    case 1: return {std::min(a, moved(a, 1)), std::max(a, moved(a, 1))};
    case 2: return {-std::fabs(a), std::fabs(a)};
    default: break;
  }
  const double b = finite_double();
  return {std::min(a, b), std::max(a, b)};
}
/// Also half lines and the whole line.
inline Interval any_interval() {
  const Interval x = bounded_interval();
  switch (*rc::gen::inRange(0, 8)) {
    case 0: return {-HUGE_VAL, x.hi()};
    case 1: return {x.lo(), HUGE_VAL};
    case 2: return *rc::gen::inRange(0, 4) == 0 ? Interval::whole() : x;
    default: return x;
  }
}

/// A double in X.
inline double member(const Interval& x) {
  constexpr double kMax = std::numeric_limits<double>::max();
  const double lo = std::max(x.lo(), -kMax), hi = std::min(x.hi(), kMax);
  switch (*rc::gen::inRange(0, 5)) {
    case 0: return lo;
    case 1: return hi;
    case 2: return std::clamp(0.0, lo, hi);
    case 3: return std::clamp(0.5 * lo + 0.5 * hi, lo, hi);
    default: return std::clamp(finite_double(), lo, hi);
  }
}

}  // namespace corank::certify::adversary
