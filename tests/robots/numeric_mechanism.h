// A mechanism in doubles: configurations found by Newton's method, Jacobians of its equations and of its velocity equation.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "corank/core/dense.h"
#include "corank/core/system.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A polynomial in doubles.
class NumericPolynomial {
 public:
  explicit NumericPolynomial(const Polynomial& f) {
    for (const Monomial& m : f.monomials) terms_.push_back({m.enclosure.mid(), m.factors});
  }
  double value(const VectorXd& x) const {
    double sum = 0;
    for (const auto& [coefficient, factors] : terms_) {
      double product = coefficient;
      for (const Factor& f : factors) product *= std::pow(x[f.variable], f.power);
      sum += product;
    }
    return sum;
  }
  void gradient(const VectorXd& x, MatrixXd& jacobian, Eigen::Index row) const {
    for (const auto& term : terms_)
      for (std::size_t i = 0; i < term.factors.size(); ++i) {
        double product =
            term.coefficient * term.factors[i].power * std::pow(x[term.factors[i].variable], term.factors[i].power - 1);
        for (std::size_t k = 0; k < term.factors.size(); ++k)
          if (k != i) product *= std::pow(x[term.factors[k].variable], term.factors[k].power);
        jacobian(row, term.factors[i].variable) += product;
      }
  }

 private:
  struct Term {
    double coefficient;
    std::vector<Factor> factors;
  };
  std::vector<Term> terms_;
};

/// Orthonormal columns that span the kernel; singular values below `zero` times the largest count as 0.
inline MatrixXd kernel(const MatrixXd& a, double zero = 1e-8) {
  if (a.rows() == 0) return MatrixXd::Identity(a.cols(), a.cols());
  const SingularValueDecomposition svd = decompose(a);
  Eigen::Index rank = 0;
  while (rank < svd.values.size() && svd.values[rank] > zero * svd.values[0]) ++rank;
  return svd.v.rightCols(a.cols() - rank);
}
inline Eigen::Index rank(const MatrixXd& a, double zero) {
  if (a.size() == 0) return 0;
  return (singular_values(a).array() > zero).count();
}

class NumericMechanism {
 public:
  explicit NumericMechanism(const symbolic::Mechanism& mechanism)
      : system_(symbolic::algebrize(symbolic::plain_system(mechanism))) {
    for (const Polynomial& f : system_.equations) equations_.emplace_back(f);
    for (const Polynomial& f : system_.inequalities) inequalities_.emplace_back(f);
    for (const symbolic::Constant& c : mechanism.constants()) constants_[c.name] = symbolic::evaluate(c.value, constants_);
  }

  const System& system() const { return system_; }
  VectorXd values(const VectorXd& x) const {
    VectorXd f(static_cast<Eigen::Index>(equations_.size()));
    for (std::size_t i = 0; i < equations_.size(); ++i) f[static_cast<Eigen::Index>(i)] = equations_[i].value(x);
    return f;
  }
  MatrixXd jacobian(const VectorXd& x) const {
    MatrixXd j = MatrixXd::Zero(static_cast<Eigen::Index>(equations_.size()), x.size());
    for (std::size_t i = 0; i < equations_.size(); ++i) equations_[i].gradient(x, j, static_cast<Eigen::Index>(i));
    return j;
  }
  double least_inequality(const VectorXd& x) const {
    double least = 1;
    for (const NumericPolynomial& g : inequalities_) least = std::min(least, g.value(x));
    return least;
  }

  /// A random point of the domain, at most 10 wide in each variable.
  VectorXd random_point(std::mt19937& random) const {
    VectorXd x(static_cast<Eigen::Index>(system_.variables.size()));
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const Interval& domain = system_.variables[static_cast<std::size_t>(i)].domain;
      const double lo = std::max(domain.lo(), -5.0), hi = std::min(domain.hi(), 5.0);
      x[i] = lo + (hi - lo) * std::uniform_real_distribution<>(0, 1)(random);
    }
    return x;
  }
  /// Newton's method from there, with steps of least length; the variables that are not `free` stay.
  std::optional<VectorXd> solution(VectorXd x, const std::vector<Eigen::Index>& fixed = {}) const {
    for (int step = 0; step < 100; ++step) {
      const VectorXd f = values(x);
      if (f.size() == 0 || f.lpNorm<Eigen::Infinity>() < 1e-13) return x;
      if (!(f.lpNorm<Eigen::Infinity>() < 1e8)) return std::nullopt;
      MatrixXd j = jacobian(x);
      for (const Eigen::Index k : fixed) j.col(k).setZero();
      VectorXd by = least_squares(j, f, 1e-9).x;
      if (by.norm() > 1) by /= by.norm();
      x -= by;
    }
    return values(x).lpNorm<Eigen::Infinity>() < 1e-11 ? std::optional(x) : std::nullopt;
  }
  /// A configuration that keeps the inequalities.
  std::optional<VectorXd> random_configuration(std::mt19937& random, int tries = 100) const {
    for (int i = 0; i < tries; ++i)
      if (const auto x = solution(random_point(random)); x && least_inequality(*x) > -1e-9) return x;
    return std::nullopt;
  }

  /// Constants, lengths and angles by their names.
  std::map<std::string, double> named(const VectorXd& x) const {
    std::map<std::string, double> result = constants_;
    for (std::size_t v = 0; v < system_.variables.size(); ++v)
      result[system_.variables[v].name] = x[static_cast<Eigen::Index>(v)];
    for (const Angle& a : system_.angles) result[a.name] = std::atan2(x[a.sine], x[a.cosine]);
    return result;
  }

 private:
  System system_;
  std::vector<NumericPolynomial> equations_, inequalities_;
  std::map<std::string, double> constants_;
};

}  // namespace corank::test
