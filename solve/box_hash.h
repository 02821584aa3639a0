// Boxes by their sides.
#pragma once

#include <boost/functional/hash.hpp>

#include "corank/core/cover.h"

namespace corank::solve {

inline std::size_t hash(const Box& box) {
  std::size_t seed = 0;
  for (const Interval& side : box) {
    boost::hash_combine(seed, side.lo());
    boost::hash_combine(seed, side.hi());
  }
  return seed;
}

}  // namespace corank::solve
