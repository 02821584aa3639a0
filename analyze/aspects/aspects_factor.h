// By which factor all tolerances may grow, while every robot within them has as many aspects, assembly modes and working
// modes as the one that was drawn.
//
// Example: if the factor is in [15.5, 17], tolerances of ±1.55 mm are safe where ±0.1 mm were given, and ±1.7 mm are not.
//
// Factors are those of tolerance_factor.h. What is proven for every robot at one factor holds at each smaller one, and a
// robot with other numbers at one factor is there at each larger one. Between the bounds neither was proven: near a robot
// at which the numbers change the proof of aspects_of_robots.h needs room.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/aspects/aspects.h"

namespace corank::analyze {

struct AspectsFactorOptions {
  double precision = 0.01;  ///< of each bound, relative
  int threads = 1;
  std::function<void(double lower, std::optional<double> upper)> progress{};
};

struct AspectsFactor {
  ExactNumbers numbers;                     ///< that every robot is to keep
  double lower = 0;                         ///< proven: every robot within so many times the tolerances has them
  std::optional<double> upper;              ///< proven: some robot within so many times the tolerances has others
  std::vector<CoordinateValue> tolerances;  ///< at the lower bound
  std::vector<CoordinateValue> robot;       ///< of the upper bound, its constants
  ExactNumbers other_numbers;               ///< of that robot
  std::string reason;                       ///< why nothing more is known; empty where the bounds are as close as asked for
  double precision = 0.01;
  int steps = 0;
  double seconds = 0;

  bool complete() const { return upper && *upper <= lower * (1 + precision); }
};

/// Throws ModelError as aspects() does, and where no constant has a tolerance.
AspectsFactor aspects_factor(const study::Question& question, const AspectsFactorOptions& options, solve::Control& control);

std::string to_table(const study::Question& question, const AspectsFactor& factor);
/// {"model", "keep": {"aspects", …}, "factor": {"lo", "hi" (null: none is proven)}, "tolerances", "robot", "other" (null, or
/// the numbers of that robot), "complete", "reason", "precision", "steps", "seconds"}.
std::string to_json(const study::Question& question, const AspectsFactor& factor);

}  // namespace corank::analyze
