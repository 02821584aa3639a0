// Sets of larger dimension than the count of equations says, on which linear relations hold: self-motions.
//
// Let R be q linear equations with rational coefficients, each solved for a variable of its own, and F the system. After
// exact substitution of R every equation of F is 0 or a rational multiple of one of s representatives g_1 … g_s, equations
// of F. So
//     { R = 0, g = 0 } ⊂ { F = 0 },                                                                              (*)
// a set of dimension n − q − s where its equations are independent.
//
// Theorem: let E be r = q + s equations of F, X_F a box of n − r free variables and B = X_F × Z. Suppose
//   (1) for every f ∈ X_F the equations E have at most one zero in B, and
//   (2) for every f ∈ X_F the equations {R, g} have a zero in B.
// Then for every f ∈ X_F the *whole* system F has exactly one zero in B, the one of {R, g}. Proof: the zero of (2) solves F
// by (*), hence E; a zero of F is one of E, of which there is one only. ∎
// (1) and (2) are shown by certify::newton_prove, see certify/newton.h.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "corank/certify/newton.h"
#include "corank/core/system.h"

namespace corank::certify {

/// Relations that have been found to make (*) true, in exact arithmetic.
struct SelfMotion {
  std::vector<Polynomial> relations;  ///< R
  System extended;                    ///< F, then R
  CompiledSystem compiled;            ///< of `extended`
  std::vector<int> sufficient;        ///< rows of `extended`: R and g
};

/// Relations x_p + Σ a_j x_j + b = 0, each with a variable x_p that no other relation has. Nothing where (*) is not shown,
/// or its equations are not as many as a set of that dimension asks for. Requires UpwardRounding::active().
std::optional<SelfMotion> self_motion(const System& system, std::vector<Polynomial> relations, int dimension);

/// Do the relations of one follow from those of the other, and the other way round? Requires UpwardRounding::active().
bool same_relations(const SelfMotion& a, const SelfMotion& b);

/// The theorem above: e chooses E and its dependent variables, r the rows `sufficient` with the same dependents; any Y are
/// valid. Every zero of F in x lies in the sheet's image, and the sheet's claim (certify/newton.h) is about all of F. Not
/// proven where one of the hypotheses is not shown.
Sheet prove_self_motion(const CompiledSystem& system, const SelfMotion& motion, const Preconditioner& e,
                        const Preconditioner& r, std::span<const Interval> x, NewtonWorkspace& w);

}  // namespace corank::certify
