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

#include "corank/symbolic/singularity_system.h"

namespace corank::symbolic {

/// δ, as the model language writes it.
inline constexpr const char* kNodeDistance = "1/20";

/// What y′'s coordinates are called behind those of y: "x_2", or more underscores where that is taken.
std::string second_name(const Mechanism& mechanism, const std::string& coordinate);

/// Of the set forward_nodes or inverse_nodes. Its coordinates: those of the mechanism, then y′; its unknowns: xi1_1 … and
/// xi2_1 … `scales`: s_j of each column of M and of ξ_j, ξ′_j; then the number by which that is a length's typical size
/// (kernel_scale.h). Throws ModelError where locus_by_coordinates does.
TrigonometricSystem node_system(const Mechanism& mechanism, SingularitySet set, const std::vector<std::string>& scales);

}  // namespace corank::symbolic
