#include "corank/core/singularity_types.h"

namespace corank {

const char* to_string(SingularityType type) {
  switch (type) {
    case SingularityType::ro: return "RO";
    case SingularityType::rpm: return "RPM";
    case SingularityType::ii: return "II";
    case SingularityType::ri: return "RI";
    case SingularityType::io: return "IO";
    case SingularityType::iim: return "IIM";
  }
  return "?";
}

}  // namespace corank
