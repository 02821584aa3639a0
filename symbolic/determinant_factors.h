// The determinant of a square matrix of expressions, in factors: it vanishes where one of them does. Where two factors
// vanish at once the determinant's own gradient is zero; theirs need not be.
#pragma once

#include <vector>

#include "corank/symbolic/velocity_equation.h"

namespace corank::symbolic {

/// Expressions in coordinates and constants, none twice, of which each divides det M and whose zeros are those of det M;
/// none where det M is a constant other than 0. Sines and cosines count as unknowns of their own: what only sin² + cos² =
/// 1 shows to be a product stays one factor. Throws ModelError where det M vanishes identically, or M is not square or
/// larger than 12×12.
std::vector<Expression> determinant_factors(const Mechanism& mechanism, const ExpressionMatrix& matrix);

}  // namespace corank::symbolic
