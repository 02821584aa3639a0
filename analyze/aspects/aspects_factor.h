// By which factor all tolerances may grow (factor_search.h), while every robot within them has as many aspects, assembly
// modes and working modes as the one that was drawn.
//
// Between the bounds there may be a gap, in which neither was proven: near a robot at which the numbers change the proof of
// same_strata.h needs room.
#pragma once

#include <string>

#include "corank/analyze/aspects/aspects.h"
#include "corank/analyze/clearance/factor_search.h"

namespace corank::analyze {

struct AspectsFactorOptions {
  double precision = 0.01;  ///< of each bound, relative
  int threads = 1;
  FactorProgress progress{};
};

struct AspectsFactor : FactorBounds {
  ExactNumbers numbers;        ///< that every robot is to keep
  ExactNumbers other_numbers;  ///< of the upper bound's robot
};

/// Throws ModelError as aspects() does, and where no constant has a tolerance.
AspectsFactor aspects_factor(const study::Question& question, const AspectsFactorOptions& options, solve::Control& control);

std::string to_table(const study::Question& question, const AspectsFactor& factor);
/// {"model", "keep": {"aspects", …}, "factor": {"lo", "hi" (null: none is proven)}, "tolerances", "robot", "other" (null, or
/// the numbers of that robot), "complete", "stopped", "reason", "precision", "steps", "seconds"}.
std::string to_json(const study::Question& question, const AspectsFactor& factor);

}  // namespace corank::analyze
