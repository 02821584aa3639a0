// How many random cases a test tries.
#pragma once

#include <cstdlib>
#include <string>

namespace corank::test {

/// Is this one of the long runs before a release, which CORANK_SEEDS asks for?
inline bool long_run() { return std::getenv("CORANK_SEEDS") != nullptr; }

/// As many as CORANK_SEEDS says; without it the usual number.
inline unsigned seeds(unsigned usual) {
  return long_run() ? static_cast<unsigned>(std::stoul(std::getenv("CORANK_SEEDS"))) : usual;
}

}  // namespace corank::test
