#include "corank/analyze/witness.h"

#include <algorithm>
#include <cmath>

#include "corank/core/box.h"

namespace corank::analyze {

std::optional<Witness> prove_near(const certify::CompiledSystem& system, const certify::DomainTest& domain,
                                  const std::vector<double>& point, solve::PreconditionerFactory& preconditioners,
                                  certify::NewtonWorkspace& workspace) {
  constexpr int kCorrections = 4;
  std::vector<Interval> x(point.begin(), point.end());
  for (int step = 0; step < kCorrections; ++step) {
    const certify::Preconditioner& p = preconditioners.at_midpoint(x);
    if (p.rank() < system.equations()) return std::nullopt;
    std::vector<double> now = midpoint(x);
    for (int a = 0; a < p.rank(); ++a) {
      double shift = 0;
      for (int b = 0; b < p.rank(); ++b)
        shift += p.y[static_cast<std::size_t>(a * p.rank() + b)] * system.evaluate_at(p.equations[b], now.data()).mid();
      const double moved = now[static_cast<std::size_t>(p.dependent[a])] - shift;
      if (!std::isfinite(moved)) return std::nullopt;
      x[static_cast<std::size_t>(p.dependent[a])] = moved;
    }
  }
  const certify::Preconditioner& p = preconditioners.at_midpoint(x);
  if (p.rank() < system.equations()) return std::nullopt;
  Witness witness{certify::newton_prove(system, p, x, workspace), {}};
  if (!witness.sheet.proven || domain.locate(system, witness.sheet.image) != certify::Location::inside) return std::nullopt;
  for (int j = 0; j < system.variables(); ++j)
    if (std::find(p.dependent.begin(), p.dependent.end(), j) == p.dependent.end()) witness.free.push_back(j);
  return witness;
}

}  // namespace corank::analyze
