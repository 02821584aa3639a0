#include "corank/solve/prepared.h"

#include <utility>

namespace corank::solve {

Prepared prepare(System system, const Options& options, Control& control) {
  const InStage stage(control, Stage::reduction);
  system.validate();
  options.validate(system);
  certify::Reduction reduction = certify::reduce(system, [&control] { return control.ended(); });
  return {std::move(system), std::move(reduction), options};
}

}  // namespace corank::solve
