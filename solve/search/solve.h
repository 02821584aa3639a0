// Branch and prune: encloses every solution of a system in boxes and asks certify/ for a proof of each.
#pragma once

#include "corank/core/cover.h"
#include "corank/core/system.h"
#include "corank/solve/step/control.h"
#include "corank/solve/step/options.h"

namespace corank::solve {

/// The coefficient tolerance (System::coefficient_tolerance) to take for a system as somebody printed it: 1e-6 where it has
/// more equations than variables, since rounded decimals make redundant equations inconsistent; else 0, exact. Not for
/// systems that symbolic/ derives from a mechanism: their redundancy is exact.
double printed_tolerance(const System& system);

/// The cover of the system's solution set in its domain. Never throws for a mathematical outcome; throws as prepare() does.
/// The result does not depend on the number of threads unless a limit or a stop ends the search.
Cover solve(const System& system, const Options& options = {});

/// The same under a control, whose limits take the place of the options'. `most`: ends this search, not the run, after so
/// many processed boxes; 0: no limit.
Cover solve(const Prepared& prepared, Control& control, std::uint64_t most = 0);

}  // namespace corank::solve
