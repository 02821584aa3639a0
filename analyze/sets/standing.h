// Does a configuration meet the requirements of its mechanism?
#pragma once

#include <span>
#include <vector>

#include "corank/core/box.h"
#include "corank/core/cover.h"
#include "corank/core/ended.h"
#include "corank/core/requirement.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::analyze {

/// satisfied: every solution in the box meets all of them; violated: none does. `space`: the equations of its
/// configurations, whose algebrized system's variables the box has. Throws ModelError as symbolic::Requirements does.
Standing standing_in(const symbolic::Mechanism& mechanism, const symbolic::TrigonometricSystem& space, const Box& box);

/// The same of each box; once `ended` is true, `open` of those that are left.
std::vector<Standing> standings_in(const symbolic::Mechanism& mechanism, const symbolic::TrigonometricSystem& space,
                                   std::span<const CoverBox> boxes, const Ended& ended = {});

}  // namespace corank::analyze
