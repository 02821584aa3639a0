// From the shards of a search to its cover.
#pragma once

#include <vector>

#include "corank/certify/reduction.h"
#include "corank/solve/step/options.h"
#include "corank/solve/step/problem.h"
#include "corank/solve/store/degeneracy.h"
#include "corank/solve/store/shard.h"

namespace corank::solve {

/// The cover that the shards hold together, in an order that does not depend on who has made which: boxes are merged where
/// the problem's σ allows, distinct solutions told apart, the script put together from the first pass on. To be called in
/// the arena whose threads it may use; the found boxes are taken out.
Cover assemble(const Prepared& prepared, const Problem& problem, const std::vector<Shard*>& shards, const Work& first_pass,
               const SelfMotions& motions, const Sigma& sigma, Control& control);

}  // namespace corank::solve
