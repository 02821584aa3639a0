#include "corank/certify/implied_equation.h"

#include <algorithm>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/check.h"

namespace corank::certify {

Polynomial implied_equation(const System& system, const ImpliedEquation& of) {
  Polynomial h;
  for (const ImpliedEquation::Part& part : of.parts) {
    CORANK_CHECK(part.equation >= 0 && part.factor.is_rational());
    const auto k = static_cast<std::size_t>(part.equation);
    const std::size_t m = system.equations.size();
    CORANK_CHECK(k < m + system.implied.size());
    h = sum(h, part.factor, product(k < m ? system.equations[k] : system.implied[k - m], part.product));
  }
  return h;
}

void add_implied(Reduction& reduction, const ImpliedEquation& of, const std::string& source) {
  Polynomial h = implied_equation(reduction.system, of);
  h.source = source;
  ImpliedEquation step = of;
  const int m = static_cast<int>(reduction.system.equations.size());
  for (ImpliedEquation::Part& part : step.parts) {
    part.equation = part.equation < m ? reduction.origins[static_cast<std::size_t>(part.equation)]
                                      : reduction.given_equations + (part.equation - m);
    for (Factor& x : part.product) x.variable = reduction.kept[static_cast<std::size_t>(x.variable)];
    // `kept` ascends, so the factors stay sorted.
  }
  reduction.system.implied.push_back(std::move(h));
  reduction.steps.emplace_back(std::move(step));
}

}  // namespace corank::certify
