// The union of many polygons on a grid, as few points as show it: how the parts of a region become one shape.
#pragma once

#include <vector>

#include "corank/report/cell_union.h"

namespace corank::report {

/// Rings whose interior by the even-odd rule is the union of the polygons', of either sense, but for what is nearer than
/// `tolerance` to its border; holes and pieces that are hardly larger than that are left out.
std::vector<GridPolygon> outlines_of_union(const std::vector<GridPolygon>& polygons, double tolerance);

}  // namespace corank::report
