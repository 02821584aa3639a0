// A solution that exists: from a point in doubles to a proof.
#pragma once

#include <optional>
#include <vector>

#include "corank/certify/domain.h"
#include "corank/certify/newton.h"
#include "corank/certify/reduction.h"
#include "corank/solve/preconditioner.h"

namespace corank::analyze {

/// In the search domain and satisfying the inequalities: for its free variables' values, which are points, exactly one
/// solution in the sheet's region, and it lies in the image (certify::newton_prove).
struct Witness {
  certify::Sheet sheet;
  std::vector<int> free;
};

/// The box in all variables of the system that was reduced. `compiled`: begins with the reduced system's variables; its
/// values are those of the eliminated ones (solve::values_of).
Box lifted(const certify::CompiledSystem& compiled, const certify::Reduction& reduction, const Box& x);

/// Near the point; nothing where it cannot be proven.
std::optional<Witness> prove_near(const certify::CompiledSystem& system, const certify::DomainTest& domain,
                                  const std::vector<double>& point, solve::PreconditionerFactory& preconditioners,
                                  certify::NewtonWorkspace& workspace);

}  // namespace corank::analyze
