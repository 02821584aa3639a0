#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <random>

#include "corank/core/system.h"
#include "corank/kinematics/assembly.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/singularity_system.h"

namespace corank::kinematics {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A polynomial in doubles.
class Numeric {
 public:
  explicit Numeric(const Polynomial& f) {
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

std::optional<int> sampled_mobility(const symbolic::Mechanism& mechanism) {
  constexpr int kTries = 60, kEnough = 5, kSteps = 60;
  constexpr double kZero = 1e-10, kRank = 1e-7;
  const System system = symbolic::algebrize(symbolic::plain_system(mechanism));
  std::vector<Numeric> equations, inequalities;
  for (const Polynomial& f : system.equations) equations.emplace_back(f);
  for (const Polynomial& f : system.inequalities) inequalities.emplace_back(f);
  const auto n = static_cast<Eigen::Index>(system.variables.size()), m = static_cast<Eigen::Index>(equations.size());
  std::mt19937 random(1);
  std::optional<int> mobility;
  for (int attempt = 0, found = 0; attempt < kTries && found < kEnough; ++attempt) {
    VectorXd x(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Interval& domain = system.variables[static_cast<std::size_t>(i)].domain;
      const double lo = std::max(domain.lo(), -1e3), hi = std::min(domain.hi(), 1e3);
      x[i] = lo + (hi - lo) * std::uniform_real_distribution<>(0, 1)(random);
    }
    double residual = 1;
    MatrixXd jacobian;
    Eigen::Index rank = 0;
    for (int step = 0; step < kSteps; ++step) {
      VectorXd f(m);
      jacobian = MatrixXd::Zero(m, n);
      for (Eigen::Index i = 0; i < m; ++i) {
        f[i] = equations[static_cast<std::size_t>(i)].value(x);
        equations[static_cast<std::size_t>(i)].gradient(x, jacobian, i);
      }
      residual = m > 0 ? f.lpNorm<Eigen::Infinity>() : 0;
      Eigen::JacobiSVD<MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
      svd.setThreshold(kRank);
      rank = m > 0 ? svd.rank() : 0;
      if (residual < kZero || m == 0) break;
      x -= svd.solve(f);
    }
    const bool inside =
        std::all_of(inequalities.begin(), inequalities.end(), [&](const Numeric& g) { return g.value(x) > -1e-9; });
    if (!(residual < kZero) || !inside) continue;
    ++found;
    // Special configurations are rarer than others, and have a lower rank.
    const int here = static_cast<int>(n - rank);
    mobility = mobility ? std::min(*mobility, here) : here;
  }
  return mobility;
}

}  // namespace corank::kinematics
