// What a question will cost, before it is answered.
#pragma once

#include <string>
#include <vector>

#include "corank/solve/search/estimate.h"
#include "corank/study/question.h"

namespace corank::study {

/// Of all parts of a question together, in a trial of `seconds`.
solve::CostEstimate estimate(const std::vector<System>& systems, const solve::Options& options, solve::Control& control,
                             double seconds = 3);

/// For people, and as JSON: {"processed": {"low": …, "likely": …, "high": …}, …}.
std::string to_table(const solve::CostEstimate& cost, int threads);
std::string to_json(const solve::CostEstimate& cost, int threads);

}  // namespace corank::study
