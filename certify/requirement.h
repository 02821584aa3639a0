// Does a requirement (core/requirement.h) hold at every zero of a system in a box, or at none?
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "corank/certify/affine_form.h"
#include "corank/core/requirement.h"

namespace corank::certify {

/// Of each variable that a requirement names its form at the zeros, in the offsets that `form`'s own box is in.
using FormOfVariable = std::function<AffineForm(int variable)>;

/// satisfied (violated): at every zero at which the forms hold it is (is not). Requires UpwardRounding::active().
///
/// Theorem (kernel): let A_D be as many columns of A as it has rows, Y real, T = Y·A, E = I − T_D, and for a column t of T_F
/// let u ≥ s + |E|·u, s ≥ |t| and s > 0. Then |E|·u < u, so A_D is regular, and V with V_F = I, V_D = −X, X = A_D⁻¹A_F, is a
/// basis of ker A. Its column x = t + E·x is the limit of x ← t + E·x from 0, all of which are at most u; so x = t + E·t +
/// E·E·x with |x| ≤ u. With affine forms for T the first two terms are exact to first order, and the last one is of second
/// order. Of rows that are dependent some may be left out: the kernel is then larger, and a form that is
/// positive on it is positive on ker A; of groups nothing is said.
/// Theorem (form): let Q(q) = Vᵀ·diag(form)·V and P real. Q is positive definite where PᵀQP has T_ii > Σ_{j≠i} |T_ij| in
/// each row (Gershgorin; P is regular then, since PᵀQP is). Q is not where one T_ii < 0.
/// Theorem (groups): ker A is the line of V. For any unit vector e, with a = e·V_g and b = ‖V_g − e·a‖: ‖V_g‖ = √(a² + b²) ≥
/// a, and ‖V_g‖ − a = √(a² + b²) − a falls with a, so it is at most its value at the least a and the largest b.
Standing standing(const Requirement& requirement, const FormOfVariable& form, std::span<const Interval> offsets);
/// The same of all of them together.
Standing standing(const std::vector<Requirement>& requirements, const FormOfVariable& form,
                  std::span<const Interval> offsets);

/// Of two things that are both required.
Standing both(Standing a, Standing b);

}  // namespace corank::certify
