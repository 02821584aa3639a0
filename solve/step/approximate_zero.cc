#include "corank/solve/step/approximate_zero.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

#include "corank/certify/polynomial_values.h"
#include "corank/core/check.h"
#include "corank/core/dense.h"

template <>
struct Eigen::NumTraits<corank::certify::Real> : Eigen::GenericNumTraits<corank::certify::Real> {
  using Real = corank::certify::Real;
  using NonInteger = Real;
  using Nested = Real;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = 10, AddCost = 20, MulCost = 40 };
  static Real epsilon() { return ldexp(Real(1), 1 - corank::certify::Precision::bits()); }
  static Real dummy_precision() { return 1000 * epsilon(); }
};

namespace corank::solve {
namespace {

using certify::Equations;
using certify::Precision;
using certify::Real;
template <class T>
using MatrixOf = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
template <class T>
using VectorOf = Eigen::Matrix<T, Eigen::Dynamic, 1>;

template <class T>
VectorOf<T> values(const Equations<T>& f, const std::vector<T>& x) {
  VectorOf<T> result(f.rows());
  for (int row = 0; row < f.rows(); ++row) result(row) = f.value(row, x);
  return result;
}

template <class T>
MatrixOf<T> jacobian(const Equations<T>& f, const std::vector<T>& x) {
  MatrixOf<T> j(f.rows(), x.size());
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
    const VectorOf<Real> shift = jacobian(f, x).completeOrthogonalDecomposition().solve(values(f, x));
    Real length = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] -= shift(k);
      length = std::max(length, abs(shift(k)));
    }
    if (!(length < far)) return false;
    if (2 * length < shortest) shortest = length, since = step;
    if (step - since > kSlowest) return false;
    if (length < enough) {
      const VectorOf<Real> residual = values(f, x);
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
    const VectorOf<Real> value = values(f, x);
    Eigen::VectorXd residual(value.size());
    for (Eigen::Index k = 0; k < value.size(); ++k) residual(k) = value(k).to_double() / sizes(k);
    const Eigen::VectorXd shift = least_squares(slopes, residual, kThreshold).x;
    const double length = shift.lpNorm<Eigen::Infinity>();
    if (!(length <= kLeastGain * shortest)) return false;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] -= shift(k);
    shortest = length;
  }
  const VectorOf<Real> residual = values(f, x);
  return std::ranges::all_of(residual, [&](const Real& value) { return abs(value) < enough; });
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
  const Equations<Real> f = certify::real_equations(system, bits);
  std::vector<Real> x(closer->begin(), closer->end());
  if (!iterate_with_double_slopes(system, f, *closer, x, bits)) {
    x.assign(closer->begin(), closer->end());
    if (!iterate(f, x, bits, ended)) return std::nullopt;
  }
  std::vector<ExactNumber> result;
  for (const Real& c : x) result.push_back(certify::to_exact(c));
  return result;
}

}  // namespace corank::solve
