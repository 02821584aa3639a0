// A preconditioner for given dependent variables: any choice is valid (certify/newton.h), this one serves pieces whose
// chart is known.
#pragma once

#include <vector>

#include "corank/certify/newton.h"

namespace corank::certify {

/// All m equations, these m dependents, Y the inverse of their Jacobian at the point, in floating point; 0 where it has
/// none.
Preconditioner midpoint_preconditioner(const CompiledSystem& system, const std::vector<double>& point,
                                       const std::vector<int>& dependent);

}  // namespace corank::certify
