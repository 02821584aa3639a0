#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

#include "corank/core/dense.h"
#include "corank/core/system.h"
#include "corank/kinematics/equations/assembly.h"

namespace corank::kinematics {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A polynomial in doubles, of variables in their own units, divided by its largest coefficient: so the model's unit of
// length makes no difference.
class Numeric {
 public:
  Numeric(const Polynomial& f, const VectorXd& units) {
    double largest = 0;
    for (const Monomial& m : f.monomials) {
      double coefficient = m.enclosure.mid();
      for (const Factor& factor : m.factors) coefficient *= std::pow(units[factor.variable], factor.power);
      terms_.push_back({coefficient, m.factors});
      largest = std::max(largest, std::fabs(coefficient));
    }
    for (Term& term : terms_) term.coefficient /= largest;
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
    for (const auto& [coefficient, factors] : terms_)
      for (std::size_t i = 0; i < factors.size(); ++i) {
        double product = coefficient;
        for (std::size_t k = 0; k < factors.size(); ++k) {
          const int power = factors[k].power;
          product *= k == i ? power * std::pow(x[factors[k].variable], power - 1) : std::pow(x[factors[k].variable], power);
        }
        jacobian(row, factors[i].variable) += product;
      }
  }

 private:
  struct Term {
    double coefficient;
    std::vector<Factor> factors;
  };
  std::vector<Term> terms_;
};

}  // namespace

std::optional<int> sampled_redundancy(const System& system) {
  constexpr int kTries = 30, kEnough = 4, kSteps = 50;
  constexpr double kZero = 1e-10, kNear = 1e-9, kRank = 1e-7, kFar = 1e6;
  constexpr Eigen::Index kMostVariables = 300;  // dense matrices: beyond, decompositions take many seconds
  const auto n = static_cast<Eigen::Index>(system.variables.size()), m = static_cast<Eigen::Index>(system.equations.size());
  if (n > kMostVariables) return std::nullopt;
  VectorXd low(n), high(n), units(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Interval& domain = system.variables[i].domain;
    low[i] = std::max(domain.lo(), -1e3);
    high[i] = std::min(domain.hi(), 1e3);
    units[i] = std::max(std::fabs(low[i]), std::fabs(high[i]));
    if (!(units[i] > 0)) units[i] = 1;
  }
  std::vector<Numeric> equations, inequalities;
  for (const Polynomial& f : system.equations) equations.emplace_back(f, units);
  for (const Polynomial& f : system.inequalities) inequalities.emplace_back(f, units);
  // Outside its ranges a robot may pass configurations that it never takes. A variable with one value counts as free.
  const auto is_inside = [&](const VectorXd& x) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const Interval& domain = system.variables[i].domain;
      const double value = x[i] * units[i], near = kNear * units[i];
      if (domain.width() > 0 && (value < domain.lo() - near || value > domain.hi() + near)) return false;
    }
    return std::ranges::all_of(inequalities, [&](const Numeric& g) { return g.value(x) > -kNear; });
  };
  std::mt19937 random(1);
  std::optional<int> redundancy, outside;
  for (int attempt = 0, found = 0; attempt < kTries && found < kEnough; ++attempt) {
    VectorXd x(n);
    for (Eigen::Index i = 0; i < n; ++i)
      x[i] = (low[i] + (high[i] - low[i]) * std::uniform_real_distribution<>(0, 1)(random)) / units[i];
    double residual = 1;
    MatrixXd jacobian;
    Eigen::Index rank = 0;
    for (int step = 0; step < kSteps; ++step) {
      VectorXd f(m);
      jacobian = MatrixXd::Zero(m, n);
      for (Eigen::Index i = 0; i < m; ++i) {
        f[i] = equations[i].value(x);
        equations[i].gradient(x, jacobian, i);
      }
      residual = m > 0 ? f.lpNorm<Eigen::Infinity>() : 0;
      if (residual < kZero || m == 0 || !(residual < kFar)) break;
      x -= least_squares(jacobian, f, kRank).x;
    }
    if (!(residual < kZero)) continue;
    const bool inside = is_inside(x);
    found += inside ? 1 : 0;
    if (m > 0) {
      const VectorXd values = singular_values(jacobian);
      rank = (values.array() > kRank * values.maxCoeff()).count();
    }
    // Special configurations are rarer than others, and have a lower rank.
    const int here = static_cast<int>(m - rank);
    std::optional<int>& least = inside ? redundancy : outside;
    least = least ? std::min(*least, here) : here;
  }
  if (!redundancy && outside == 0) return outside;  // they are independent in general
  return redundancy;
}

}  // namespace corank::kinematics
