#include "corank/result/result.h"

namespace corank::result {

std::string version() { return CORANK_VERSION; }

void describe_system(const System& system, Result& result) {
  result.variables.clear();
  for (const Variable& v : system.variables) result.variables.push_back({v.name, v.kind, v.domain});
  result.angles = system.angles;
  result.configuration_size = system.configuration_size;
  result.equations = static_cast<int>(system.equations.size());
  result.inequalities = static_cast<int>(system.inequalities.size());
}

}  // namespace corank::result
