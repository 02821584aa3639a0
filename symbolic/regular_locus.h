// Is a locus empty for a plain reason, so that nobody need be asked which one is meant? A serial arm whose inputs are all of
// its joints has no forward singularities, whatever its lengths.
#pragma once

#include "corank/symbolic/mechanism.h"

namespace corank::symbolic {

/// Proven: M of this set (forward, inverse, their cusps or nodes) is regular in the whole search domain, since its rows and
/// columns can be put in an order in which it is triangular, with a diagonal that is 0 nowhere. False says nothing.
/// Throws ModelError as kernel_question does.
bool is_regular_everywhere(const Mechanism& mechanism, SingularitySet set);

/// The set `nodes`: those of the locus that is not empty for that reason. Throws ModelError where both may have nodes, or
/// neither can.
SingularitySet nodes_of(const Mechanism& mechanism);

}  // namespace corank::symbolic
