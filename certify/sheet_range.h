// How far the solutions over a piece of a proven sheet reach: known from the faces of the piece along which they are
// monotone.
//
// One interval Newton step over the whole piece overestimates the range by a share that grows with the piece's width; a
// face that fixes a free variable has no width in it.
#pragma once

#include <vector>

#include "corank/certify/newton.h"

namespace corank::certify {

/// Shrinks the sides wider than their `widths` of a piece of a proven sheet. The piece: n sides, within the sheet's region,
/// then one for each value row of the system; its dependent and value sides hold the sheet's solutions over its free ones.
/// p: the sheet's rows and dependents, in any order. No solution is lost, so that the sheet's claim carries over. A side is
/// left as wide as its width allows: who verifies the piece without this theorem has to come that close only.
///
/// Theorem: let the sheet be x_D = d(f), f ∈ X_F, and B the piece; E ≥ |I − Y·J_D(B)|, G ∋ Y·J_f(B) for a free variable f,
/// and v > 0 with E·v + |G| < v. Then J_D is regular on B and d differentiable (implicit function theorem; the sheet has
/// one solution for each f, inside its region), and u = ∂d/∂f obeys Y·J_D·u = −Y·J_f, so u ∈ −G + (I − Y·J_D)·u. From |u| ≤
/// |G| + E·|u| and the spectral radius of E below 1 follows |u| ≤ v: u ∈ U = −G + [−E·v, E·v]. Where U_a ≥ 0 or U_a ≤ 0,
/// d_a is monotone in f over the box X_F. So d_a takes its largest value where each variable in which it is monotone is at
/// the end that favours it: on a face of X_F, over which Newton steps bound it; its least value on the opposite one. A
/// value row q has the derivative q_f + q_D·u, and the same follows.
/// Sources: Neumaier1990, § 2.3 and § 5.1; Collatz's bound for the spectral radius as in hypothesis (2) of newton_prove.
void shrink_to_faces(const CompiledSystem& system, const Sheet& sheet, const Preconditioner& p,
                     const std::vector<double>& widths, std::vector<Interval>& piece, NewtonWorkspace& w);

}  // namespace corank::certify
