#include "corank/analyze/witness.h"

#include <cmath>

#include "corank/core/box.h"
#include "corank/solve/problem.h"

namespace corank::analyze {

Box lifted(const certify::CompiledSystem& compiled, const certify::Reduction& reduction, const Box& x) {
  Box sides(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(reduction.kept.size()));
  for (int k = 0; k < compiled.values(); ++k) sides.push_back(compiled.evaluate(compiled.value_row(k), x));
  return reduction.lift(sides);
}

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
        shift += p.y[a * p.rank() + b] * system.evaluate_at(p.equations[b], now.data()).mid();
      const double moved = now[p.dependent[a]] - shift;
      if (!std::isfinite(moved)) return std::nullopt;
      x[p.dependent[a]] = moved;
    }
  }
  const certify::Preconditioner& p = preconditioners.at_midpoint(x);
  if (p.rank() < system.equations()) return std::nullopt;
  Witness witness{certify::newton_prove(system, p, x, workspace), {}};
  if (!witness.sheet.proven || domain.locate(system, witness.sheet.image) != certify::Location::inside) return std::nullopt;
  witness.free = solve::other_variables(p.dependent, system.variables());
  return witness;
}

}  // namespace corank::analyze
