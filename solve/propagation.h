// Projections of single equations in turns (hull consistency): cheap, and useful on wide boxes. Heuristic in its order; each
// projection is certify::project.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/solve/recorder.h"

namespace corank::solve {

/// Buffers for one thread.
class Propagator {
 public:
  /// Projects every row, and each row again when one of its variables has lost more than a tenth of its width. False: x
  /// holds no solution. Where given, the recorder keeps what was gained.
  bool run(const certify::CompiledSystem& system, std::span<Interval> x, Recorder* recorder = nullptr);

 private:
  std::vector<Interval> before_;  // for the recorder
  std::vector<std::uint8_t> changed_, pending_;
  std::vector<int> queue_;
};

/// Sizes that are typical in the search domain as propagation leaves it, so that neither the unit of length nor a generous
/// range steers the search.
struct TypicalSizes {
  std::vector<double> variables;  ///< half their widths; the magnitude of one that has one value; 1 for 0
  std::vector<double> equations;  ///< the largest |∂f_i/∂x_j| · size of x_j over the domain; 1 where that is 0 or unbounded
};
TypicalSizes typical_sizes(const certify::CompiledSystem& system, std::vector<Interval> domain);

}  // namespace corank::solve
