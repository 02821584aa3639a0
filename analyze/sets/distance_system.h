// A system with the squared distance of its solutions from a centre as one more variable: so bounds of the distance contract
// boxes, and boxes bound the distance, by what certify/ does with any system.
#pragma once

#include <vector>

#include "corank/solve/step/options.h"

namespace corank::analyze {

/// The reduced system; its inequalities between configuration variables as equations with a slack variable each; d_k = its
/// k-th difference, which is linear; and t = Σ d_k². For each of its solutions slacks, d and t are unique, so the solutions
/// correspond one to one.
struct DistanceSystem {
  System system;
  int squared = 0;                 ///< t, the last variable
  std::vector<Polynomial> values;  ///< of the eliminated variables
};

/// `differences`: in the variables of the original system.
DistanceSystem distance_system(const certify::Reduction& reduction, const std::vector<Polynomial>& differences);

}  // namespace corank::analyze
