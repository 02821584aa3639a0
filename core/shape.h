// What is claimed of the shape of a solution set, with what it takes to check it: covers, links between sheets, counts.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/cover.h"

namespace corank {

/// A solution that lies in two sheets. Sheets are the regions of a cover, then the bridges: their indices follow.
struct SheetLink {
  int first = 0, second = 0;
  std::vector<int> held;      ///< variables that have the point's values exactly; as many as the set has dimensions
  std::vector<double> point;  ///< near the solution
};

/// A sheet that belongs to no box: in the region, for every value of the free variables, exactly one solution.
struct SheetBridge {
  std::vector<int> free;
  Box region;
};

/// The critical points of one height (symbolic/sets/critical_points.h).
struct HeightCover {
  int height = 0;
  Cover cover;
  std::vector<int> by_index;  ///< numbers of points of index 0, 1 … dimension
};

struct Shape {
  Cover space;  ///< all boxes `regular`
  std::vector<SheetBridge> bridges;
  std::vector<SheetLink> links;
  std::vector<HeightCover> heights;
  int at_least = 0;
  std::optional<int> at_most;  ///< components
  std::optional<int> euler_characteristic;
  std::vector<int> genus;  ///< of each component, ascending; none: nothing is claimed
};

}  // namespace corank
