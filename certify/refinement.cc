#include "corank/certify/refinement.h"

#include <algorithm>

#include "corank/certify/polynomial_values.h"
#include "corank/core/check.h"
#include "corank/core/exact_number_node.h"

namespace corank::certify {
namespace {

const mpq_class& rational(const ExactNumber& x) {
  CORANK_CHECK(x.is_rational());
  return x.node().value;
}

ExactNumber from_mpfr(mpfr_srcptr x) {
  mpq_class q;
  mpfr_get_q(q.get_mpq_t(), x);
  return ExactNumber::Node::number(std::move(q));
}

Range to_range(const std::pair<ExactNumber, ExactNumber>& bounds) {
  Range lower, upper;
  mpfi_set_q(lower, rational(bounds.first).get_mpq_t());
  mpfi_set_q(upper, rational(bounds.second).get_mpq_t());
  mpfi_union(lower, lower, upper);
  return lower;
}

// The inverse of a matrix by its rows, by elimination; nothing where a pivot is 0. Any matrix is valid in the theorem.
std::optional<std::vector<std::vector<Real>>> inverse(std::vector<std::vector<Real>> a) {
  const std::size_t n = a.size();
  std::vector<std::vector<Real>> y(n, std::vector<Real>(n));
  for (std::size_t i = 0; i < n; ++i) y[i][i] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (abs(a[i][k]) > abs(a[pivot][k])) pivot = i;
    if (!(abs(a[pivot][k]) > Real(0))) return std::nullopt;
    std::swap(a[k], a[pivot]);
    std::swap(y[k], y[pivot]);
    const Real size = a[k][k];
    for (Real& x : a[k]) x /= size;
    for (Real& x : y[k]) x /= size;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const Real factor = a[i][k];
      for (std::size_t j = 0; j < n; ++j) a[i][j] -= factor * a[k][j], y[i][j] -= factor * y[k][j];
    }
  }
  return y;
}

// One test of the theorem with the bits of the current precision.
std::optional<std::vector<Range>> krawczyk(const System& system, const std::vector<ExactNumber>& start, int bits,
                                           const Ended& ended) {
  const std::size_t n = start.size();
  std::vector<Real> c;
  for (const ExactNumber& x : start) c.push_back(to_real(x));
  const Equations<Real> approximate = real_equations(system, bits);
  constexpr int kSteps = 60;
  std::vector<std::vector<Real>> y;
  Real shortest = -1;
  for (int k = 0; k < kSteps; ++k) {  // Newton: until the steps shrink no more
    if (is_over(ended)) return std::nullopt;
    std::vector<std::vector<Real>> slopes;
    std::vector<Real> value;
    for (std::size_t i = 0; i < n; ++i) {
      slopes.push_back(approximate.gradient(static_cast<int>(i), c));
      value.push_back(approximate.value(static_cast<int>(i), c));
    }
    auto inverted = inverse(std::move(slopes));
    if (!inverted) return std::nullopt;
    y = std::move(*inverted);
    Real length = 0;
    std::vector<Real> next = c;
    for (std::size_t i = 0; i < n; ++i) {
      Real shift = 0;
      for (std::size_t j = 0; j < n; ++j) shift += y[i][j] * value[j];
      next[i] -= shift;
      length = std::max(length, abs(shift));
    }
    if (!isfinite(length)) return std::nullopt;
    if (shortest >= 0 && length >= shortest) break;
    shortest = length;
    c = std::move(next);
  }
  const Equations<Range> f(system, [bits](const ExactNumber& x) { return to_range(x.bounds(bits)); });
  std::vector<Range> center;
  for (const Real& x : c) center.emplace_back(x);
  std::vector<Range> value(n), newton(n);  // F(c), Y·F(c)
  for (std::size_t i = 0; i < n; ++i) value[i] = f.value(static_cast<int>(i), center);
  for (std::size_t i = 0; i < n; ++i) {
    newton[i] = Range(0);
    for (std::size_t j = 0; j < n; ++j) newton[i] += Range(y[i][j]) * value[j];
  }
  // X = c + a symmetric range: twice the Newton correction, widened until the image fits.
  const Real tiny = ldexp(Real(1), -bits + 4);
  std::vector<Real> radius(n);
  for (std::size_t i = 0; i < n; ++i)
    radius[i] =
        2 * std::max(abs(Real(newton[i].lower())), abs(Real(newton[i].upper()))) + tiny * std::max(Real(1), abs(c[i]));
  constexpr int kInflations = 6;
  std::vector<Range> offset(n), box(n), image(n);
  for (int k = 0; k < kInflations && !is_over(ended); ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      const Range r(radius[i]);
      mpfi_neg(offset[i], r);
      mpfi_union(offset[i], offset[i], r);
      box[i] = center[i] + offset[i];
    }
    std::vector<std::vector<Range>> rows;
    for (int row = 0; row < f.rows(); ++row) rows.push_back(f.gradient(row, box));
    bool inside = true;
    for (std::size_t i = 0; i < n; ++i) {
      image[i] = -newton[i];
      for (std::size_t j = 0; j < n; ++j) {
        Range entry(i == j ? 1 : 0);
        for (std::size_t b = 0; b < n; ++b) entry -= Range(y[i][b]) * rows[b][j];
        image[i] += entry * offset[j];
      }
      image[i] += center[i];
      inside = inside && mpfi_is_strictly_inside(image[i], box[i]) > 0;
    }
    if (inside) return image;
    for (std::size_t i = 0; i < n; ++i) radius[i] *= 2;
  }
  return std::nullopt;
}

}  // namespace

