// A system and the cover of its solutions, for tests.
#pragma once

#include "corank/core/cover.h"
#include "corank/core/system.h"

namespace corank {

struct Solved {
  System system;
  Cover cover;
};

}  // namespace corank
