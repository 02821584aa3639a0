#include "corank/solve/engine_version.h"

namespace corank::solve {

extern const char* const kEngineHash;  // made by cmake/EngineHash.cmake

const std::string& engine_version() {
  static const std::string version = std::string(CORANK_VERSION) + " (search " + kEngineHash + ")";
  return version;
}

}  // namespace corank::solve
