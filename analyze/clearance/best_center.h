// The largest ball without a singularity whose centre lies in a region: Lipschitz branch and bound. A cell of the region
// about a, all of whose points are h or less away from a, holds no centre of clearance over r(a) + h (center_field.h); the
// cell of the largest bound is divided first. Cells without a configuration are deleted. A centre counts where it is proven
// that the robot has a configuration there.
#pragma once

#include <functional>

#include "corank/analyze/clearance/center_field.h"
#include "corank/analyze/clearance/clearance.h"

namespace corank::analyze {

struct BestOptions {
  double precision = 0.01;  ///< of the radius, relative
  std::function<void(double lower, std::optional<double> upper, std::uint64_t cells)> progress{};
};

struct Best {
  Ball ball;
  std::vector<std::string> names;  ///< the region
  Box region;
  double lower = 0;                      ///< the ball about `center` is free; 0: no centre was found
  std::optional<double> upper;           ///< no centre in the region has more; nothing: no bound is proven
  std::vector<double> center;            ///< empty: none was found
  std::vector<CoordinateValue> nearest;  ///< of the proven singularity nearest to it; empty: none was proven
  bool empty = false;                    ///< proven: no singularity at all in the ranges
  bool unassembled = false;              ///< proven: no configuration has its centre in the region
  bool complete = false;                 ///< as precise as was asked for, or empty, or unassembled
  double precision = 0.01;
  std::string stopped;  ///< what ended the search early; empty: nothing
  std::uint64_t cells = 0, processed = 0;
  double seconds = 0;
};

Best best_center(const study::Question& question, const BallOptions& ball, const std::vector<NamedRange>& region,
                 const BestOptions& options, const solve::Options& search, solve::Control& control);

std::string to_table(const Best& best);
/// {"model", "set", "in", "region": {name: [lo, hi]}, "radius": {"lo", "hi" (null: none is proven)}, "centre" (null, or
/// {name: value}), "nearest" as of a clearance, "empty", "unassembled", "complete", "stopped", "precision", "cells",
/// "processed", "seconds"}.
std::string to_json(const Best& best);

}  // namespace corank::analyze
