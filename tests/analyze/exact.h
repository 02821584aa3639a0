// Doubles as constants of a question, exactly, for tests.
#pragma once

#include "corank/symbolic/model/expression.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::analyze {

inline symbolic::Expression number(double x) { return symbolic::parse_expression(ExactNumber::dyadic(x).text()); }

}  // namespace corank::analyze
