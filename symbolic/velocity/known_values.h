// What is known at every configuration, put into a matrix, so that its blocks show: a platform that keeps its orientation
// has rows that do not mention it.
#pragma once

#include <vector>

#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::symbolic {

/// Angles that are fixed at a multiple of π/2 are replaced by their value in the matrix and in Φ; entries that are 0 by the
/// values of the constants, as k5 − half s of two parallel rods, become so, where no constant has a tolerance. At every
/// configuration the matrix is the same.
void put_in_known_values(const Mechanism& mechanism, ExpressionMatrix& matrix, std::vector<Expression>& phi);

}  // namespace corank::symbolic
