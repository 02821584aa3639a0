// Where the image of a singularity locus among the locked coordinates has a cusp.
//
// M = Φ_y, the derivative of the constraints by the coordinates y that are not locked, is square. A configuration
// where it has a kernel vector ξ lies over a cusp where the mechanism, its locked coordinates w held, can move to
// second order: where some acceleration η solves
//   M ξ = 0,  M η + D²Φ(ξ, ξ) = 0,  D²Φ(ξ, ξ) the second derivative of Φ along ξ.
// That is λᵀ D²Φ(ξ, ξ) = 0 for every λ with Mᵀ λ = 0. The system asks for (η, τ) of length 1 instead:
//   Φ = 0,  M ξ = 0,  ‖ξ‖ = 1,  M η + τ D²Φ(ξ, ξ) = 0,  ξ·η = 0,  ‖η‖² + τ² = 1,  τ ≥ 0,  a·ξ ≥ 0.
// Every cusp is in it, η and τ are unique up to the sign where τ = 0, and it has n_q + 2 n_e + 1 unknowns and 3
// n_e + 3 equations: its dimension is the mobility less 2. A solution where its Jacobian has full rank lies over a
// cusp of Whitney's (doc/theory.md, "Cusps and nodes").
//
// Where the image of a singularity locus among the locked coordinates crosses itself: two singular configurations with the
// same locked coordinates.
//
// With w locked and y the other coordinates, q = (w, y), q′ = (w, y′), M = Φ_y:
//   Φ(w, y) = 0,  Φ(w, y′) = 0,  M(q) ξ = 0,  M(q′) ξ′ = 0,  ‖ξ‖ = ‖ξ′‖ = 1,  a·ξ ≥ 0,  a·ξ′ ≥ 0;
// as many equations as unknowns less the mobility and 2. The whole locus solves it with y = y′; so pairs are asked for whose
// distance is
//   ‖y − y′‖ ≥ δ = 1/20,
// where a length counts in its typical size (half of its range as the constraints leave it) and an angle by its sine and
// cosine. *Closer pairs are not looked for.* Of (q, q′) and (q′, q) the one with b·(y − y′) ≥ 0 stays, b fixed and generic.
#pragma once

#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// Of the set forward_cusps or inverse_cusps. Its unknowns: xi1 …, eta1 …, tau. `scales`: none, or s_j of each column of M
/// and of ξ_j, η_j; then the factor of D²Φ, which makes η and τ alike in size in every unit (kernel_scale.h). Throws
/// ModelError where the locus has no square matrix, or the mobility is below 2: its image among the locked coordinates is
/// then no hypersurface that could have a cusp or cross itself. So do the other functions.
TrigonometricSystem cusp_system(const Mechanism& mechanism, SingularitySet set, const std::vector<std::string>& scales);

/// On which side of the locus the fibre through a cusp lies: of each function g of the coordinates that is 0 on the
/// locus, and nowhere else nearby, Dg(η) + τ D²g(ξ, ξ) in the unknowns of cusp_system(). Theorem: where that is not 0,
/// its sign is that of g at the two outer of the three configurations that come together there (doc/theory.md, "Cusps
/// and nodes", 5).
std::vector<Expression> cusp_sides(const Mechanism& mechanism, SingularitySet set, const std::vector<std::string>& scales,
                                   const std::vector<Expression>& functions);

/// δ, as the model language writes it.
inline constexpr const char* kNodeDistance = "1/20";

/// What y′'s coordinates are called behind those of y: "x_2", or more underscores where that is taken.
std::string second_name(const Mechanism& mechanism, const std::string& coordinate);

/// Of the set forward_nodes or inverse_nodes. Its coordinates: those of the mechanism, then y′; its unknowns: xi1_1 … and
/// xi2_1 … `scales`: none, or s_j of each column of M and of ξ_j, ξ′_j; then the number by which that is a length's typical
/// size (kernel_scale.h).
TrigonometricSystem node_system(const Mechanism& mechanism, SingularitySet set, const std::vector<std::string>& scales);

/// Is a locus empty for a plain reason, so that nobody need be asked which one is meant? A serial arm whose inputs are all
/// of its joints has no forward singularities, whatever its lengths.
///
/// Proven: M of this set (forward, inverse, their cusps or nodes) is regular in the whole search domain, since its rows and
/// columns can be put in an order in which it is triangular, with a diagonal that is 0 nowhere. False says nothing.
/// Throws ModelError as kernel_question does.
bool is_regular_everywhere(const Mechanism& mechanism, SingularitySet set);

/// The set `nodes`: those of the locus that is not empty for that reason. Throws ModelError where both may have nodes, or
/// neither can.
SingularitySet nodes_of(const Mechanism& mechanism);

}  // namespace corank::symbolic
