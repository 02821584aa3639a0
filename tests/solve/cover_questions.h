// What the tests of solve/ share: questions to a cover, and two systems.
#pragma once

#include <algorithm>
#include <vector>

#include "corank/solve/search/solve.h"
#include "corank/tests/system_builder.h"

namespace corank::solve {
using test::SystemBuilder;

inline bool covers(const Cover& cover, const std::vector<double>& point) {
  for (const auto& b : cover.boxes) {
    bool inside = true;
    for (std::size_t j = 0; j < point.size() && inside; ++j) inside = b.box[j].contains(point[j]);
    if (inside) return true;
  }
  return false;
}

inline double widest(const Cover& cover) {
  double width = 0;
  for (const auto& b : cover.boxes)
    for (const Interval& side : b.box) width = std::max(width, side.width());
  return width;
}

inline Cover solve_with(const System& system, double sigma, int threads = 1) {
  Options options;
  options.sigma = sigma;
  options.threads = threads;
  return solve(system, options);
}

// (x² + y² − 1 = 0) ∩ (x − y = 0): ±(√½, √½).
inline SystemBuilder circle_and_diagonal() {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}}).equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  return b;
}

// A torus, cut by nothing: (x² + y² + z² + 3/4)² = 4 (x² + y²), radii 1 and 1/2.
inline SystemBuilder torus() {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
  b.equation({{"1", {{x, 4}}},
              {"1", {{y, 4}}},
              {"1", {{z, 4}}},
              {"2", {{x, 2}, {y, 2}}},
              {"2", {{x, 2}, {z, 2}}},
              {"2", {{y, 2}, {z, 2}}},
              {"-2.5", {{x, 2}}},
              {"-2.5", {{y, 2}}},
              {"1.5", {{z, 2}}},
              {"9/16", {}}});
  return b;
}

}  // namespace corank::solve
