// Is a degenerate solution the only one near by? Answered by a blow-up, for points that are known exactly.
//
// Let p be an exact zero of F and write x = p + t·u. Theorem: let G = T·F(p + t·u) with a regular matrix T, made by exact
// elimination so that as many rows as possible have no part linear in u; each row, divided by the highest power t^o that
// divides it, is a polynomial g_i(t, u). If for no variable j the face u_j = 1, |u_i| ≤ 1 has a common zero of all g_i with
// |t| ≤ r, then F has no zero x ≠ p with max |x_i − p_i| ≤ r. Proof: such an x is p + t·u with |t| = max |x_i − p_i| > 0 and
// some u_j = 1 (t negative where needed); F(x) = 0 gives T·F(x) = 0, and t ≠ 0 may be divided out. At t = 0 what is left are
// the linear parts and, of the rows that have none, the leading forms: at a double solution these exclude the directions in
// which the Jacobian is singular, where no interval test about p can.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/ended.h"
#include "corank/core/exact_point.h"
#include "corank/core/system.h"

namespace corank::certify {

/// The systems of the faces, in the variables u, t and, where p is not rational, p's algebraic number: if all are without
/// solution, p is the only zero of the system's equations within `radius`, a rational number. Nothing where the equations do
/// not hold at p in exact arithmetic, a coordinate is missing, the sign of a pivot cannot be decided, or `ended` is true
/// before.
std::optional<std::vector<System>> blow_up(const System& system, const ExactPoint& point, const ExactNumber& radius,
                                           const Ended& ended = {});

/// True where no solution in the box is another than the point, by its sole_within: the box lies in the cube of that radius
/// about it.
bool holds_nothing_else(const ExactPoint& point, const std::vector<Interval>& box);

}  // namespace corank::certify
