// Is a matrix whose magnitudes are bounded a contraction in some norm ‖x‖ = max |x_i|/r_i?
#pragma once

#include <optional>
#include <vector>

namespace corank::certify {

struct Contraction {
  std::vector<double> weights;  ///< r > 0
  double factor = 0;            ///< α < 1 with E·r ≤ α·r, rounded upward
};

/// Of E ≥ 0, n×n, row by row. Such an r exists exactly where the spectral radius of E is below 1. The candidates come from
/// power iteration, the first one is `sizes`, so that the units of the unknowns do not matter; nothing where none of a few
/// passes. Theorem: then I − A is regular for every A with |A| ≤ E, since ‖A‖ ≤ α < 1. Requires UpwardRounding::active().
std::optional<Contraction> contraction(const std::vector<double>& e, std::vector<double> sizes);

}  // namespace corank::certify
