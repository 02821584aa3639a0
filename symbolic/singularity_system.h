// From a mechanism to the equations of its singularities, in trigonometric form: GiNaC differentiates Φ with respect to q,
// so that an angle has one column, and picks out the blocks of the velocity equation L m = 0, here with L = Φ_q.
//
//   L_y = L without the input columns     (forward singularity: Φ = 0 and L_y rank deficient)
//   L_z = L without the output columns    (inverse singularity: Φ = 0 and L_z rank deficient)
//   L_p = the passive columns alone
//   C-space singularity: Φ = 0 and Φ_q rank deficient
//
// Definitions and kernel equations: Bohigas, Manubens, Ros, "Singularities of Robot Mechanisms", 2017 (key Bohigas2017), §§
// 2–3.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/symbolic/mechanism.h"

namespace corank::symbolic {

/// Row-major matrix of expressions.
struct ExpressionMatrix {
  std::vector<std::string> columns;  ///< the coordinate of each column
  std::vector<std::vector<Expression>> rows;
};

/// Φ and its Jacobian blocks, shapes n_e × n_q, n_e × (n_q − n_v), n_e × (n_q − n_u), n_e × n_p.
struct Derivation {
  std::vector<Expression> phi;  ///< lhs − rhs of each equation
  ExpressionMatrix phi_q, l_y, l_z, l_p;
  /// Equations in inputs (outputs) and constants alone, such as a unit vector's norm: their rows of L_y (L_z) are zero. They
  /// leave the kernel as it is, and so many inputs (outputs) more than the mobility may be named.
  std::vector<std::size_t> input_ties, output_ties;
};

/// Throws ModelError where the mechanism is not valid (Mechanism::validate).
Derivation derive(const Mechanism& mechanism);

enum class SingularitySet { cspace, forward, inverse, cspace_singular };
enum class KernelSide { right, left };  ///< M ξ = 0 or Mᵀ ξ = 0

const char* to_string(SingularitySet set);  ///< "cspace", "forward", "inverse", "cspace-singular"
const char* to_string(KernelSide side);
/// Nothing for another word.
std::optional<SingularitySet> singularity_set_from_string(const std::string& text);
std::optional<KernelSide> kernel_side_from_string(const std::string& text);

/// Equations with sines and cosines over coordinates, then kernel unknowns.
struct TrigonometricSystem {
  std::string name;  ///< "dextar forward"
  std::vector<Constant> constants;
  std::vector<Coordinate> coordinates;  ///< q
  /// xi1 … (renamed where the model uses the name), each in [−1, 1]. Of corank c ≥ 2 those of ξ¹, xi1_1 …, then those of ξ²,
  /// xi2_1 …
  std::vector<std::string> kernel_unknowns;
  std::vector<std::string> kernel_scales;  ///< as given to singularity_system
  int corank = 1;                          ///< likewise: the number of kernel vectors
  struct Equation {
    Relation relation;
    std::string source;  ///< "dextar.cuik:17", "row 3 of L_y xi = 0", "norm of xi" …
    SourceLocation where;
  };
  std::vector<Equation> equations;     ///< all with =
  std::vector<Equation> inequalities;  ///< ≤ or ≥
};

/// The system of a set: Φ(q) = 0 and, for all but cspace, the kernel equations, ‖ξ‖² = 1 and a·ξ ≥ 0 with a fixed generic a
/// that drops −ξ. Default kernel: right where the matrix is square (forward, inverse), left for Φ_q (cspace-singular).
/// L_y and L_z are taken without the zero rows of ties (Derivation): ker L_z is the same without them, at every
/// configuration, and what is left is square where the outputs less their ties are as many as the mobility (doc/theory.md,
/// "Tied outputs and inputs"). `scales`: of each kernel unknown, the number by which its column is multiplied
/// (symbolic/kernel_scale.h), a rational number's text; none: all are 1.
/// `corank` c: the configurations where M's kernel K has dimension c at least. The system asks for c orthonormal kernel
/// vectors ξ¹ … ξᶜ with
///   a_i·ξʲ = 0 for i < j,   a_j·ξʲ ≥ 0,
/// where a_1 … a_c are fixed generic vectors (a_1 = a). Every K of dimension ≥ c holds such vectors: choose ξᶜ, then ξᶜ⁻¹ …,
/// in a c-dimensional part of K, each by c − 1 linear conditions. So no configuration is lost, and the q of a solution has
/// corank ≥ c. Where dim K = c the vectors are unique but for the sign where a_j·ξʲ = 0, unless the projections of a_1 …
/// a_(c−1) on K are dependent (for c = 2: K ⊥ a_1, two conditions on K): there, and where dim K > c, they are a continuum
/// over one q. With a square M these are c² equations more than there are components of the vectors: the set's expected
/// dimension is that of C-space less c². Where that is below 0 the system is over-determined.
/// Throws ModelError where inputs or outputs are missing or, less their ties, do not match the mobility n_q − n_e (a
/// redundant mechanism, non-square L_y or L_z), a right kernel is asked of the wide Φ_q, or a corank that is not in 1 … the
/// number of the kernel's unknowns (1 for cspace, which has none).
TrigonometricSystem singularity_system(const Mechanism& mechanism, SingularitySet set,
                                       std::optional<KernelSide> side = std::nullopt,
                                       const std::vector<std::string>& scales = {}, int corank = 1);

/// "forward singularities of corank 2"; "forward" where the corank is 1.
std::string set_with_corank(const std::string& set, int corank);

/// The equations and inequalities of the model itself, nothing added (a plain system, or C-space).
TrigonometricSystem plain_system(const Mechanism& mechanism);

}  // namespace corank::symbolic
