// A solution that exists: from a point in doubles to a proof.
#pragma once

#include <optional>
#include <vector>

#include "corank/certify/domain.h"
#include "corank/certify/newton.h"
#include "corank/solve/preconditioner.h"

namespace corank::analyze {

/// In the search domain and satisfying the inequalities: for its free variables' values, which are points, exactly one
/// solution in the sheet's region, and it lies in the image (certify::newton_prove).
struct Witness {
  certify::Sheet sheet;
  std::vector<int> free;
};

/// Near the point; nothing where it cannot be proven.
std::optional<Witness> prove_near(const certify::CompiledSystem& system, const certify::DomainTest& domain,
                                  const std::vector<double>& point, solve::PreconditionerFactory& preconditioners,
                                  certify::NewtonWorkspace& workspace);

}  // namespace corank::analyze
