// Where a wide matrix of an arm loses the rank of its rows, in values of the joints: "q4 = 0", or "q2 = 0, q6 = 0".
//
// Theorem (doc/theory.md, "Parts of a set", 5): M has not the rank of its rows exactly where all minors of as many columns
// vanish, and each does where one of its factors does. A factor in the sine and the cosine of one joint vanishes at
// angles of this joint. Factors that all minors have are parts of the set by themselves; the others vanish where, of some
// minor, one does: at an angle at which the rest is asked again, with the joint held.
#pragma once

#include <vector>

#include "corank/symbolic/sets/decomposition.h"
#include "corank/symbolic/sets/free_coordinates.h"

namespace corank::symbolic {

/// Each by values of joints and by conditions in place of a kernel vector, a product with the ranges of the other joints.
/// Nothing where that would be many conditions on few joints: a kernel vector has as many equations as it needs.
/// `matrix`: in joints.
std::vector<Component> rank_losses(const Mechanism& mechanism, const ExpressionMatrix& matrix, const FreeCoordinates& free,
                                   const Ended& ended = {});

}  // namespace corank::symbolic
