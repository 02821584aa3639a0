// What shrinks a box of a search: propagation and interval Newton in turns. Heuristic in its order; all that deletes or
// shrinks is a call into certify/.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "corank/certify/newton.h"
#include "corank/core/cover.h"
#include "corank/solve/preconditioner.h"
#include "corank/solve/propagation.h"
#include "corank/solve/tuning.h"

namespace corank::solve {

/// One per thread. The system, the preconditioners and the workspace have to outlive it.
class Contractor {
 public:
  Contractor(const certify::CompiledSystem& system, const Tuning& tuning, PreconditionerFactory& preconditioners,
             certify::NewtonWorkspace& workspace, Recorder* recorder = nullptr)
      : system_(system), tuning_(tuning), preconditioners_(preconditioners), workspace_(workspace), recorder_(recorder) {}

  /// Shrinks x in place; false: x holds no solution. Every solution in x is in what is left.
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
  const Tuning tuning_;
  PreconditionerFactory& preconditioners_;
  certify::NewtonWorkspace& workspace_;
  Recorder* const recorder_;
  std::optional<certify::NewtonStep> step_;
  Propagator propagator_;
  std::vector<double> widths_;
  bool regular_ = false, noisy_ = false, worth_proving_ = false, near_sheet_ = false;
};

}  // namespace corank::solve
