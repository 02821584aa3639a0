// The configurations of C-space at which a mechanism's requirements are met, as equations and inequalities: what aspects are
// counted on where something is required of the robot.
//
// Example: "amplification(outputs) <= 2" of a five-bar adds one inequality, k⁴ det(L_y)² − k² Σ … + det(L_z)² ≥ 0.
#pragma once

#include <vector>

#include "corank/core/ended.h"
#include "corank/symbolic/model/mechanism.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// Theorem: let the form F = diag(form) be asked to be positive definite on ker A, A of r rows (requirements.h), R = [F, Aᵀ;
/// A, 0]. Where A has full row rank, R has the inertia of F on ker A and r positive and r negative eigenvalues beside. So
///   g = (−1)^r det R > 0 where the form is positive definite and A has full row rank;
///   on a connected piece of {g ≠ 0} A keeps its rank, and the form's inertia is the same everywhere.
/// A loses rank at singular configurations only: A is L, or L without the inputs but one column, of which L_y is a part.
/// g = a² b with polynomials a and b, b without squares, has the sign of b where a ≠ 0. Where b is a product, its factors
/// are functions, too, and it is no inequality: where two of them cross, b has a saddle, which no bound of a number
/// resolves.
///
/// So at each configuration that is not singular and meets the requirements the inequalities hold strictly and no function
/// is 0; and each piece of what these leave meets the requirements everywhere, or nowhere: g > 0 does not tell two negative
/// eigenvalues from none.
struct RequiredSpace {
  std::vector<TrigonometricSystem::Equation> inequalities;  ///< b ≥ 0, and g − f ≥ 0 of a comparison f ≤ g
  std::vector<Expression> functions;                        ///< the factors of a, and of b if it is a product
};

/// Nothing where the mechanism requires nothing. Throws ModelError as at_requirements() does, and where a requirement is met
/// at no configuration or at its limit at all of them; DeterminantTooLarge as determinant_factors() does.
RequiredSpace required_space(const Mechanism& mechanism, const Ended& ended = {});

}  // namespace corank::symbolic
