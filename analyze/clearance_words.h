// Words that the texts about clearances share.
#pragma once

#include <string>

#include "corank/analyze/ball.h"

namespace corank::analyze {

std::string set_of(const Ball& ball);

/// A double that is no larger, no smaller, with six digits.
std::string rounded(double x, bool up);

}  // namespace corank::analyze
