// Sets and their parts as equations. A set that is the union of parts is solved as these, each by a system of its own: a
// workspace's boundary, by the limits that are met (boundary.h), a set whose matrix decomposes (decomposition.h), and that
// of requirements' limits (requirement_part.h).
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "corank/core/ended.h"
#include "corank/core/system.h"
#include "corank/symbolic/sets/boundary.h"
#include "corank/symbolic/sets/decomposition.h"
#include "corank/symbolic/sets/free_coordinates.h"
#include "corank/symbolic/sets/requirement_part.h"

namespace corank::symbolic {

using SetPart = std::variant<BoundaryPart, Component, RequirementPart>;

/// "theta2 at its upper limit"; "phi_rod1 = theta1". No two parts of a set have the same.
std::string text(const SetPart& part);
/// Is that its name, or the one that older programs gave it?
bool is_named(const SetPart& part, const std::string& name);
/// The condition of a part that has one in place of a kernel vector; else nullptr.
const Component* component_of(const SetPart& part);
/// Of a part in fewer coordinates those that, with the part's own, give all others; else none.
std::vector<std::string> joints(const SetPart& part);

/// boundary_parts(), requirement_parts(), or decompose(). Throws ModelError as these do.
/// A boundary's parts are without λ where that can be: all configurations with the largest number of limits reached are in
/// their part. The part without limits is one for each of its components, where its matrix, or of an arm that of the outputs
/// by the joints, becomes square and none of them has a block. Of an arm of many joints all parts are about these
/// (arm_boundary.h).
/// Of an arm whose singularities have dimension 3 or more, a part is about the joints alone that its condition or a range
/// mentions: it is the product of what is found there and of the other joints' ranges, and all other coordinates follow from
/// the joints (free_coordinates.h). In all coordinates such a set would be too large for boxes.
/// C-space of an arm of five joints or more is one part, in the joints that an inequality is about.
/// `free`: free_coordinates(), where somebody has asked for them before.
std::vector<SetPart> set_parts(const Mechanism& mechanism, SingularitySet set, const Ended& ended = {},
                               const std::optional<FreeCoordinates>* free = nullptr);

/// Is an arm's part that is about these coordinates alone, `own`, at most a surface with all those that its outputs depend
/// on? If it lacks some.
bool can_have_outputs(const Mechanism& mechanism, const std::vector<std::string>& own);
/// Makes it that, as who draws it wants it. False where it cannot be, or lacks none.
bool add_outputs(const Mechanism& mechanism, SetPart& part);

/// Puts beside a part's equations what is said of its solutions: of a boundary's whether the output can pass, of a curve or
/// points with a condition the matrix that is singular there. `compiled`: algebrize(equations).
void add_claims(const Mechanism& mechanism, SingularitySet set, const SetPart& part, const TrigonometricSystem& equations,
                System& compiled);

/// What solves a set, or one of its parts: what its kernel is asked of, made once. Throws ModelError as kernel_question(),
/// boundary_parts() and singularity_system() do.
class SetEquations {
 public:
  SetEquations(const Mechanism& mechanism, SingularitySet set, std::optional<KernelSide> side = std::nullopt);
  SetEquations(const Mechanism& mechanism, SingularitySet set, SetPart part);

  /// Of a right kernel, where it has such.
  void eliminate_passive_rates();
  /// Those that system() is meant to have (kernel_scale.h); none where there is no kernel vector.
  std::vector<std::string> scales() const;
  TrigonometricSystem system(const std::vector<std::string>& scales, int corank = 1) const;
  /// algebrize() of system(), of a part with add_claims().
  System compiled(const std::vector<std::string>& scales) const;

 private:
  void set_at_limits(const BoundaryPart& part, TrigonometricSystem& system) const;
  void add_condition(const Component& part, TrigonometricSystem& system) const;

  Mechanism whole_, mechanism_;  // as given, and whose configurations a part's are: mechanism_of() of a boundary's
  SingularitySet set_;
  std::optional<SetPart> part_;
  /// Nothing: of all configurations, cusps, nodes, or of a part without a kernel vector.
  std::optional<KernelQuestion> kernel_;
};

}  // namespace corank::symbolic
