// From a mechanism's set to its result: what corank solve and corank report share.
#pragma once

#include <optional>

#include "corank/app/question.h"
#include "corank/solve/solve.h"

namespace corank::app {

/// Solves the system of a set (nothing: of a plain system), proves exactly what can be, and returns all that a result file
/// holds. `control`, made of the options' limits, ends it; what was not done by then is pending or undecided, and
/// Result::stopped says so. `kernel_scales`: with which the system was made. `digits`: isolated points get so many proven digits after the
/// point; 0: none.
result::Result solve_set(const Question& question, const symbolic::Mechanism& mechanism,
                         std::optional<symbolic::SingularitySet> set, const System& system,
                         const std::vector<std::string>& kernel_scales, const solve::Options& options,
                         solve::Control& control, int digits = 0);

/// "stopped by the time limit, in the stage search".
std::string stopped_words(const result::Result& result);

}  // namespace corank::app
