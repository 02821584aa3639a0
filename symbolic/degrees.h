// Degrees in expressions: 15deg, and deg, which is pi/180.
#pragma once

#include <string>

#include "corank/symbolic/expression.h"

namespace corank::symbolic {

/// So many degrees, exactly: of "15" pi/12, of "22.5" pi/8, of "1" pi/180.
Expression degrees(const std::string& decimal, const SourceLocation& where = {});

}  // namespace corank::symbolic
