// How many random cases a test tries.
#pragma once

#include <cstdlib>
#include <string>

namespace corank::test {

/// As many as CORANK_SEEDS says, for long runs before a release; without it the usual number.
inline unsigned seeds(unsigned usual) {
  const char* const asked = std::getenv("CORANK_SEEDS");
  return asked ? static_cast<unsigned>(std::stoul(asked)) : usual;
}

}  // namespace corank::test
