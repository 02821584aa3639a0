// Do configurations meet the requirements of their mechanism?
#pragma once

#include <vector>

#include "corank/core/cover.h"
#include "corank/core/requirement.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::analyze {

class Standings {
 public:
  /// `space`: the equations of the mechanism's configurations. Throws ModelError as symbolic::Requirements does.
  Standings(const symbolic::Mechanism& mechanism, const symbolic::TrigonometricSystem& space);

  /// satisfied: every solution in the box meets all of them; violated: none does. In the variables of the algebrized space.
  Standing of(const Box& box) const;
  std::vector<Standing> of(const std::vector<Box>& boxes) const;  ///< of each

 private:
  std::vector<Requirement> requirements_;
  std::vector<Polynomial> functions_;
};

}  // namespace corank::analyze
