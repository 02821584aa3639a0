// Real numbers and intervals of any precision: MPFR's and MPFI's as values. A new number has as many bits as the thread that
// makes it is to compute with: no thread changes another's. Inside certify/, and where solve/ looks for zeros in many
// digits.
#pragma once

#include <concepts>
#include <utility>

#include "corank/core/mpfi.h"
#include "corank/core/nearest_rounding.h"

namespace corank::certify {

/// How many bits the numbers have that this thread makes in a scope: some more than asked for.
class Precision {
 public:
  explicit Precision(int bits) : former_(std::exchange(of_thread(), bits + kGuardBits)) {}
  ~Precision() { of_thread() = former_; }
  Precision(const Precision&) = delete;
  Precision& operator=(const Precision&) = delete;

  static mpfr_prec_t bits() { return of_thread(); }

 private:
  static constexpr mpfr_prec_t kGuardBits = 8, kBitsOfDouble = 53;
  static mpfr_prec_t& of_thread() {
    thread_local mpfr_prec_t bits = kBitsOfDouble;
    return bits;
  }

  const mpfr_prec_t former_;
  const NearestRounding nearest_;
};

/// Rounds to nearest.
class Real {
 public:
  Real() : Real(0) {}
  Real(std::integral auto i) { mpfr_init2(x_, Precision::bits()), mpfr_set_si(x_, static_cast<long>(i), MPFR_RNDN); }
  Real(double d) { mpfr_init2(x_, Precision::bits()), mpfr_set_d(x_, d, MPFR_RNDN); }
  explicit Real(mpfr_srcptr x) { mpfr_init2(x_, Precision::bits()), mpfr_set(x_, x, MPFR_RNDN); }
  Real(const Real& o) : Real(o.x_) {}
  Real(Real&& o) : Real() { mpfr_swap(x_, o.x_); }
  ~Real() { mpfr_clear(x_); }
  Real& operator=(const Real& o) { return mpfr_set(x_, o.x_, MPFR_RNDN), *this; }
  Real& operator=(Real&& o) noexcept { return mpfr_swap(x_, o.x_), *this; }

  double to_double() const { return mpfr_get_d(x_, MPFR_RNDN); }
  mpfr_ptr data() { return x_; }
  mpfr_srcptr data() const { return x_; }

  Real& operator+=(const Real& o) { return mpfr_add(x_, x_, o.x_, MPFR_RNDN), *this; }
  Real& operator-=(const Real& o) { return mpfr_sub(x_, x_, o.x_, MPFR_RNDN), *this; }
  Real& operator*=(const Real& o) { return mpfr_mul(x_, x_, o.x_, MPFR_RNDN), *this; }
  Real& operator/=(const Real& o) { return mpfr_div(x_, x_, o.x_, MPFR_RNDN), *this; }
  friend Real operator+(const Real& a, const Real& b) { return made(mpfr_add, a.x_, b.x_); }
  friend Real operator-(const Real& a, const Real& b) { return made(mpfr_sub, a.x_, b.x_); }
  friend Real operator*(const Real& a, const Real& b) { return made(mpfr_mul, a.x_, b.x_); }
  friend Real operator/(const Real& a, const Real& b) { return made(mpfr_div, a.x_, b.x_); }
  friend Real operator-(const Real& a) { return made(mpfr_neg, a.x_); }

  // False where one is not a number.
  friend bool operator<(const Real& a, const Real& b) { return mpfr_less_p(a.x_, b.x_) != 0; }
  friend bool operator>(const Real& a, const Real& b) { return mpfr_greater_p(a.x_, b.x_) != 0; }
  friend bool operator<=(const Real& a, const Real& b) { return mpfr_lessequal_p(a.x_, b.x_) != 0; }
  friend bool operator>=(const Real& a, const Real& b) { return mpfr_greaterequal_p(a.x_, b.x_) != 0; }
  friend bool operator==(const Real& a, const Real& b) { return mpfr_equal_p(a.x_, b.x_) != 0; }

  friend bool isfinite(const Real& a) { return mpfr_number_p(a.x_) != 0; }
  friend Real abs(const Real& a) { return made(mpfr_abs, a.x_); }
  friend Real sqrt(const Real& a) { return made(mpfr_sqrt, a.x_); }
  friend Real sin(const Real& a) { return made(mpfr_sin, a.x_); }
  friend Real cos(const Real& a) { return made(mpfr_cos, a.x_); }
  friend Real pow(const Real& a, long k) { return made(mpfr_pow_si, a.x_, k); }
  friend Real ldexp(const Real& a, long k) { return made(mpfr_mul_2si, a.x_, k); }

 private:
  template <class F, class... Operands>
  static Real made(F f, Operands... operands) {
    Real result;
    f(result.x_, operands..., MPFR_RNDN);
    return result;
  }

  mpfr_t x_;
};

/// Rounds outward. A copy has as many bits as the original.
class Range : public Mpfi {
 public:
  Range() : Range(0) {}
  Range(std::integral auto i) : Mpfi(Precision::bits()) { mpfi_set_si(*this, static_cast<long>(i)); }
  explicit Range(const Real& x) : Mpfi(Precision::bits()) { mpfi_set_fr(*this, x.data()); }

  Range& operator+=(const Range& o) { return mpfi_add(*this, *this, o), *this; }
  Range& operator-=(const Range& o) { return mpfi_sub(*this, *this, o), *this; }
  Range& operator*=(const Range& o) { return mpfi_mul(*this, *this, o), *this; }
  friend Range operator+(Range a, const Range& b) { return std::move(a += b); }
  friend Range operator-(Range a, const Range& b) { return std::move(a -= b); }
  friend Range operator*(Range a, const Range& b) { return std::move(a *= b); }
  friend Range operator-(const Range& a) { return made(mpfi_neg, a); }
  friend Range sin(const Range& a) { return made(mpfi_sin, a); }
  friend Range cos(const Range& a) { return made(mpfi_cos, a); }

 private:
  static Range made(int (*f)(mpfi_ptr, mpfi_srcptr), const Range& x) {
    Range result;
    f(result, x);
    return result;
  }
};

}  // namespace corank::certify
