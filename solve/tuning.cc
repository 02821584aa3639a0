#include "corank/solve/tuning.h"

#include <algorithm>

namespace corank::solve {
namespace {

// Measured, see "Newton until it stalls" in bench/HISTORY.md. C-spaces might have fewer, larger boxes, but aspects are told
// from these; each division of a surface of singularities makes many boxes.
constexpr Tuning kUsual{0.3, 4, 1.5, 1.5, 0.1, 0.2};
constexpr Tuning kForPoints{0.07, 8, 1.5, 1.5, 0.1, 0.2};
constexpr Tuning kForSingularCurves{0.1, 4, 1.5, 1.5, 0.1, 0.2};
constexpr Tuning kForSingularSurfaces{0.02, 20, 2, 3, 0.5, 0.03};

}  // namespace

Tuning tuning_for(const System& system, bool tolerant) {
  const std::size_t dimension = system.variables.size() - std::min(system.variables.size(), system.equations.size());
  const bool singular = std::any_of(system.variables.begin(), system.variables.end(),
                                    [](const Variable& v) { return v.kind == VariableKind::kernel; });
  if (dimension == 0) return tolerant || singular ? kUsual : kForPoints;
  if (!singular) return kUsual;
  return dimension == 1 ? kForSingularCurves : kForSingularSurfaces;
}

}  // namespace corank::solve
