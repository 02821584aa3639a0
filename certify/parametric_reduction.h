// certify/reduction.h for a question that is asked for every value of some variables, the parameters.
#pragma once

#include "corank/certify/reduction.h"

namespace corank::certify {

/// Like reduce(system, Eliminate::exact), but the parameters are kept, and their domains as they are: what a variable that
/// is eliminated says about a parameter becomes an inequality. So for *every* value of the parameters x' ↦ (x', p(x')) is a
/// bijection from the reduced system's solutions to the system's (the proof of reduction.h, read for fixed parameters), and
/// both have as many. A range of the parameters may be put in their places in both.
Reduction reduce_with_parameters(const System& system, const std::vector<int>& parameters, const Ended& ended = {});

}  // namespace corank::certify
