// Components of unit vectors among the coordinates that the equations give: of links' directions in an arm. Their ranges,
// a little wider than [-1, 1], are no ends of its motions.
#pragma once

#include <set>
#include <string>

#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

/// Of the auxiliary coordinates name_x, name_y, … those whose squares' sum is shown to be 1 at every solution of Φ, as a
/// polynomial: by what Φ gives explicitly (ExactMatrix::in_free_coordinates), and by products of the vectors that others are
/// sums and cross products of.
std::set<std::string> unit_vector_components(const Mechanism& mechanism);

}  // namespace corank::symbolic
