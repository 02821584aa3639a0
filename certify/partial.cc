#include "corank/certify/partial.h"

#include <algorithm>

#include "corank/core/cover.h"

namespace corank::certify {

RedundantEquations::RedundantEquations(const System& system) {
  tolerance_ = kPartialTolerance * system.coefficient_tolerance;
  for (const Polynomial& f : system.equations) {
    double sum = 0;
    for (const Monomial& m : f.monomials) sum += m.enclosure.mag();
    bounds_.push_back(tolerance_ * sum);
  }
}

bool RedundantEquations::hold(const DomainTest& domain, const NewtonStep& step, std::span<const Interval> x) const {
  if (domain.locate_zeros(step, x, tolerance_) != Location::inside) return false;
  const std::vector<int>& equations = step.equations();
  for (int row = 0; row < step.system().equations(); ++row) {
    if (std::find(equations.begin(), equations.end(), row) != equations.end()) continue;
    if (!(step.value_at_zeros(row, x).mag() <= bounds_[static_cast<std::size_t>(row)])) return false;
  }
  return true;
}

}  // namespace corank::certify
