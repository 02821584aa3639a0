// FLINT's numbers and matrices as values. Numbers pass as text, which both sides read exactly.
#pragma once

#include <flint/fmpq.h>
#include <flint/fmpq_mat.h>
#include <flint/nmod_mat.h>

#include <memory>
#include <stdexcept>

#include "corank/core/ended.h"
#include "corank/core/exact_number.h"

namespace corank::solve {

inline ExactNumber from_flint(char* text) {
  const std::unique_ptr<char, void (*)(void*)> owner(text, flint_free);
  return ExactNumber::rational(text);
}
inline ExactNumber exact(const fmpz* x) { return from_flint(fmpz_get_str(nullptr, 10, x)); }
inline ExactNumber exact(const fmpq* x) { return from_flint(fmpq_get_str(nullptr, 10, x)); }
/// Throws std::invalid_argument where the number is not rational.
inline void set(fmpq* to, const ExactNumber& x) {
  if (fmpq_set_str(to, x.text().c_str(), 10) != 0) throw std::invalid_argument(x.text() + " is not a fraction");
}

class Rational {
 public:
  Rational() { fmpq_init(q_); }
  explicit Rational(const ExactNumber& x) : Rational() { set(q_, x); }
  ~Rational() { fmpq_clear(q_); }
  Rational(const Rational&) = delete;
  Rational& operator=(const Rational&) = delete;
  fmpq* get() { return q_; }
  ExactNumber exact() const { return solve::exact(q_); }
  long bits() const { return static_cast<long>(fmpz_bits(fmpq_numref(q_)) + fmpz_bits(fmpq_denref(q_))); }

 private:
  fmpq_t q_;
};

class RationalMatrix {
 public:
  RationalMatrix(std::size_t rows, std::size_t columns) { fmpq_mat_init(m_, rows, columns); }
  ~RationalMatrix() { fmpq_mat_clear(m_); }
  RationalMatrix(const RationalMatrix&) = delete;
  RationalMatrix& operator=(const RationalMatrix&) = delete;
  fmpq_mat_struct* get() { return m_; }
  fmpq* at(std::size_t i, std::size_t j) { return fmpq_mat_entry(m_, i, j); }

 private:
  fmpq_mat_t m_;
};

/// Over the integers modulo a prime.
class PrimeMatrix {
 public:
  static constexpr mp_limb_t kPrime = 2305843009213693951;  // 2^61 − 1
  static nmod_t field() {
    nmod_t mod;
    nmod_init(&mod, kPrime);
    return mod;
  }

  PrimeMatrix(std::size_t rows, std::size_t columns) { nmod_mat_init(m_, rows, columns, kPrime); }
  ~PrimeMatrix() { nmod_mat_clear(m_); }
  PrimeMatrix(const PrimeMatrix&) = delete;
  PrimeMatrix& operator=(const PrimeMatrix&) = delete;
  mp_limb_t& at(std::size_t i, std::size_t j) { return nmod_mat_entry(m_, i, j); }
  /// To reduced row echelon form. Of the possible pivot rows each step takes the one with the fewest entries, since the
  /// matrices of equations are sparse. False: `ended` has become true, and the matrix is of no use.
  bool reduce(const Ended& ended);

 private:
  std::size_t lightest_row(std::size_t from, std::size_t column);
  void subtract(std::size_t pivot, std::size_t from, std::size_t column);

  nmod_mat_t m_;
};

}  // namespace corank::solve
