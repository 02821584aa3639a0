// Sets solved with their exact points, and the boxes that hold a configuration, for tests.
#pragma once

#include <cstddef>
#include <vector>

#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"

namespace corank::test {

inline Cover exactly_solved(const System& system, const solve::Options& options = {}) {
  Cover cover = solve::solve(system, options);
  solve::prove_exactly(system, {}, cover);
  return cover;
}

/// Is the configuration, known to `slack`, in the leading sides of the box?
inline bool holds(const CoverBox& box, const std::vector<double>& q, double slack = 1e-12) {
  for (std::size_t j = 0; j < q.size(); ++j)
    if (q[j] < box.box[j].lo() - slack || q[j] > box.box[j].hi() + slack) return false;
  return true;
}

}  // namespace corank::test
