// Does a configuration meet the requirements of its mechanism?
#pragma once

#include "corank/core/box.h"
#include "corank/core/requirement.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::analyze {

/// satisfied: every solution in the box meets all of them; violated: none does. `space`: the equations of its
/// configurations, whose algebrized system's variables the box has. Throws ModelError as symbolic::Requirements does.
Standing standing_in(const symbolic::Mechanism& mechanism, const symbolic::TrigonometricSystem& space, const Box& box);

}  // namespace corank::analyze
