// Names of a set's parts for people. A robot's equations have constants of corank's own, "k1", where a dimension would take
// a long text, and whole numbers of many digits where its dimensions are decimals. Nobody has written these, so a name has
// rounded numbers in place of them: "2*k1*cos(psi) - sin(psi) = 0" is called "1.73205*cos(psi) - sin(psi) = 0". The
// condition itself is exact.
#pragma once

#include <vector>

#include "corank/symbolic/sets/decomposition.h"

namespace corank::symbolic {

/// A k with a number, whose value is no rational number: corank names no others. An author's constant may be such a one.
bool is_of_corank(const Constant& constant);

/// Puts rounded values into the names of the parts, as long as no two have the same; Component::former_name keeps the other.
void name_by_values(const Mechanism& mechanism, std::vector<Component>& parts);

}  // namespace corank::symbolic
