#include "corank/solve/prepared.h"

#include <utility>

#include "corank/solve/implied_equations.h"
#include "corank/solve/reducer.h"

namespace corank::solve {

Prepared prepare(System system, const Options& options, Control& control) {
  const InStage stage(control, Stage::reduction);
  system.validate();
  options.validate(system);
  const Ended ended = [&control] { return control.ended(); };
  certify::Reduction reduction = reduce(system, ended);
  add_implied_equations(system.claimed, reduction, ended);
  return {std::move(system), std::move(reduction), options};
}

}  // namespace corank::solve
