// Where two solutions over a plane of parameters meet: F(p, x) = 0 with a kernel vector ξ of F_x.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/system.h"

namespace corank::analyze {

/// F(p, x) = 0, F_x diag(s) ξ = 0, ‖ξ‖ = 1, a·ξ ≥ 0, as many equations as unknowns less one where there are two parameters:
/// a `regular` box of it holds a piece of the curve of parameters at which F_x is singular, for every robot where some of
/// `parameters` are constants with tolerances. s: the powers of two next to `sizes`. σ counts for the others alone. Nothing
/// where a sine or cosine of an x would stand in a product.
std::optional<System> fold_system(const System& system, const std::vector<int>& parameters,
                                  const std::vector<double>& sizes);

}  // namespace corank::analyze
