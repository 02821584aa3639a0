// What shrinks a box of a search. Heuristic in its order; all that deletes or shrinks is a call into certify/.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/newton.h"
#include "corank/core/cover.h"
#include "corank/solve/step/heuristics.h"
#include "corank/solve/step/preconditioner.h"
#include "corank/solve/step/recorder.h"

namespace corank::solve {

/// Projections of single equations in turns (hull consistency, certify::project): cheap, and useful on wide boxes. One per
/// thread.
class Propagator {
 public:
  /// `worthwhile`: Heuristics::worthwhile.
  explicit Propagator(double worthwhile = Heuristics{}.worthwhile) : worthwhile_(worthwhile) {}
  /// Projects every row, and each row again when one of its variables has lost more than that share of its width. False: x
  /// holds no solution. Where given, the recorder keeps what was gained.
  bool run(const certify::CompiledSystem& system, std::span<Interval> x, Recorder* recorder = nullptr);

 private:
  double worthwhile_;
  std::vector<Interval> before_;  // for the recorder
  std::vector<std::uint8_t> changed_, pending_;
  std::vector<int> queue_;
};

/// Sizes that are typical in the search domain as propagation leaves it, so that neither the unit of length nor a generous
/// range steers the search.
struct TypicalSizes {
  std::vector<double> variables;  ///< half their widths; the magnitude of one that has one value; 1 for 0; of a parameter
                                  ///< kParameterSize
  std::vector<double> equations;  ///< the largest |∂f_i/∂x_j| · size of x_j over the domain; 1 where that is 0 or unbounded
};
TypicalSizes typical_sizes(const certify::CompiledSystem& system, std::vector<Interval> domain);

/// Propagation and interval Newton in turns. One per thread. The system, the preconditioners and the workspace have to
/// outlive it.
class Contractor {
 public:
  Contractor(const certify::CompiledSystem& system, const Heuristics& heuristics, PreconditionerFactory& preconditioners,
             certify::NewtonWorkspace& workspace, Recorder* recorder = nullptr)
      : system_(system),
        heuristics_(heuristics),
        preconditioners_(preconditioners),
        workspace_(workspace),
        recorder_(recorder) {}

  /// Shrinks x in place, but for parameters; false: x holds no solution. Every solution in x is in what is left.
  bool run(std::span<Interval> x, Statistics& statistics);

  // Of the last run:
  const std::optional<certify::NewtonStep>& step() const { return step_; }  ///< the last one
  bool regular() const { return regular_; }                                 ///< it divided by no interval with 0
  bool noisy() const { return noisy_; }                  ///< rounding made it as uncertain as the box is wide
  bool worth_proving() const { return worth_proving_; }  ///< it was near a proof
  bool near_sheet() const { return near_sheet_; }        ///< parts of it along the free variables may be near one

 private:
  bool is_noisy(std::span<const Interval> x) const;

  const certify::CompiledSystem& system_;
  const Heuristics heuristics_;
  PreconditionerFactory& preconditioners_;
  certify::NewtonWorkspace& workspace_;
  Recorder* const recorder_;
  std::optional<certify::NewtonStep> step_;
  Propagator propagator_{heuristics_.worthwhile};
  std::vector<double> widths_;
  bool regular_ = false, noisy_ = false, worth_proving_ = false, near_sheet_ = false;
};

}  // namespace corank::solve
