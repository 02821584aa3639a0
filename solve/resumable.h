// Searches that keep their state as they go, and searches that go on from one.
#pragma once

#include <optional>

#include "corank/solve/journal.h"
#include "corank/solve/solve.h"

namespace corank::solve {

/// solve::solve with a journal, where one is given, and from a state on, which is of a search of the same system with the
/// same options but for limits and threads; a state in which nothing is cut yet may have had another σ (refinable()).
Cover solve_on(const Prepared& prepared, Control& control, Journal* journal, std::optional<SearchState> from = {});

/// Is the search the same whatever σ, so that its sheets can be cut anew? It is not where coefficients carry a tolerance.
bool refinable(const Prepared& prepared);

}  // namespace corank::solve
