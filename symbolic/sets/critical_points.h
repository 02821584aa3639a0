// The critical points of a height on C-space, as a system: where the topology of a smooth set is read from (Morse theory).
//
//   h(q) = Σ a_i cos θ_i + b_i sin θ_i + Σ c_j x_j     with fixed generic a, b, c
//   Φ(q) = 0,   Φ_qᵀ λ + μ ∇h = 0,   ‖(λ, μ)‖ = 1
//
// On a C-space where Φ_q has full rank everywhere μ ≠ 0, and these are the points where h does not vary to first order
// along C-space. There the second-order form of h along C-space is that of (μ h + λᵀΦ)/μ on the kernel of Φ_q (Milnor,
// "Morse Theory", 1963, § 2; Lagrange).
#pragma once

#include <string>
#include <vector>

#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

struct CriticalPoints {
  TrigonometricSystem system;  ///< its kernel unknowns are those of λ, then that of μ
  std::vector<std::string>
      names;                  ///< of the coordinates that are not held at one value, the order of the rows and columns below
  ExpressionMatrix jacobian;  ///< Φ_q
  ExpressionMatrix hessian;   ///< D²(μ h + λᵀΦ), in the coordinates and the kernel unknowns, scales put in
  Expression multiplier;      ///< μ
};

/// `height` chooses one of several heights, 0, 1, 2 … Throws ModelError as derive() does.
CriticalPoints critical_points(const Mechanism& mechanism, int height = 0);

}  // namespace corank::symbolic
