// From a mechanism's set to its result: what corank solve and corank report share.
#pragma once

#include <optional>

#include "corank/app/question.h"
#include "corank/solve/solve.h"

namespace corank::app {

/// Solves the system of a set (nothing: of a plain system), proves exactly what can be, and returns all that a result file holds.
/// `kernel_scales`: with which the system was made. `digits`: isolated points get so many proven digits after the point; 0: none.
report::Result solve_set(const Question& question, const symbolic::Mechanism& mechanism,
                         std::optional<symbolic::SingularitySet> set, const certify::System& system,
                         const std::vector<std::string>& kernel_scales, const solve::Options& options, int digits = 0);

}  // namespace corank::app
