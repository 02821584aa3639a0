// Where the kernel has dimension c: the system for the configuration q and c independent kernel vectors.
#pragma once

#include <vector>

#include "corank/certify/exact_verification.h"
#include "corank/core/system.h"

namespace corank::solve {

/// Φ(q) = 0, M(q) ξ¹ = 0 … M(q) ξᶜ = 0 with ξᵏ = 1 in its own pivot, 0 in the others' pivots: no norm and no rotation is
/// left free. Over-determined in general. Variables: those of the system that are no kernel variables, in order, then the
/// free entries of the vectors.
struct CorankSystem {
  System system;
  std::vector<int> configuration;  ///< index in the original system of each of the leading variables
  std::vector<double> start;       ///< near the given point
};

/// About a point x of the system near which M has c small singular values (Eigen's SVD; heuristic). Nothing can go wrong by
/// the choice: what is found is verified.
CorankSystem corank_system(const System& system, const PolynomialMatrix& matrix, const std::vector<double>& x, int c);

/// The singular values of M at x, descending.
std::vector<double> singular_values(const PolynomialMatrix& matrix, const std::vector<double>& x);

}  // namespace corank::solve
