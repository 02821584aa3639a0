// The boundary of a mechanism's workspace in the space of its outputs u, as parts: which limited coordinates are at which
// limit, and which inequalities are reached. Every boundary of the workspace, interior or exterior, is the image of a point
// of some part.
//
// With Φ(q) = 0, mobility n = n_q − n_e, n_u ≤ n outputs, z all other coordinates and A a set of limited coordinates of
// z, each at one of its limits (where n_u ≤ n without the passive ones that have one value, q is without
// them, and Φ without the equations in these alone):
//   part A:          Φ(q) = 0,  q_i = limit (i ∈ A),  λᵀ Φ_{z_j} = 0 (z_j ∉ A),  ‖λ‖ = 1,  all limits hold
//   part of a limited output u_i:   Φ(q) = 0,  u_i = limit,  all limits hold
// An inequality g(q) ≥ 0 is a limit, too, of a coordinate s = g(q): in the parts that reach it, g = 0 is one more row of Φ.
// One about outputs alone makes a part as a limited output does.
// Theorem (doc/theory.md, "Workspace boundaries"): the configurations from which the output cannot move, to first order and
// with the coordinates at their limits kept there, in some direction are those of the parts with |A| ≤ n − n_u + 1 and of
// the limited outputs. A part A has the expected dimension n_u − 1. Idle coordinates (idle_coordinates.h) are left out
// before; their ranges are factors of each part.
//
// Generalized singularities: Bohigas, Manubens, Ros, "Singularities of Robot Mechanisms", 2017 (key Bohigas2017), whose
// sin τ in place of a limited coordinate gives the same configurations, each several times.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/core/system.h"
#include "corank/symbolic/sets/decomposition.h"
#include "corank/symbolic/sets/idle_coordinates.h"
#include "corank/symbolic/sets/limits.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// Of an arm whose joints q give its outputs, u = f(q), what decides about a part's passages, in a frame R(q) in which it is
/// short. One row for each output.
struct OutputMotion {
  /// R ∂f/∂q_j of the joints that are free, of those at their limits, R ∂²f/∂q_j∂q_k of the free ones for k ≥ j, and R.
  ExpressionMatrix entries;
  std::size_t free = 0, active = 0;  ///< how many joints these are
  std::vector<std::string> sizes;    ///< of the free ones, as coordinate_sizes()
};

struct BoundaryPart {
  struct Active {
    std::string name;  ///< of the coordinate, or what the inequality is about
    Expression value;  ///< the limit that the coordinate is at
    bool upper = false;
    std::optional<Relation> inequality{};  ///< that is reached, in place of a coordinate's limit
  };
  std::vector<Active> active;
  bool of_output = false;       ///< `active` is one output, at its limit, or an inequality about outputs alone
  bool has_multipliers = true;  ///< λ is a part of its system (set_parts.h)
  IdleCoordinates idle{};  ///< that its system is without: the set is the product with the ranges of those that are free
  /// In place of λᵀ Φ_{z_j} = 0, where these say that a square matrix is singular, and that is a union. Or, without a name
  /// and a condition, the joints of an arm in which a part without λ is a product.
  std::optional<Component> component{};
  std::shared_ptr<const OutputMotion> motion{};  ///< of an arm's part in joints (arm_boundary.h)

  /// "no limit", "theta2 at its upper limit, range of elbow reached", "no limit: sin(theta2) = 0".
  std::string text() const;
};

/// Without limits first, then by |A|, then those of outputs. Throws ModelError where the model names no outputs, has
/// more of them than its mobility, or there are more than 1000 parts.
std::vector<BoundaryPart> boundary_parts(const Mechanism& mechanism);

/// Whose configurations a part's are: without a velocity equation of its own and without idle coordinates, and with the
/// inequalities that are reached as its last equations.
Mechanism mechanism_of(const Mechanism& mechanism, const BoundaryPart& part);

/// What the kernel vector λ of a part that is not of an output is asked of. Rows of Φ_z that are 0 (dependencies of the
/// outputs) have none. A mechanism's own velocity equation has no say.
KernelQuestion boundary_kernel(const Mechanism& mechanism, const BoundaryPart& part);

/// What decides about the passage, over compiled = algebrize(system), where `system` is the part's. Nothing where outputs
/// have dependencies, the equations hold sines of lengths, or they lack coordinates of the robot.
std::optional<PassageForm> passage_form(const Mechanism& mechanism, const BoundaryPart& part,
                                        const TrigonometricSystem& system, const System& compiled);

/// The configurations of a mechanism, without what is no coordinate or its sine or cosine: what boxes of all parts have
/// in common.
System configurations(const Mechanism& mechanism);

}  // namespace corank::symbolic
