// Is an exactly known point, degenerate or not, the only solution near by?
//
// Theorem (blow-up): let F(p) = 0 and G = T·F(p + t·u) with a regular matrix T, each row divided by the power t^o that it
// has as a factor. If for no variable j the face u_j = 1, |u_i| ≤ 1 has a common zero of the rows with |t| ≤ r, then F has
// no zero x ≠ p with max |x_i − p_i| ≤ r. Proof: such an x is p + t·u with |t| = max |x_i − p_i| > 0, |u_i| ≤ 1 and some u_j
// = 1 (t < 0 where needed). F(x) = 0 gives T·F(x) = 0, and t ≠ 0 may be divided out. ∎ T is made by exact elimination so
// that as many rows as possible have no part linear in u.
#pragma once

#include <string>

#include "corank/check/exact.h"

namespace corank::check {

/// Shows that no other solution of the system's equations has all its variables within `radius` of the point, whose
/// coordinates are all known and which has no fault. Returns what could not be shown, nothing where all was.
std::string check_sole(const System& system, const ExactCheck& point, double radius);

}  // namespace corank::check
