// From a mechanism to the equations of its singularities, in trigonometric form: Φ(q) = 0 and the kernel of a block of the
// velocity equation (velocity_equation.h); which block, a set's definition says (set_definition.h).
//
// Definitions and kernel equations: Bohigas, Manubens, Ros, "Singularities of Robot Mechanisms", 2017 (key Bohigas2017), §§
// 2–3.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/symbolic/algebra/dependent_angle.h"
#include "corank/symbolic/model/mechanism.h"
#include "corank/symbolic/velocity/passive_rates.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::symbolic {

struct LimitCompanion;
struct RequirementPart;

/// Equations with sines and cosines over coordinates, then kernel unknowns.
struct TrigonometricSystem {
  std::string name;  ///< "dextar forward"
  std::vector<Constant> constants;
  std::vector<Coordinate> coordinates;  ///< q
  /// Of a part in fewer coordinates those of the whole, so that variables have the same names; else none.
  std::vector<Coordinate> coordinates_of_whole{};
  /// xi1 … (renamed where the model uses the name), each in [−1, 1]. Of corank c ≥ 2 those of ξ¹, xi1_1 …, then those of ξ²,
  /// xi2_1 …
  std::vector<std::string> kernel_unknowns;
  /// eta1 …, of the second kernel where a set asks for two: auxiliary variables.
  std::vector<std::string> second_unknowns{};
  std::vector<std::string> kernel_scales;  ///< as given to singularity_system
  int corank = 1;                          ///< likewise: the number of kernel vectors
  bool passive_rates_eliminated = false;   ///< KernelQuestion::passive has some
  struct Unknown {
    std::string name;
    int lower = -1, upper = 1;
  };
  /// Of cusps and nodes, in place of kernel unknowns; of a limit on a line (LimitCompanion) the r_g, beside them.
  std::vector<Unknown> further_unknowns;
  std::optional<DependentAngle> dependent_angle{};  ///< of angles that have more than one value
  struct Equation {
    Relation relation;
    std::string source;  ///< "dextar.cuik:17", "row 3 of L_y xi = 0", "norm of xi" …
    SourceLocation where;
    bool of_kernel = false;           ///< about ξ, not q alone
    bool is_dependent_angle = false;  ///< what `dependent_angle` says, in words
  };
  std::vector<Equation> equations;     ///< all with =
  std::vector<Equation> inequalities;  ///< ≤ or ≥
  std::vector<Equation> claimed;       ///< that the model says to follow from its equations
};

/// Are these the same configurations, in the same words: constants, coordinates, equations and inequalities?
bool are_alike(const TrigonometricSystem& a, const TrigonometricSystem& b);

/// What the kernel of a set is asked of, checked: that inputs and outputs are there and fit the mobility.
struct KernelQuestion {
  const SetDefinition& set;
  std::string name;                   ///< of M: "L_y"; of all of L "Phi_q", or "L" where the mechanism brings its own
  ExpressionMatrix matrix;            ///< M: L without the locked columns and the dropped rows
  std::vector<SourceLocation> where;  ///< of its rows
  KernelSide side;
  std::vector<std::size_t> dropped;    ///< of a left kernel: the rows of L that are not in M
  PassiveRates passive{};              ///< of M, where they are eliminated
  std::vector<KernelQuestion> also{};  ///< one more, where the set asks for two kernels
  /// Of a set of requirements' limits: whose rates the kernel vector is (requirements.h).
  std::shared_ptr<const LimitCompanion> at_limit{};

  /// Leaves rows out of M, those of dependencies.
  void drop(const std::vector<std::size_t>& rows);
};

/// Of a set that has a kernel, or of a locus whose cusps or nodes it is. Throws ModelError as singularity_system does.
KernelQuestion kernel_question(const Mechanism& mechanism, SingularitySet set,
                               std::optional<KernelSide> side = std::nullopt);

/// Of one part of the limits of requirements.
KernelQuestion kernel_question(const Mechanism& mechanism, const RequirementPart& part);

/// The same question with the passive rates eliminated, where it is about a right kernel and has such.
KernelQuestion without_passive_rates(const Mechanism& mechanism, KernelQuestion kernel);

/// The system of a set: Φ(q) = 0 and, for all but cspace, the kernel equations, ‖ξ‖² = 1 and a·ξ ≥ 0 with a fixed generic a
/// that drops −ξ; the same of eta where the set has a second kernel. Default kernel: that of the set's definition where the
/// matrix is square, right where it is tall (a redundantly actuated mechanism's L_y, L_p), left where it is wide (a
/// kinematically redundant one's L_z, Φ_q). The other side of a matrix that is not square has a kernel everywhere.
/// L_y and L_z are taken without the zero rows of dependencies (VelocityEquation): ker L_z is the same without them, at
/// every configuration, and what is left is square where the outputs less their dependencies are as many as the mobility
/// (doc/theory.md, "Outputs and inputs with dependencies"). `scales`: of each kernel unknown, the number by which its column
/// is multiplied (symbolic/sets/kernel_scale.h), a rational number's text; none: all are 1.
/// `corank` c: the configurations where M's kernel K has dimension c at least. The system asks for c orthonormal kernel
/// vectors ξ¹ … ξᶜ with
///   a_i·ξʲ = 0 for i < j,   a_j·ξʲ ≥ 0,
/// where a_1 … a_c are fixed generic vectors (a_1 = a). Every K of dimension ≥ c holds such vectors: choose ξᶜ, then ξᶜ⁻¹ …,
/// in a c-dimensional part of K, each by c − 1 linear conditions. So no configuration is lost, and the q of a solution has
/// corank ≥ c. Where dim K = c the vectors are unique but for the sign where a_j·ξʲ = 0, unless the projections of a_1 …
/// a_(c−1) on K are dependent (for c = 2: K ⊥ a_1, two conditions on K): there, and where dim K > c, they are a continuum
/// over one q. With a square M these are c² equations more than there are components of the vectors: the set's expected
/// dimension is that of C-space less c². Where that is below 0 the system is over-determined.
/// Throws ModelError where inputs or outputs are missing, there are, less their dependencies, fewer inputs or more outputs
/// than the mobility, the columns of L less its rows, a kernel is asked for that there is everywhere, or a corank that is
/// not in 1 … the number of the kernel's unknowns (1 for cspace, which has none).
TrigonometricSystem singularity_system(const Mechanism& mechanism, SingularitySet set,
                                       std::optional<KernelSide> side = std::nullopt,
                                       const std::vector<std::string>& scales = {}, int corank = 1);
/// The same of a kernel_question().
TrigonometricSystem singularity_system(const Mechanism& mechanism, const KernelQuestion& kernel,
                                       const std::vector<std::string>& scales, int corank);
/// The same with these equations of the configuration in place of Φ(q) = 0.
TrigonometricSystem with_kernel(TrigonometricSystem equations, const Mechanism& mechanism, const KernelQuestion& kernel,
                                const std::vector<std::string>& scales, int corank = 1);

/// The equations and inequalities of the model itself, nothing added (a plain system, or C-space).
TrigonometricSystem plain_system(const Mechanism& mechanism);

}  // namespace corank::symbolic
