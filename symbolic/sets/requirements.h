// What a mechanism's requirements (requirement_text.h) ask of a configuration, as conditions on its feasible velocities m,
// L m = 0 (velocity_equation.h). The work of motors and loads together is 0 in each of them. So
//   amplification(outputs) ≤ k            k² ‖m_inputs‖² − ‖m_outputs‖² > 0 on ker L, in the metric's units;
//   torque(u) ≤ t under ‖f_g‖ ≤ F_g       with the other inputs locked, τ_u m_u + Σ_g f_g·m_g = 0: the largest |τ_u| is
//                                         Σ_g F_g ‖m_g‖ / |m_u|, m the feasible velocity;
//   a load with one value F on a rate     adds F times that rate to the work: its own component z = Σ F m_k, |z| beside Σ
//   tension(d…) in [a, b]                 doc/theory.md: for each n − 1 of the cables locked, n the mobility,
//                                         Σ_g F_g ‖m_g‖ + |Σ F m_k − (a + b)/2 Σ m_d| < (b − a)/2 Σ |m_d|
//   error(x) ≤ e under |δ_i| ≤ d_i        to first order x moves by ‖m_x‖ / |λ|, where m_i = ±d_i λ: largest at a corner of
//                                         the box of input errors, since a norm is convex.
#pragma once

#include <string>
#include <vector>

#include "corank/core/requirement.h"
#include "corank/core/system.h"
#include "corank/symbolic/model/mechanism.h"
#include "corank/symbolic/sets/requirement_conditions.h"
#include "corank/symbolic/sets/requirement_part.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

class Requirements {
 public:
  /// Of the mechanism. `parameters`: constants that have no value, on which no limit may depend. Throws ModelError for a
  /// name that is none of a rate, a unit of another dimension, a limit that is not positive, or a metric that is missing
  /// where lengths and angles are compared.
  explicit Requirements(const Mechanism& mechanism, const std::vector<std::string>& parameters = {});

  /// The functions of coordinates that they hold, and they themselves, their variables as indices into those.
  std::vector<Expression> functions() const;
  const std::vector<Requirement>& of_functions() const { return requirements_; }

  /// Adds a coordinate for each function of coordinates that a requirement holds, auxiliary, and the equation that gives it.
  void add_to(TrigonometricSystem& system) const;
  /// After that: in the variables of the algebrized system.
  std::vector<Requirement> in(const System& system) const;

 private:
  struct Function {
    std::string name;  ///< of its coordinate
    Expression value;
    std::string source;
  };
  int function(const Mechanism& mechanism, const Expression& value, const std::string& source);
  MatrixEntry entry(const Mechanism& mechanism, const Expression& value, const std::string& source);

  std::vector<Function> functions_;
  std::vector<Requirement> requirements_;
};

/// The same with its requirements of distances alone, or with all others.
Mechanism with_distances_alone(Mechanism mechanism);
Mechanism without_distances(Mechanism mechanism);

/// What requirements of distances keep, in the variables of algebrize(space), a system of the mechanism's.
KeptDistances kept_distances(const Mechanism& mechanism, const TrigonometricSystem& space);

/// A mechanism with the same configurations and a velocity equation of its own, whose forward singularities are the
/// configurations at which a requirement reaches its limit. Its matrix without inputs is square, a block for each condition:
///   form on ker A           [diag(form), Aᵀ; A, 0]
///   a load on a motor       the same with form = bound² for the motor, −weight² for each component of the load
///   f ≤ g                   [f − g]
/// Theorem: where A has full row rank, the block has the kernel vector (m, λ) ≠ 0 iff m ∈ ker A and diag(form)·m ⊥ ker A,
/// m ≠ 0: the form on ker A is degenerate. A form that is positive definite at one end of a path and not at the other is
/// degenerate on the way, or A loses rank there, and then the block is singular, too. So on every path that meets no such
/// configuration a requirement that is met once is met all along.
/// Throws ModelError as Requirements does, where there is none, and for a motor under several loads.
Mechanism at_requirements(const Mechanism& mechanism);

/// What is asked at a requirement's limit of the rates m of `mechanism`, its companion: that they are a kernel vector, as in
/// at_requirements(); of an effort or an error in place of that
///   A m = 0, ‖m‖ = 1, Σ_g weight_g r_g = bound m_last, r_g = ‖m_g‖.
/// No multipliers, and any number of loads: ker A is a line but at configurations that are singular.
/// Theorem: a path on which the requirement is met at first, and not all along, meets such a configuration. Proof: at the
/// end q of the first piece on which it is met, unit vectors of ker A converge, so there is an m of ker A(q) with ≤ in place
/// of =. If ker A(q) is a line, then = holds, or the requirement was met at q and beyond. Else ker A(q) has a vector with
/// m_last = 0, so with ≥, and the unit vectors of ker A(q) hang together. ∎
struct LimitCompanion {
  Mechanism mechanism;
  std::optional<VelocityCondition> on_a_line;  ///< with groups
};
LimitCompanion at_limit(const Mechanism& mechanism, const RequirementPart& part);

}  // namespace corank::symbolic
