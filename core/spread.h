// Over how much numbers spread: along which side many boxes are to be halved.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace corank {

struct Spread {
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  void add(double x) {
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
};

/// The first one that is widest; 0 where there is none.
inline std::size_t widest(std::span<const Spread> spreads) {
  std::size_t result = 0;
  for (std::size_t j = 1; j < spreads.size(); ++j)
    if (spreads[j].greatest - spreads[j].least > spreads[result].greatest - spreads[result].least) result = j;
  return result;
}

}  // namespace corank
