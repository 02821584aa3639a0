// Sets that are the union of parts, each the solutions of a system of its own: a workspace's boundary, by the limits that
// are met (boundary.h), and a set whose matrix decomposes (decomposition.h).
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "corank/core/ended.h"
#include "corank/core/system.h"
#include "corank/symbolic/boundary.h"
#include "corank/symbolic/decomposition.h"

namespace corank::symbolic {

using SetPart = std::variant<BoundaryPart, Component>;

/// "theta2 at its upper limit"; "phi_rod1 = theta1". No two parts of a set have the same.
std::string text(const SetPart& part);

/// boundary_parts(), or decompose(). Throws ModelError as these do.
std::vector<SetPart> set_parts(const Mechanism& mechanism, SingularitySet set, const Ended& ended = {});

/// The scales of the part's kernel vector, where it has one.
std::vector<std::string> part_scales(const Mechanism& mechanism, SingularitySet set, const SetPart& part);
TrigonometricSystem part_system(const Mechanism& mechanism, SingularitySet set, const SetPart& part,
                                const std::vector<std::string>& scales);
/// algebrize() of it, of a boundary's part with its passage form.
System compiled_part(const Mechanism& mechanism, SingularitySet set, const SetPart& part,
                     const std::vector<std::string>& scales);

}  // namespace corank::symbolic
