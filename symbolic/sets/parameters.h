// A family of systems: constants and coordinates that run through ranges, the parameters, as unknowns of one system, which
// is a set's, or a plain one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/core/requirement.h"
#include "corank/core/system.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// A constant of the model, or a coordinate: an angle counts in radians, over any range.
struct Parameter {
  std::string name;
  Expression lower, upper;  ///< in numbers and constants that are no parameters
};

/// A coordinate that has one value.
struct FixedCoordinate {
  std::string name;
  Expression value;
};

/// On constants: what was decided by their values when equations were made of something else, such as a robot's geometry.
/// Where every expression keeps its sign, the same equations are made.
struct Condition {
  Expression value;
  int sign = 0;
};

/// Throws ModelError where a condition depends on a parameter, also through other constants, and is not proven to hold
/// for all of its values.
void check_conditions(const Mechanism& mechanism, const std::vector<Condition>& conditions,
                      const std::vector<Parameter>& parameters);

/// The system, its equations derived before, with its parameters as lengths at the end of its coordinates. Constants that
/// are defined through a parameter follow it. Constants that have tolerances stay what they are. A coordinate's range that
/// depends on a parameter is as wide as it gets for any value, and a fiftieth more. Half-spaces that drop the negatives of
/// kernel vectors are left out: `copies` says how many solutions then stand for one, 2 for each of them.
/// Throws ModelError where a name is none of a constant or coordinate or comes twice, an angle's range depends on a
/// parameter, and for a system in whose solutions a fixed coordinate has a second copy.
struct ParametricSystem {
  TrigonometricSystem system;
  std::vector<std::string> names;  ///< of the parameters
  int copies = 1;
};
ParametricSystem with_parameters(const Mechanism& mechanism, TrigonometricSystem system,
                                 const std::vector<Parameter>& parameters, const std::vector<FixedCoordinate>& fixed = {});

/// The variables of algebrize(system.system) that are its parameters; their ends are marked as no ends of the domain.
std::vector<int> mark_parameters(const ParametricSystem& system, System& polynomials);

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
  /// Variables of the system: those of FamilyQuestion::over in their order, then the constants that have tolerances.
  std::vector<int> parameters;
  int copies = 1;                           ///< as ParametricSystem's
  std::vector<Requirement> requirements{};  ///< the mechanism's
};

/// Throws ModelError as with_parameters and Requirements do, and for a set of parts or of a type.
FamilySystem family_system(const Mechanism& mechanism, const FamilyQuestion& question);

}  // namespace corank::symbolic
