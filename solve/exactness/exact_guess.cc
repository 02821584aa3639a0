#include <flint/fmpz_lll.h>
#include <flint/fmpz_mat.h>

#include <stdexcept>

#include "corank/certify/algebraic_number.h"
#include "corank/solve/exactness/exact_points.h"
#include "corank/solve/reduction/flint.h"

namespace corank::solve {
namespace {

// The simplest fraction within 2^−bits of x, where it is short.
std::optional<ExactNumber> short_fraction(const ExactNumber& x, int bits) {
  const ExactNumber radius = pow(ExactNumber(2), -bits);
  Rational lower(x - radius), upper(x + radius), simplest;
  fmpq_simplest_between(simplest.get(), lower.get(), upper.get());
  if (simplest.bits() > bits / 3) return std::nullopt;
  return simplest.exact();
}

// Integers c, not all 0, with Σ c_k x_k = 0 to about `bits` bits, all short; else nothing.
std::optional<std::vector<ExactNumber>> integer_relation(const std::vector<ExactNumber>& x, int bits) {
  const slong n = x.size();
  fmpz_mat_t lattice;
  fmpz_mat_init(lattice, n, n + 1);
  fmpz_mat_one(lattice);
  const ExactNumber scale = pow(ExactNumber(2), bits);
  for (slong k = 0; k < n; ++k) {
    Rational scaled(x[k] * scale);
    fmpz_tdiv_q(fmpz_mat_entry(lattice, k, n), fmpq_numref(scaled.get()), fmpq_denref(scaled.get()));
  }
  fmpz_lll_t options;
  fmpz_lll_context_init_default(options);
  fmpz_lll(lattice, nullptr, options);
  std::vector<ExactNumber> relation;
  long length = static_cast<long>(fmpz_bits(fmpz_mat_entry(lattice, 0, n)));
  for (slong k = 0; k < n; ++k) {
    length += static_cast<long>(fmpz_bits(fmpz_mat_entry(lattice, 0, k)));
    relation.push_back(exact(fmpz_mat_entry(lattice, 0, k)));
  }
  fmpz_mat_clear(lattice);
  if (length > bits / 2) return std::nullopt;  // any n numbers have relations of about `bits` bits
  return relation;
}

std::vector<ExactNumber> powers(const ExactNumber& t, int degree) {
  std::vector<ExactNumber> result{ExactNumber(1)};
  for (int k = 1; k <= degree; ++k) result.push_back(result.back() * t);
  return result;
}

// ⌊x · 10^places⌋ / 10^places
ExactNumber floor_decimal(const ExactNumber& x, int places) {
  const ExactNumber scale = pow(ExactNumber(10), places);
  Rational scaled(x * scale), whole;
  fmpz_fdiv_q(fmpq_numref(whole.get()), fmpq_numref(scaled.get()), fmpq_denref(scaled.get()));
  return whole.exact() / scale;
}

// The point with its coordinates as polynomials in the root of p near t.
std::optional<ExactPoint> in_terms_of(const ExactNumber& t, const RationalPolynomial& p,
                                      const std::vector<std::optional<ExactNumber>>& coordinates, int bits,
                                      const Ended& ended) {
  ExactPoint point;
  point.polynomial = p;
  // The shortest decimals between which the root is alone.
  const int most = bits / 8;
  for (int places = 0;; ++places) {
    if (places > most) return std::nullopt;
    point.lower = floor_decimal(t, places);
    point.upper = point.lower + pow(ExactNumber(10), -places);
    try {
      const certify::AlgebraicNumber isolated(point.polynomial, point.lower, point.upper);
      break;
    } catch (const std::invalid_argument&) {
    }
  }
  const int degree = static_cast<int>(p.size()) - 1;
  for (const auto& x : coordinates) {
    if (is_over(ended)) return std::nullopt;
    point.coordinates.emplace_back();
    if (!x) continue;
    if (const auto fraction = short_fraction(*x, bits)) {
      point.coordinates.back() = {*fraction};
      continue;
    }
    std::vector<ExactNumber> numbers = powers(t, degree - 1);
    numbers.insert(numbers.begin(), *x);
    const auto relation = integer_relation(numbers, bits);
    if (!relation || (*relation)[0].is_zero()) return std::nullopt;
    for (std::size_t k = 1; k < relation->size(); ++k) point.coordinates.back().push_back(-(*relation)[k] / (*relation)[0]);
  }
  return point;
}

}  // namespace

std::optional<ExactPoint> guess_exactly(const std::vector<std::optional<ExactNumber>>& coordinates, int bits, int degree,
                                        const Ended& ended) {
  std::vector<ExactNumber> irrational;
  for (const auto& x : coordinates)
    if (x && !short_fraction(*x, bits)) irrational.push_back(*x);
  if (irrational.empty()) {
    ExactPoint point{{ExactNumber(0), ExactNumber(1)}, ExactNumber(-1), ExactNumber(1), {}, -1, 0};
    for (const auto& x : coordinates) {
      point.coordinates.emplace_back();
      if (x) point.coordinates.back() = {*short_fraction(*x, bits)};
    }
    return point;
  }
  // Candidates for a number whose powers span the field: each coordinate, then a combination with no luck.
  std::vector<ExactNumber> candidates = irrational;
  ExactNumber combination;
  for (std::size_t k = 0; k < irrational.size(); ++k)
    combination = combination + ExactNumber(static_cast<long>(k) + 1) * irrational[k];
  candidates.push_back(combination);
  for (int d = 2; d <= degree; ++d)
    for (const ExactNumber& t : candidates) {
      if (is_over(ended)) return std::nullopt;
      const auto p = integer_relation(powers(t, d), bits);
      if (!p || p->back().is_zero()) continue;
      if (auto point = in_terms_of(t, *p, coordinates, bits, ended)) return point;
    }
  return std::nullopt;
}

}  // namespace corank::solve
