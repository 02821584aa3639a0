// What a limit on a line (LimitCompanion, requirements.h) asks of a kernel vector ξ besides A m = 0, m its scaled rates:
//   r_g = ‖m_g‖,  Σ_g weight_g r_g = bound m_last,  ‖ξ‖ = 1.
#pragma once

#include <vector>

#include "corank/symbolic/sets/requirement_conditions.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// Adds the r_g, in units of the largest scale of their columns, so that they are 1 at most, and the equations. Where m_last
/// is 0, both ξ and −ξ are there.
void add_limit_on_a_line(TrigonometricSystem& system, const Mechanism& mechanism, const VelocityCondition& condition,
                         const std::vector<Expression>& rates);

}  // namespace corank::symbolic
