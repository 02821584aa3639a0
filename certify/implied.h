// Which sides of the search domain the equations imply: these are no boundary of the set.
#pragma once

#include <vector>

#include "corank/core/system.h"

namespace corank::certify {

struct ImpliedSides {
  bool lower = false, upper = false;
  bool both() const { return lower && upper; }
};

/// The sides that hold at every real solution of the equations, inside the domain or not. For equations with rational
/// coefficients, checked in exact arithmetic, and rational ends l ≤ x_j ≤ u:
/// Lemma (squares): if Σ a_i x_i² = b with every a_i > 0, then a_j x_j² ≤ b; so x_j ≤ u wherever u ≥ 0 and a_j u² ≥ b;
/// likewise −l. Lemma (sums): if a x_j = Σ b_i y_i + b_0, each y_i a sine, a cosine or a variable whose side that bounds b_i
/// y_i is implied, then a x_j is at most the sum of those bounds; so x_j ≤ u wherever a u is as much. Applied again until
/// nothing is added, also to f − q·g for two such equations f and g where that has fewer terms than one of them: the reach
/// of an arm in a closed chain. Lemma (products; Cauchy–Schwarz): if a x_j = Σ b_k y_k z_k + b_0, distinct y_k with Σ e_i
/// y_i² ≤ Y, e_i > 0, and distinct z_k with Σ f_i z_i² ≤ Z, then |a x_j| ≤ max |b_k| √(Y Z/(min e min f)) + |b_0|: a
/// component of a cross product of unit vectors is at most 1. Sides that the system knows as implied
/// (Variable::lower_implied, upper_implied) are among the answers, and those at or beyond ±1 of a variable that it knows to
/// be in [-1, 1] (Variable::within_one).
std::vector<ImpliedSides> implied_domains(const System& system);

}  // namespace corank::certify
