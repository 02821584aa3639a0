#include "corank/certify/refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

#include "corank/certify/multiprecision.h"
#include "corank/core/check.h"
#include "corank/core/dense.h"
#include "corank/core/exact_number_node.h"

namespace corank::certify {
namespace {

template <class T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
template <class T>
using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

const mpq_class& rational(const ExactNumber& x) {
  CORANK_CHECK(x.is_rational());
  return x.node().value;
}

Real to_real(const ExactNumber& x) {
  Real result;
  mpfr_set_q(result.data(), rational(x).get_mpq_t(), MPFR_RNDN);
  return result;
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

// The equations with coefficients of type T, and their values and derivatives.
template <class T>
class Equations {
 public:
  template <class Convert>
  Equations(const System& system, Convert convert) : system_(system) {
    for (const Polynomial& f : system.equations) {
      coefficients_.emplace_back();
      for (const Monomial& m : f.monomials) coefficients_.back().push_back(convert(m.coefficient));
    }
  }
  int rows() const { return static_cast<int>(coefficients_.size()); }

  T value(int row, const std::vector<T>& x) const {
    T sum(0);
    const auto& monomials = system_.equations[row].monomials;
    for (std::size_t k = 0; k < monomials.size(); ++k) {
      T product = coefficients_[row][k];
      for (const Factor& f : monomials[k].factors) product *= factor(f, x, f.power);
      sum += product;
    }
    return sum;
  }

  std::vector<T> gradient(int row, const std::vector<T>& x) const {
    std::vector<T> gradient(x.size(), T(0));
    const auto& monomials = system_.equations[row].monomials;
    for (std::size_t k = 0; k < monomials.size(); ++k)
      for (const Factor& by : monomials[k].factors) {
        T product = coefficients_[row][k];
        for (const Factor& f : monomials[k].factors)
          if (f.variable != by.variable) product *= factor(f, x, f.power);
        const T& at = x[by.variable];
        switch (by.function) {
          case Function::identity: product *= T(by.power) * factor(by, x, by.power - 1); break;
          case Function::sine: product *= cos(at); break;
          case Function::cosine: product *= -sin(at); break;
        }
        gradient[by.variable] += product;
      }
    return gradient;
  }

 private:
  static T factor(const Factor& f, const std::vector<T>& x, int power) {
    const T& at = x[f.variable];
    if (f.function == Function::sine) return sin(at);
    if (f.function == Function::cosine) return cos(at);
    T result(1);
    for (int k = 0; k < power; ++k) result *= at;
    return result;
  }

  const System& system_;
  std::vector<std::vector<T>> coefficients_;
};

Equations<Real> real_equations(const System& system, int bits) {
  return {system, [bits](const ExactNumber& c) {
            const auto bounds = c.bounds(bits);
            return (to_real(bounds.first) + to_real(bounds.second)) / 2;
          }};
}

template <class T>
Vector<T> values(const Equations<T>& f, const std::vector<T>& x) {
  Vector<T> result(f.rows());
  for (int row = 0; row < f.rows(); ++row) result(row) = f.value(row, x);
  return result;
}

template <class T>
Matrix<T> jacobian(const Equations<T>& f, const std::vector<T>& x) {
  Matrix<T> j(f.rows(), x.size());
  for (int row = 0; row < f.rows(); ++row) {
    const std::vector<T> gradient = f.gradient(row, x);
    for (std::size_t k = 0; k < x.size(); ++k) j(row, k) = gradient[k];
  }
  return j;
}

// Gauss–Newton until a step is below 2^−(bits/2); false where the steps do not become that short.
bool iterate(const Equations<Real>& f, std::vector<Real>& x, int bits, const Ended& ended) {
  const Real enough = ldexp(Real(1), -bits / 2 + 8), most_sizes = 1e6;
  Real far = 1;  // from lengths of any unit
  for (const Real& c : x) far = std::max(far, abs(c));
  far *= most_sizes;
  const int most = 2 * bits;
  constexpr int kSlowest = 64;  // steps for a bit: at a zero of multiplicity k it takes about 0.7 k
  Real shortest = far;
  int since = 0;
  for (int step = 0; step < most && !is_over(ended); ++step) {
    const Vector<Real> shift = jacobian(f, x).completeOrthogonalDecomposition().solve(values(f, x));
    Real length = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] -= shift(k);
      length = std::max(length, abs(shift(k)));
    }
    if (!(length < far)) return false;
    if (2 * length < shortest) shortest = length, since = step;
    if (step - since > kSlowest) return false;
    if (length < enough) {
      const Vector<Real> residual = values(f, x);
      return std::all_of(residual.begin(), residual.end(), [&](const Real& value) { return abs(value) < enough; });
    }
  }
  return false;
}

// Of each equation, what its terms may be together: a variable counts by its size at the start or in its domain.
std::vector<double> row_sizes(const System& system, const std::vector<double>& start) {
  double largest = 0;
  for (const double c : start) largest = std::max(largest, std::fabs(c));
  std::vector<double> result;
  for (const Polynomial& f : system.equations) {
    double sum = 0;
    for (const Monomial& m : f.monomials) {
      double product = m.enclosure.mag();
      for (const Factor& x : m.factors) {
        const std::size_t j = x.variable;
        if (x.function == Function::identity)
          product *= std::pow(std::max(std::fabs(start[j]), std::min(system.variables[j].domain.mag(), largest)), x.power);
      }
      sum += product;
    }
    result.push_back(sum);
  }
  return result;
}

// The same in doubles, which take a thousandth of the time: where least squares end at no zero, or at none at all, they say
// so. Nothing there; else the point that comes nearest.
std::optional<std::vector<double>> approached(const System& system, std::vector<double> x, const Ended& ended) {
  constexpr int kSteps = 300;
  constexpr double kEnough = 1e-13, kZero = 1e-6;  // of an equation's size
  const std::vector<double> sizes = row_sizes(system, x);
  const Equations<double> f(system, [](const ExactNumber& c) { return c.enclose().mid(); });
  std::vector<double> nearest = x;
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kSteps && least > kEnough && !is_over(ended); ++step) {
    const Eigen::VectorXd value = values(f, x);
    const Eigen::MatrixXd slopes = jacobian(f, x);
    double residual = 0;
    for (int row = 0; row < f.rows(); ++row)
      if (value(row) != 0) residual = std::max(residual, std::fabs(value(row)) / sizes[row]);
    if (!(residual < std::numeric_limits<double>::infinity()) || !slopes.allFinite()) break;
    if (residual < least) least = residual, nearest = x;
    const Eigen::VectorXd shift = least_squares(slopes, value).x;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] -= shift(k);
  }
  if (!(least < kZero)) return std::nullopt;
  return nearest;
}

