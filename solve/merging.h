// Fewer boxes for the same set: pieces of neighbouring sheets that fit into one box of size σ.
#pragma once

#include <vector>

#include "corank/core/ended.h"
#include "corank/solve/preconditioner.h"
#include "corank/solve/problem.h"

namespace corank::solve {

/// Replaces pairs of touching regular boxes over the same free variables by one, again and again, where their hull can be
/// proven as any box is (certify::newton_prove) and is no wider than σ. The proof's image holds every zero of the hull, so
/// nothing is lost. The result depends on the boxes and their order only; once `ended` is true the other boxes stay as they
/// are.
void merge_regular(const Problem& problem, std::vector<Found*>& found, const Ended& ended = {});

}  // namespace corank::solve
