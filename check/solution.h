// A solution near a point, found and proven anew.
#pragma once

#include <string>
#include <vector>

#include "corank/check/problem.h"

namespace corank::check {

/// Encloses a solution of all equations of a problem without a reduction, at which the variables `held` have the point's
/// values exactly; as many are to be held as the equations leave free. `fault`: why none was shown; empty where one was.
/// Theorem (Krawczyk, Brouwer): where the image of a box lies strictly inside of it, the box holds a solution with the
/// held variables' values; it lies in every further image, too.
Sides solution_near(const Problem& problem, const std::vector<double>& point, const std::vector<int>& held,
                    std::string& fault);

}  // namespace corank::check
