// The parts of a set by name, and solutions of a system by Newton's method in doubles, of which a search must not lose any.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "corank/core/dense.h"
#include "corank/core/system.h"
#include "corank/study/question.h"

namespace corank::test {

inline std::vector<std::string> names_of(const std::vector<study::Question>& parts) {
  std::vector<std::string> names;
  for (const study::Question& part : parts) names.push_back(part.part ? text(*part.part) : "whole");
  return names;
}

inline double value_of(const Polynomial& f, const Eigen::VectorXd& x) {
  double sum = 0;
  for (const Monomial& m : f.monomials) {
    double product = m.enclosure.mid();
    for (const Factor& factor : m.factors) product *= std::pow(x[factor.variable], factor.power);
    sum += product;
  }
  return sum;
}

// By the variables that occur in it alone: there are many others.
inline void add_derivatives(const Polynomial& f, const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian, Eigen::Index row) {
  for (const Monomial& m : f.monomials)
    for (const Factor& by : m.factors) {
      double product = m.enclosure.mid();
      for (const Factor& factor : m.factors)
        product *= &factor == &by ? factor.power * std::pow(x[factor.variable], factor.power - 1)
                                  : std::pow(x[factor.variable], factor.power);
      jacobian(row, by.variable) += product;
    }
}

// A solution near a random start, by Gauss–Newton steps; nothing where these do not converge inside the domain.
inline std::optional<Eigen::VectorXd> sample(const System& system, std::mt19937_64& random) {
  const auto n = static_cast<Eigen::Index>(system.variables.size()), m = static_cast<Eigen::Index>(system.equations.size());
  Eigen::VectorXd x(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Interval& domain = system.variables[static_cast<std::size_t>(j)].domain;
    x[j] = std::uniform_real_distribution<>(domain.lo(), domain.hi())(random);
  }
  for (int step = 0; step < 60; ++step) {
    Eigen::VectorXd f(m);
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(m, n);
    for (Eigen::Index i = 0; i < m; ++i) {
      const Polynomial& equation = system.equations[static_cast<std::size_t>(i)];
      f[i] = value_of(equation, x);
      add_derivatives(equation, x, jacobian, i);
    }
    if (f.lpNorm<Eigen::Infinity>() < 1e-11) {
      for (Eigen::Index j = 0; j < n; ++j)
        if (!system.variables[static_cast<std::size_t>(j)].domain.contains(x[j])) return std::nullopt;
      for (const Polynomial& g : system.inequalities)
        if (value_of(g, x) < 0) return std::nullopt;
      return x;
    }
    const Eigen::VectorXd change = least_squares(jacobian, f, 1e-9).x;
    if (!(change.norm() < 1e3)) return std::nullopt;
    x -= change;
  }
  return std::nullopt;
}

}  // namespace corank::test
