#include "corank/analyze/sets/fold_system.h"

#include <algorithm>
#include <cmath>

#include "corank/core/box.h"
#include "corank/solve/step/problem.h"

namespace corank::analyze {
namespace {

// ∂f/∂x_j, nothing where f has a sine or cosine of x_j.
std::optional<Polynomial> derivative(const Polynomial& f, int j) {
  Polynomial result;
  for (const Monomial& m : f.monomials) {
    const auto factor = std::ranges::find_if(m.factors, [&](const Factor& x) { return x.variable == j; });
    if (factor == m.factors.end()) continue;
    if (factor->function != Function::identity) return std::nullopt;
    std::vector<Factor> factors = m.factors;
    Factor& own = factors[factor - m.factors.begin()];
    const ExactNumber power(own.power);
    if (--own.power == 0) std::erase_if(factors, [&](const Factor& x) { return x.variable == j; });
    result.monomials.emplace_back(m.coefficient * power, std::move(factors));
  }
  return result;
}

Monomial times(const Monomial& m, const ExactNumber& scale, int variable) {
  std::vector<Factor> factors = m.factors;
  factors.push_back({variable, 1, Function::identity});  // behind all others
  return {m.coefficient * scale, std::move(factors)};
}

ExactNumber power_of_two(double size) { return ExactNumber::dyadic(std::exp2(std::round(std::log2(size)))); }

// Spread over directions, none of them a likely one.
ExactNumber generic(int k) { return ExactNumber::rational(std::to_string(61 + 37 * k % 59) + "/100"); }

}  // namespace

std::optional<System> fold_system(const System& system, const std::vector<int>& parameters,
                                  const std::vector<double>& sizes) {
  System result;
  result.name = system.name + " folds";
  result.variables = system.variables;
  result.inequalities = system.inequalities;
  result.equations = system.equations;
  const int n = system.size();
  const std::vector<int> unknowns = all_but(parameters, n);
  for (const int j : unknowns) result.variables[j].auxiliary = true;
  for (const int p : parameters)
    if (!system.variables[p].is_parameter()) result.variables[p].kind = VariableKind::length;
  result.configuration_size = n;

  Polynomial norm{{Monomial(ExactNumber(-1), {})}, "norm of xi"}, half{{}, "half-space of xi"};
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const int xi = n + static_cast<int>(k);
    std::string name = "xi" + std::to_string(k + 1);
    while (system.find(name) >= 0) name += "_";
    result.variables.emplace_back(name, VariableKind::kernel, ExactNumber(-1), ExactNumber(1));
    norm.monomials.emplace_back(ExactNumber(1), std::vector<Factor>{{xi, 2, Function::identity}});
    half.monomials.emplace_back(generic(static_cast<int>(k)), std::vector<Factor>{{xi, 1, Function::identity}});
  }
  for (const Polynomial& f : system.equations) {
    Polynomial row{{}, "kernel of " + f.source};
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const std::optional<Polynomial> of_x = derivative(f, unknowns[k]);
      if (!of_x) return std::nullopt;
      const ExactNumber scale = power_of_two(sizes[unknowns[k]]);
      for (const Monomial& m : of_x->monomials) {
        if (m.is_trigonometric()) return std::nullopt;
        row.monomials.push_back(times(m, scale, n + static_cast<int>(k)));
      }
    }
    if (!row.monomials.empty()) result.equations.push_back(std::move(row));
  }
  result.equations.push_back(std::move(norm));
  result.inequalities.push_back(std::move(half));
  return result;
}

}  // namespace corank::analyze
