// A question to the solver, made ready once for all that is done about it: searches, exact proofs, decimals.
#pragma once

#include "corank/certify/reduction.h"
#include "corank/core/system.h"
#include "corank/solve/options.h"

namespace corank::solve {

struct Prepared {
  System system;
  certify::Reduction reduction;  ///< of the system; valid, if not the whole of it, where the control had ended before
  Options options;
};

/// Throws std::invalid_argument where the system is not valid (System::validate), OptionError where the options are not.
Prepared prepare(System system, const Options& options, Control& control);

}  // namespace corank::solve
