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
#pragma once

#include "corank/symbolic/singularity_system.h"

namespace corank::symbolic {

/// Of the set forward_cusps or inverse_cusps. Its unknowns: xi1 …, eta1 …, tau. `scales`: s_j of each column of M
/// and of ξ_j, η_j; then the factor of D²Φ, which makes η and τ alike in size in every unit (kernel_scale.h).
/// Throws ModelError where locus_by_coordinates does.
TrigonometricSystem cusp_system(const Mechanism& mechanism, SingularitySet set, const std::vector<std::string>& scales);

/// On which side of the locus the fibre through a cusp lies: of each function g of the coordinates that is 0 on the
/// locus, and nowhere else nearby, Dg(η) + τ D²g(ξ, ξ) in the unknowns of cusp_system(). Theorem: where that is not 0,
/// its sign is that of g at the two outer of the three configurations that come together there (doc/theory.md, "Cusps
/// and nodes", 5).
std::vector<Expression> cusp_sides(const Mechanism& mechanism, SingularitySet set, const std::vector<std::string>& scales,
                                   const std::vector<Expression>& functions);

}  // namespace corank::symbolic
