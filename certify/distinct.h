// When do two proofs speak of the same solution?
#pragma once

#include <span>

#include "corank/certify/newton.h"
#include "corank/certify/reduction.h"
#include "corank/certify/refinement.h"

namespace corank::certify {

enum class Identity { same, different, unknown };

/// For two sheets without free variables but parameters, which have their whole domains (isolated solutions, for each robot
/// unique in its region and lying in its image). Disjoint images ⇒ different. One's image inside the other's region ⇒ the
/// same, by uniqueness there. Else nothing is proven. Where the sheets' proofs rest on different rows, `same` is about a
/// solution of all equations, if there is one.
Identity compare_isolated(const Sheet& a, const Sheet& b);

/// True where every solution in the box is the sheet's solution, so that the box adds nothing to the sheet's image: the box
/// lies in the sheet's region. For sheets as above.
bool holds_nothing_else(const Sheet& sheet, std::span<const Interval> box);

/// True where a zero of the reduced system is the isolated solution whose proof has this region, given in all variables:
/// exactly one zero lies within the region's kept sides, so one that is proven to lie there is that. False also where zeros
/// of the reduced system need not be solutions, since its coefficients have a tolerance or an equation was dropped.
bool is_solution_of_region(const ProvenZero& zero, const Reduction& reduction, const std::vector<Interval>& region);

}  // namespace corank::certify
