// The boundary of an arm's workspace, asked of its joints alone.
//
// Let the joints q give all other coordinates (free_coordinates.h), and so the outputs u = f(q). The equations of the other
// coordinates have each an entry 1 of their own, so λᵀ Φ_z = 0 of a part with the limits A (boundary.h) is μᵀ J = 0, where J
// is ∂f/∂q without the columns of A and μ are the outputs' components of λ. Of three columns the determinant is 0, of more
// their rows are dependent, of fewer there is always such a μ. A frame R(q), a product of turns by joint angles, changes
// nothing about that, and R J often does not mention the joints before the first that is not in A: the part is a product
// with their ranges.
#pragma once

#include <optional>

#include "corank/symbolic/sets/boundary.h"
#include "corank/symbolic/sets/free_coordinates.h"

namespace corank::symbolic {

/// Has an arm so many joints that its singularities are more than a surface?
bool is_large(const FreeCoordinates& joints);

/// Of an arm the outputs' derivatives by its joints, which have lost rank where the kernel's matrix has.
void put_into_joints(const Mechanism& mechanism, const FreeCoordinates& free, KernelQuestion& kernel);

/// Of an arm with some joints at their limits: the product with the others' ranges, where that is more than a surface.
std::optional<Component> product_at_limits(const FreeCoordinates& free, const BoundaryPart& part);

class ArmBoundary {
 public:
  /// `moving`: without idle coordinates. Nothing where it is no large arm, has fewer than three outputs (their boundary is
  /// curves, of which the whole says more), or more than joints, or one that is a joint.
  static std::optional<ArmBoundary> of(const Mechanism& moving, const std::optional<FreeCoordinates>& free,
                                       const Ended& ended = {});

  /// What is asked of a part: where `kernel` has a left one.
  struct Question {
    Mechanism joints;                            ///< and one coordinate that they give; those at their limits have one value
    FreeCoordinates free;                        ///< likewise
    KernelQuestion kernel;                       ///< its matrix is R J
    bool is_everywhere = false;                  ///< R J has lost rank at every value of the joints
    std::shared_ptr<const OutputMotion> motion;  ///< of the joints of R J
  };
  /// Nothing where an inequality is reached.
  std::optional<Question> question(const BoundaryPart& part, const Ended& ended = {}) const;

 private:
  ArmBoundary(Mechanism joints, FreeCoordinates free, KernelQuestion kernel, OutputMotion motion)
      : joints_(std::move(joints)), free_(std::move(free)), kernel_(std::move(kernel)), motion_(std::move(motion)) {}

  Mechanism joints_;
  FreeCoordinates free_;
  KernelQuestion kernel_;
  OutputMotion motion_;
};

/// Makes a part one about the joints that its condition or block, if it has one, and these functions are about. False where
/// they are about other coordinates, too.
bool put_in_factor(const FreeCoordinates& free, std::vector<Expression> functions, Component& part);

/// What a part's passages are about. Without the slacks where it has a kernel vector, whose degenerate solutions would be
/// as many more.
std::vector<Expression> passage_functions(const OutputMotion& motion, const Component& part);

/// passage_form() of such a part, with Φ = u − f(q). Without a normal where the frame turns by joints that `system` does not
/// have, without slacks where these are about such joints; nothing where other entries are.
std::optional<PassageForm> passage_form_in_joints(const BoundaryPart& part, const TrigonometricSystem& system,
                                                  const System& compiled);

}  // namespace corank::symbolic
