#include "corank/analyze/sets/distance_system.h"

#include <algorithm>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/problem.h"

namespace corank::analyze {
namespace {

Polynomial variable(int j, const ExactNumber& coefficient = 1, int power = 1) {
  Polynomial p;
  p.monomials.emplace_back(coefficient, std::vector<Factor>{{j, power}});
  return p;
}

// The linear polynomial of the original variables in the reduced system's.
Polynomial reduced(const Polynomial& f, const certify::Reduction& reduction) {
  Polynomial result;
  for (const Monomial& m : f.monomials) {
    CORANK_CHECK(m.degree() <= 1 && !m.is_trigonometric());
    Polynomial value;
    if (m.factors.empty()) {
      value.monomials.emplace_back(1, std::vector<Factor>{});
    } else {
      const int v = m.factors[0].variable;
      const auto kept = std::ranges::find(reduction.kept, v);
      if (kept != reduction.kept.end()) {
        value = variable(static_cast<int>(kept - reduction.kept.begin()));
      } else {
        const auto by = std::ranges::find_if(reduction.definitions, [v](const auto& d) { return d.variable == v; });
        CORANK_CHECK(by != reduction.definitions.end());
        value = by->value;
      }
    }
    result = certify::sum(result, m.coefficient, value);
  }
  return result;
}

// A variable whose domain holds the interval in its interior.
Variable around(const std::string& name, const Interval& x) {
  const double room = 1e-3 * (x.width() > 0 ? x.width() : x.mag() > 0 ? x.mag() : 1);
  Variable v(name, VariableKind::auxiliary, ExactNumber::dyadic(x.lo() - room), ExactNumber::dyadic(x.hi() + room));
  v.auxiliary = true;
  return v;
}

// Of several variables, not all of them kernel unknowns.
bool is_joint(const Polynomial& f, const System& system) {
  bool configuration = false;
  int variables = 0;
  for (int j = 0; j < system.size(); ++j) {
    if (!certify::mentions(f, j)) continue;
    ++variables;
    configuration = configuration || system.variables[j].kind != VariableKind::kernel;
  }
  return configuration && variables > 1;
}

// g ≥ 0 becomes g = s, s ≥ 0: where the nearest solution is on the edge of what is allowed, the distance hardly depends on
// the other variables once s is one that Newton's steps may leave free.
void add_slack(System& system) {
  std::vector<Polynomial> rest;
  for (const Polynomial& g : std::vector<Polynomial>(std::move(system.inequalities))) {
    const Interval range = is_joint(g, system) ? certify::evaluate(g, system.domain()) : Interval(-1);
    if (range.hi() <= 0) {
      rest.push_back(g);
      continue;
    }
    const double most = range.hi() * (1 + 1e-3);
    system.variables.emplace_back("slack_" + std::to_string(system.size()), VariableKind::auxiliary, 0,
                                  ExactNumber::dyadic(most));
    system.variables.back().auxiliary = true;
    system.equations.push_back(certify::sum(variable(system.size() - 1), -1, g));
    system.equations.back().source = g.source;
  }
  system.inequalities = std::move(rest);
}

}  // namespace

DistanceSystem distance_system(const certify::Reduction& reduction, const std::vector<Polynomial>& differences) {
  const UpwardRounding rounding;
  DistanceSystem result{reduction.system, 0, solve::values_of(reduction)};
  System& system = result.system;
  add_slack(system);
  std::vector<Interval> domain = system.domain();
  Polynomial squares;
  Interval most;
  for (std::size_t k = 0; k < differences.size(); ++k) {
    const Polynomial value = reduced(differences[k], reduction);
    const Interval range = certify::evaluate(value, domain);
    system.variables.push_back(around("distance_" + std::to_string(k + 1), range));
    domain.push_back(system.variables.back().domain);
    const int d = system.size() - 1;
    system.equations.push_back(certify::sum(variable(d), -1, value));
    system.equations.back().source = "difference";
    squares = certify::sum(squares, 1, variable(d, 1, 2));
    most += square(domain.back());
  }
  system.variables.push_back(around("squared distance", most));
  result.squared = system.size() - 1;
  system.equations.push_back(certify::sum(variable(result.squared), -1, squares));
  system.equations.back().source = "squared distance";
  return result;
}

}  // namespace corank::analyze
