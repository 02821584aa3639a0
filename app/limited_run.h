// The control of a subcommand that computes, and a watch for what cannot look at it.
#pragma once

#include "corank/app/interrupt.h"
#include "corank/app/watch.h"
#include "corank/solve/control.h"

namespace corank::app {

class LimitedRun {
 public:
  /// Everything that has a control ends soon after the limit of time or the first signal. GiNaC and FLINT do not look at it:
  /// where equations are still being derived Watch::kGrace later, the program ends with a statement, by exit status
  /// kIncomplete. Nothing was found by then, and no file is left half written.
  explicit LimitedRun(solve::Control::Limits limits);

  solve::Control& control() { return control_; }

 private:
  Interrupt interrupt_;
  solve::Control control_;
  Watch watch_;
};

}  // namespace corank::app
