// Numbers for people.
#pragma once

#include <string>

#include "corank/core/interval.h"

namespace corank::result {

/// "[0.59999999, 0.60000001]" with at most so many significant digits, rounded outward (below 1e-12 to 0 or
/// ±1e-12); one number where both ends agree.
std::string outward_text(const Interval& x, int digits);

}  // namespace corank::result
