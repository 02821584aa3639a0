// The passes of a search: all boxes are searched until they are empty, proven or postponed; those postponed next to
// degenerate solutions are judged together, divided further in the next pass, or given up; then all sheets are cut to σ.
// Whoever runs the parts of a pass, here or elsewhere, in whatever order: the cover is the same.
#pragma once

#include <vector>

#include "corank/solve/search/pool.h"
#include "corank/solve/step/options.h"
#include "corank/solve/store/degeneracy.h"
#include "corank/solve/store/shard.h"

namespace corank::solve {

/// All that is to be searched, within the domain.
Work first_pass(const Prepared& prepared);
/// These boxes, in all variables, within the domain.
Work pass_over(const certify::Reduction& reduction, const std::vector<Box>& boxes);

/// What is to be searched further of the boxes that a pass has postponed, each once; the others are proven, or given up, in
/// the pool's shards. Empty: the search is done.
Work next_pass(const Prepared& prepared, const Work& pass, std::vector<Postponed> postponed, Pool& pool,
               SelfMotions& motions);

/// The σ that is asked for, by default from the hull of a set.
Sigma chosen_sigma(const Options& options, const System& system, const Box& hull, int dimension);
/// σ for the search: what the tolerance of coefficients moves is no reason for narrower boxes, and such systems are searched
/// by σ. Infinite where boxes with parts of sheets are not to be cut.
Sigma sigma_of_search(const Prepared& prepared, const Problem& problem);
/// σ for the set that the shards' sheets make.
Sigma sigma_of_set(const Prepared& prepared, const Problem& problem, const std::vector<Shard*>& shards);

}  // namespace corank::solve
