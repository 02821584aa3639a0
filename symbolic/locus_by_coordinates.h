// The locus of which cusps and nodes are asked for, with the derivative of Φ by coordinates as velocity equation: second
// derivatives need coordinates, and a mechanism's own rates have none.
#pragma once

#include <string>
#include <vector>

#include "corank/symbolic/singularity_system.h"

namespace corank::symbolic {

struct LocusByCoordinates {
  Mechanism mechanism;               ///< without rates of its own
  KernelQuestion kernel;             ///< right, nothing eliminated; its columns are coordinates
  std::vector<std::string> scales;   ///< one for each column
  std::string size_per_scale = "1";  ///< what makes a length's typical size of its scale
};

/// Throws ModelError where the locus has no square matrix, or the mobility is below 2: its image among the locked
/// coordinates is then no hypersurface that could have a cusp or cross itself. `scales`: none, or kernel_scales of the set.
LocusByCoordinates locus_by_coordinates(const Mechanism& mechanism, SingularitySet set,
                                        const std::vector<std::string>& scales);

}  // namespace corank::symbolic
