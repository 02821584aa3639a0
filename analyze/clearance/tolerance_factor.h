// By which factor all tolerances may grow (factor_search.h), while each robot within them still keeps a radius free of
// singularities.
#pragma once

#include <string>
#include <vector>

#include "corank/analyze/clearance/factor_search.h"

namespace corank::analyze {

struct ToleranceFactorOptions {
  double radius = 0;        ///< that every robot is to keep, > 0
  double precision = 0.01;  ///< of the factor, relative
  FactorProgress progress{};
};

/// What each robot keeps: it has a configuration at the centre, and no singularity nearer than the radius.
struct ToleranceFactor : FactorBounds {
  Ball ball;  ///< of the question itself
  double radius = 0;
  std::vector<CoordinateValue> nearest;  ///< of the upper bound's robot, its singularity, nearer than the radius
  std::uint64_t processed = 0;           ///< boxes
};

/// Throws ModelError as clearance() does, and where no constant has a tolerance.
ToleranceFactor tolerance_factor(const study::Question& question, const BallOptions& ball,
                                 const ToleranceFactorOptions& options, const solve::Options& search,
                                 solve::Control& control);

std::string to_table(const ToleranceFactor& factor);
/// {"model", "set", "at", "in", "keep": {"clearance"}, "factor": {"lo", "hi" (null: none is proven)}, "tolerances": {name:
/// {"lo", "hi"}} at the lower factor, "robot", "nearest" (null, or as of a clearance), "complete", "stopped", "reason",
/// "precision", "steps", "processed", "seconds"}.
std::string to_json(const ToleranceFactor& factor);

}  // namespace corank::analyze
