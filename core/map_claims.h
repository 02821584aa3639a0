// What is claimed of a number of solutions over cells of a plane of parameters.
#pragma once

#include <vector>

#include "corank/core/cover.h"
#include "corank/core/requirement.h"

namespace corank {

/// A solution for each value of the parameters in a cell: the one in the region, and it lies in the box. In all variables;
/// the plane's sides are
/// the cell's, those of constants within tolerances their whole tolerances.
struct MapSheet {
  Box box, region;
};

/// For every value in the cell, of every robot within the tolerances, the system has one solution on each of the sheets,
/// which all differ, and no others.
struct MapCellClaim {
  Box sides;      ///< of the plane's two parameters
  int count = 0;  ///< of what is asked for: ParametricSystem::copies solutions of the system are one of these
  std::vector<MapSheet> sheets;
  /// Of the requirements: satisfied where for every value in the cell all solutions meet all of them, violated where for
  /// every value one solution does not meet one.
  Standing standing = Standing::open;
};

struct MapClaims {
  std::vector<ReductionStep> reduction;  ///< of the system, the parameters kept
  std::vector<MapCellClaim> cells;
};

}  // namespace corank
