// The order of a cover's boxes: by their sides, then by what is claimed of them, so that it does not matter which thread
// found which box.
#pragma once

#include <algorithm>
#include <boost/functional/hash.hpp>
#include <tuple>
#include <utility>

#include "corank/core/cover.h"

namespace corank::solve {

/// The sides of these variables, one after the other, are compared by their lower ends, then by their upper ends.
template <class Variables>
bool before(const CoverBox& a, const CoverBox& b, const Variables& variables) {
  for (const auto v : variables) {
    const Interval &x = a.box[v], &y = b.box[v];
    if (x.lo() != y.lo()) return x.lo() < y.lo();
    if (x.hi() != y.hi()) return x.hi() < y.hi();
  }
  return std::tie(a.verdict, a.free) < std::tie(b.verdict, b.free);
}

/// Of boxes alone.
inline bool before(const Box& a, const Box& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return std::pair(x.lo(), x.hi()) < std::pair(y.lo(), y.hi());
  });
}

/// Of the box's sides.
inline std::size_t hash(const Box& box) {
  std::size_t seed = 0;
  for (const Interval& side : box) {
    boost::hash_combine(seed, side.lo());
    boost::hash_combine(seed, side.hi());
  }
  return seed;
}

}  // namespace corank::solve
