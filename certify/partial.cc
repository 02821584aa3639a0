#include "corank/certify/partial.h"

#include <algorithm>

#include "corank/certify/cover.h"

namespace corank::certify {

RedundantEquations::RedundantEquations(const System& system) {
  tolerance_ = kPartialTolerance * system.coefficient_tolerance;
  for (const Polynomial& f : system.equations) {
    double sum = 0;
    for (const Monomial& m : f.monomials) sum += m.enclosure.mag();
    bounds_.push_back(tolerance_ * sum);
  }
}

bool RedundantEquations::hold(const CompiledSystem& system, const DomainTest& domain, const Preconditioner& p,
                              const Interval* x, NewtonWorkspace& w) const {
  if (domain.locate_zeros(system, p, x, w, tolerance_) != Location::inside) return false;
  for (int row = 0; row < system.equations(); ++row) {
    if (std::find(p.equations.begin(), p.equations.end(), row) != p.equations.end()) continue;
    if (!(value_at_zeros(system, p, row, x, w).mag() <= bounds_[static_cast<std::size_t>(row)])) return false;
  }
  return true;
}

}  // namespace corank::certify
