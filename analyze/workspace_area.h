// The area of a mechanism's workspace in the plane of two outputs, in proven bounds.
//
//   W = { (x, y) : a configuration within the domain and the inequalities has these outputs }
//
// The plane is divided into cells, the largest undecided one first. A cell is
//   in    where newton_prove (certify/newton.h), with the outputs free in the cell and the coordinates that are left over
//         fixed at values, shows one configuration for every output in it, and DomainTest that all of these are inside;
//   out   where projections, Newton steps and bisection leave nothing of the configurations over it.
// So Σ in ≤ area(W) ≤ Σ in + Σ undecided; sums are rounded outward, and cells meet in edges, which have no area.
#pragma once

#include <functional>

#include "corank/core/system.h"

namespace corank::analyze {

struct AreaOptions {
  double share = 0.02;             ///< the bounds may differ by so much of the upper one
  std::size_t max_cells = 20'000;  ///< that are examined
  std::function<bool()> stop{};    ///< ends the work, with what is proven so far
};

struct AreaBounds {
  double lo = 0, hi = 0;  ///< the area is in [lo, hi]
  std::size_t cells = 0;  ///< examined
};

/// Is every point of the cell an output (1), none (−1)? 0: that is not known after so many tries.
int membership(const System& configurations, int x, int y, const Interval& cell_x, const Interval& cell_y, int tries);

/// Of a system of configurations (symbolic::configurations) with exact coefficients; x and y are variables of it.
AreaBounds workspace_area(const System& configurations, int x, int y, const AreaOptions& options = {});

}  // namespace corank::analyze
