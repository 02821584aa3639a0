// By which factor all tolerances may grow, while each robot within them still keeps a radius free of singularities.
//
// Example: if the factor is in [3.1, 3.2], tolerances of ±0.31 mm are safe where ±0.1 mm were given, and ±0.32 mm are not.
//
// A tolerance [a, b] of a constant whose nominal value is v becomes [v + s (a − v), v + s (b − v)] for the factor s. These
// are nested: robots within smaller tolerances are within larger ones. So what holds for every robot at one factor does at
// each smaller one, and a robot that has a singularity too near at one factor is there at each larger one.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/clearance/clearance.h"

namespace corank::analyze {

struct ToleranceFactorOptions {
  double radius = 0;        ///< that every robot is to keep, > 0
  double precision = 0.01;  ///< of the factor, relative
  std::function<void(double lower, std::optional<double> upper)> progress{};
};

struct ToleranceFactor {
  Ball ball;  ///< of the question itself
  double radius = 0;
  double lower = 0;  ///< proven: every robot within so many times the tolerances reaches the centre and keeps the radius
  std::optional<double> upper;  ///< proven: some robot within so many times the tolerances does not; 0: that as drawn
  std::vector<CoordinateValue> tolerances;  ///< at the lower bound
  std::vector<CoordinateValue> robot;       ///< of the upper bound, its constants
  std::vector<CoordinateValue> nearest;     ///< its singularity, nearer than the radius
  bool complete = false;                    ///< as precise as was asked for
  std::string reason;                       ///< why it is not, or why there is no upper bound; else empty
  double precision = 0.01;
  int steps = 0;
  std::uint64_t processed = 0;  ///< boxes
  double seconds = 0;
};

/// The question with tolerances that are so many times as large. Throws ModelError where the robots of some of them may have
/// other equations.
study::Question with_scaled_tolerances(study::Question question, double factor);
/// Those tolerances, enclosed.
std::vector<CoordinateValue> scaled_tolerances(const study::Question& question, double factor);
/// Throws ModelError where no constant has a tolerance.
void require_a_tolerance(const study::Question& question);

/// Throws ModelError as clearance() does, and where no constant has a tolerance.
ToleranceFactor tolerance_factor(const study::Question& question, const BallOptions& ball,
                                 const ToleranceFactorOptions& options, const solve::Options& search,
                                 solve::Control& control);

std::string to_table(const ToleranceFactor& factor);
/// {"model", "set", "at", "in", "keep": {"clearance"}, "factor": {"lo", "hi" (null: none is proven)}, "tolerances": {name:
/// {"lo", "hi"}} at the lower factor, "robot", "nearest" (null, or as of a clearance), "complete", "reason", "precision",
/// "steps", "processed", "seconds"}.
std::string to_json(const ToleranceFactor& factor);

}  // namespace corank::analyze
