// The parts of the set of requirements' limits.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

/// One condition of one requirement: what is at its limit is a part of the set of all that are.
struct RequirementPart {
  std::string name;  ///< the requirement's text; where it has several conditions, "… (2)"
  std::size_t requirement = 0, condition = 0;
  friend bool operator==(const RequirementPart&, const RequirementPart&) = default;
};
std::vector<RequirementPart> requirement_parts(const Mechanism& mechanism);

}  // namespace corank::symbolic
