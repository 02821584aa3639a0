// Boxes that were cut from one proof, as one box: what is shown all over it holds in each of them.
#pragma once

#include <vector>

#include "corank/core/cover.h"

namespace corank::solve {

/// Of each of Cover::regions the hull of the boxes that were cut from it, where there are two or more; an empty box for
/// other regions.
std::vector<Box> hulls_by_region(const Cover& cover);

}  // namespace corank::solve