// Gauss–Newton from a point that is exact to doubles, with the slopes there in doubles and values in `bits` bits: where the
// rank is the same all about, a step gains nearly the digits of a double, and takes a thousandth of the time of one whose
// slopes have `bits` bits. False where steps gain less.
bool iterate_with_double_slopes(const System& system, const Equations<Real>& f, const std::vector<double>& from,
                                std::vector<Real>& x, int bits) {
  constexpr double kThreshold = 1e-9, kLeastGain = 1e-4;
  const double enough = std::ldexp(1, -bits / 2 + 8);
  Eigen::MatrixXd slopes = jacobian(Equations<double>(system, [](const ExactNumber& c) { return c.enclose().mid(); }), from);
  if (slopes.size() == 0 || !slopes.allFinite()) return false;
  Eigen::VectorXd sizes = slopes.rowwise().lpNorm<Eigen::Infinity>();
  for (double& size : sizes) size = size > 0 ? std::exp2(std::ilogb(size)) : 1;
  slopes.array().colwise() /= sizes.array();
  for (double shortest = 1; shortest >= enough;) {
    const Vector<Real> value = values(f, x);
    Eigen::VectorXd residual(value.size());
    for (Eigen::Index k = 0; k < value.size(); ++k) residual(k) = mpfr_get_d(value(k).data(), MPFR_RNDN) / sizes(k);
    const Eigen::VectorXd shift = least_squares(slopes, residual, kThreshold).x;
    const double length = shift.lpNorm<Eigen::Infinity>();
    if (!(length <= kLeastGain * shortest)) return false;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] -= shift(k);
    shortest = length;
  }
  const Vector<Real> residual = values(f, x);
  return std::ranges::all_of(residual, [&](const Real& value) { return abs(value) < enough; });
}

std::vector<Real> reals(const std::vector<ExactNumber>& x) {
  std::vector<Real> result;
  for (const ExactNumber& c : x) result.push_back(to_real(c));
  return result;
}

// One test of the theorem with the bits of the current precision.
std::optional<std::vector<Range>> krawczyk(const System& system, const std::vector<ExactNumber>& start, int bits,
                                           const Ended& ended) {
  const std::size_t n = start.size();
  std::vector<Real> c = reals(start);
  const Equations<Real> approximate = real_equations(system, bits);
  constexpr int kSteps = 60;
  Matrix<Real> y;
  Real shortest = -1;
  for (int k = 0; k < kSteps; ++k) {  // Newton: until the steps shrink no more
    if (is_over(ended)) return std::nullopt;
    y = jacobian(approximate, c).completeOrthogonalDecomposition().pseudoInverse();
    const Vector<Real> value = values(approximate, c);
    Real length = 0;
    std::vector<Real> next = c;
    for (std::size_t i = 0; i < n; ++i) {
      Real shift = 0;
      for (std::size_t j = 0; j < n; ++j) shift += y(i, j) * value(j);
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
    for (std::size_t j = 0; j < n; ++j) newton[i] += Range(y(i, j)) * value[j];
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
        for (std::size_t b = 0; b < n; ++b) entry -= Range(y(i, b)) * rows[b][j];
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

std::optional<std::vector<ExactNumber>> approximate_zero(const System& system, const std::vector<ExactNumber>& start,
                                                         int bits, const Ended& ended) {
  CORANK_CHECK(start.size() == system.variables.size());
  const Precision precision(bits);
  std::vector<double> near;
  for (const ExactNumber& c : start) near.push_back(c.enclose().mid());
  const auto closer = approached(system, std::move(near), ended);
  if (!closer) return std::nullopt;
  const Equations<Real> f = real_equations(system, bits);
  std::vector<Real> x(closer->begin(), closer->end());
  if (!iterate_with_double_slopes(system, f, *closer, x, bits)) {
    x.assign(closer->begin(), closer->end());
    if (!iterate(f, x, bits, ended)) return std::nullopt;
  }
  std::vector<ExactNumber> result;
  for (const Real& c : x) result.push_back(from_mpfr(c.data()));
  return result;
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
