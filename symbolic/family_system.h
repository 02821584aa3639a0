// The polynomial system of a family: a set's equations, or a plain system's, with its parameters as variables.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/system.h"
#include "corank/symbolic/parameters.h"

namespace corank::symbolic {

/// Which family of a mechanism.
struct FamilyQuestion {
  std::optional<SingularitySet> set{};  ///< nothing: the model's own equations
  std::optional<KernelSide> kernel{};
  int corank = 1;
  std::vector<Parameter> over;
  std::vector<FixedCoordinate> fixed{};
};

struct FamilySystem {
  System system;
  std::vector<int> parameters;  ///< variables of the system, in the order of FamilyQuestion::over
  int copies = 1;               ///< as ParametricSystem's
};

/// Throws ModelError as with_parameters does, and for a set of parts or of a type.
FamilySystem family_system(const Mechanism& mechanism, const FamilyQuestion& question);

}  // namespace corank::symbolic
