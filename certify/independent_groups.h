// Equations that share nothing but parameters, such as the legs of a platform whose pose is given.
//
// The unknowns and the equations of F(p, x) = 0 fall apart into groups F_g(p, x_g) = 0. Theorem: for every p the zeros of
// F are all combinations of one zero of each group. So the product of one sheet of each group over P
// (certify/solution_count.h) is a sheet over P of F, all zeros of F over P lie on such products where each group's lie on
// its sheets, and two products differ where their sheets of one group do.
// Proof: F = 0 asks of x_g what F_g = 0 asks. For every p there is one zero of each group in its region, so one combination
// in the product of the regions; it lies in the product of the images, in the interior of the former. The Jacobian in x is
// block diagonal, with regular blocks.
#pragma once

#include <vector>

#include "corank/certify/newton.h"
#include "corank/core/system.h"

namespace corank::certify {

struct EquationGroup {
  std::vector<int> variables;  ///< of the system, sorted: the parameters and the group's own
  std::vector<int> equations;
};

/// As many groups as there are, each with as many equations as unknowns; a single one of all where that cannot be.
std::vector<EquationGroup> independent_groups(const System& system, const std::vector<int>& parameters);

/// The group's equations in its variables, with those implied equations and inequalities that are about these alone: the
/// system's other conditions are for the combinations.
System system_of(const System& system, const EquationGroup& group);

/// Of one sheet of each group, over the same parameters: the sheet of the whole system.
Sheet product(const CompiledSystem& system, const std::vector<EquationGroup>& groups,
              const std::vector<const Sheet*>& sheets);

}  // namespace corank::certify
