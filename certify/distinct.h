// When do two proven boxes hold the same solution?
#pragma once

#include "corank/certify/newton.h"

namespace corank::certify {

enum class Identity { same, different, unknown };

/// For two sheets without free variables (isolated solutions, each unique in its region and lying in its image).
/// Disjoint images ⇒ different. One's image inside the other's region ⇒ the same, by uniqueness there. Else nothing is proven.
/// Where the sheets' proofs rest on different rows, `same` is about a solution of all equations, if there is one.
Identity compare_isolated(const Sheet& a, const Sheet& b);

/// True where every solution in the box is the sheet's solution, so that the box adds nothing to the sheet's image: the box lies in
/// the sheet's region. For sheets without free variables.
bool holds_nothing_else(const Sheet& sheet, const Interval* box);

}  // namespace corank::certify
