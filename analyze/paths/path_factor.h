// By which factor all tolerances may grow (factor_search.h), while every robot within them follows a stored path
// (path_of_robots.h).
#pragma once

#include <string>
#include <vector>

#include "corank/analyze/clearance/factor_search.h"
#include "corank/analyze/paths/path.h"

namespace corank::analyze {

struct PathFactorOptions {
  double precision = 0.01;  ///< of the factor, relative
  FactorProgress progress{};
};

struct PathFactor : FactorBounds {
  Avoid avoid = Avoid::forward;        ///< what each robot's path avoids
  std::vector<CoordinateValue> place;  ///< on the path of the upper bound's robot, where it fails
  std::string what;                    ///< how
};

/// Throws ModelError where the path is none of this mechanism, or no constant has a tolerance.
PathFactor path_factor(const study::Question& question, const result::PathFile& path, const PathFactorOptions& options,
                       solve::Control& control);

std::string to_table(const study::Question& question, const PathFactor& factor);
/// {"model", "keep": {"path": "forward" …}, "factor": {"lo", "hi" (null: none is proven)}, "tolerances", "robot",
/// "complete", "stopped", "reason", "precision", "steps", "seconds", "place" (null, or as "nearest" of a clearance), "what"
/// (null, or a sentence)}.
std::string to_json(const study::Question& question, const PathFactor& factor);

}  // namespace corank::analyze
