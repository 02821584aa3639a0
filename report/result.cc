#include "corank/report/result.h"

namespace corank::report {

std::string version() { return CORANK_VERSION; }

void describe_system(const certify::System& system, Result& result) {
  result.variables.clear();
  for (const certify::Variable& v : system.variables) result.variables.push_back({v.name, v.kind, v.domain});
  result.angles = system.angles;
  result.configuration_size = system.configuration_size;
  result.equations = static_cast<int>(system.equations.size());
  result.inequalities = static_cast<int>(system.inequalities.size());
}

}  // namespace corank::report
