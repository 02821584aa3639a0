// Bounds of variables that have no search domain, from the equations and inequalities alone.
//
// Theorem: let f = Σ_{i∈I} (α_i x_i² + B_i x_i) + R + C with α_i > 0 and R ≥ 0 over X. If x ∈ X and f(x) ≤ 0, completing the
// squares gives Σ α_i (x_i + B_i/(2 α_i))² ≤ S with S = Σ B_i²/(4 α_i) − C; so S ≥ 0, and |x_i + B_i/(2 α_i)| ≤ √(S/α_i).
// That bounds the end of a link whose other end is bounded: (x − a)² + (y − b)² = l². The other rows are for
// certify::project, whose theorem holds for sides without end, too.
#pragma once

#include <vector>

#include "corank/core/system.h"

namespace corank::certify {

/// Shrinks x, whose sides may be infinite, until little is gained; Variable::domain is not looked at. Returns false where no
/// point of x solves the system. Proves: every solution in the old x is in the new one. Sides that stay infinite may be
/// bounded all the same.
bool contract_unbounded(const System& system, std::vector<Interval>& x);

}  // namespace corank::certify
