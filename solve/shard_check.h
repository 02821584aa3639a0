// Do the values that were read fit the system that they are said to be of?
#pragma once

#include "corank/solve/journal.h"
#include "corank/solve/prepared.h"
#include "corank/solve/shard_bytes.h"

namespace corank::solve {

/// Throw ShardError where a box has another number of sides, or an index names nothing.
void check(const Work& work, const Prepared& prepared);
void check(const Shard& shard, const Prepared& prepared);
void check(const Received::Part& part, const Prepared& prepared);
void check(const Unit& unit, const Prepared& prepared);
void check(const SearchState& state, const Prepared& prepared);

}  // namespace corank::solve