Real to_real(const ExactNumber& x) {
  Real result;
  mpfr_set_q(result.data(), rational(x).get_mpq_t(), MPFR_RNDN);
  return result;
}

ExactNumber to_exact(const Real& x) { return from_mpfr(x.data()); }

Equations<Real> real_equations(const System& system, int bits) {
  return {system, [bits](const ExactNumber& c) {
            const auto bounds = c.bounds(bits);
            return (to_real(bounds.first) + to_real(bounds.second)) / 2;
          }};
}

std::optional<ProvenZero> prove_zero(const System& system, const std::vector<ExactNumber>& start, int digits, int max_bits,
                                     const Ended& ended) {
  CORANK_CHECK(start.size() == system.variables.size());
  if (system.equations.size() != system.variables.size()) return std::nullopt;
  for (int bits = 53; bits <= max_bits && !is_over(ended); bits *= 2) {
    const Precision precision(bits);
    const auto image = krawczyk(system, start, bits, ended);
    if (!image) continue;
    const Real width = pow(Real(10), -digits);
    const bool narrow = std::ranges::all_of(*image, [&](const Range& x) {
      const Real lo(x.lower()), hi(x.upper());
      return hi - lo <= width * std::max(Real(1), abs(lo));
    });
    if (!narrow) continue;
    ProvenZero zero{{}, bits};
    for (const Range& x : *image) zero.sides.emplace_back(from_mpfr(x.lower()), from_mpfr(x.upper()));
    return zero;
  }
  return std::nullopt;
}

std::pair<ExactNumber, ExactNumber> bounds(const Polynomial& f,
                                           const std::vector<std::pair<ExactNumber, ExactNumber>>& sides, int bits) {
  const Precision precision(bits);
  System one;  // whose only equation is f
  one.equations.push_back(f);
  std::vector<Range> x;
  for (const auto& side : sides) x.push_back(to_range(side));
  const Range value = Equations<Range>(one, [bits](const ExactNumber& c) { return to_range(c.bounds(bits)); }).value(0, x);
  return {from_mpfr(value.lower()), from_mpfr(value.upper())};
}

std::string proven_decimal(const ExactNumber& lower, const ExactNumber& upper, int digits) {
  const mpq_class lo = rational(lower), hi = rational(upper);
  for (int places = digits; places >= 0; --places) {
    mpz_class scale;
    mpz_ui_pow_ui(scale.get_mpz_t(), 10, static_cast<unsigned long>(places));
    // The integer nearest to the middle, in units of the last digit.
    const mpq_class middle = (lo + hi) / 2 * scale + mpq_class(1, 2);
    mpz_class last;
    mpz_fdiv_q(last.get_mpz_t(), middle.get_num_mpz_t(), middle.get_den_mpz_t());
    if (lo * scale <= last - 1 || hi * scale >= last + 1) continue;
    std::string text = mpz_class(abs(last)).get_str();
    if (static_cast<int>(text.size()) <= places) text.insert(0, places + 1 - text.size(), '0');
    if (places > 0) text.insert(text.size() - places, ".");
    const bool exact = lo == hi && lo * scale == last;
    while (exact && places > 0 && text.back() == '0') text.pop_back();
    if (exact && text.back() == '.') text.pop_back();
    return (last < 0 ? "-" : "") + text;
  }
  return "?";
}

}  // namespace corank::certify
