// One step of an exact reduction (certify/reduction.h): what a checker needs to repeat it on its own.
#pragma once

#include <optional>
#include <variant>

#include "corank/core/exact_number.h"

namespace corank {

/// A variable is replaced everywhere by its value.
struct Elimination {
  int variable = 0;
  std::optional<int> equation;  ///< that defines it; none: its domain is one number
  friend bool operator==(const Elimination&, const Elimination&) = default;
};

/// equation := equation + factor · other.
struct SumOfEquations {
  int equation = 0, other = 0;
  ExactNumber factor;  ///< rational
  friend bool operator==(const SumOfEquations&, const SumOfEquations&) = default;
};

/// Equations are named by their indices in the original system, and are meant as the steps before have left them.
using ReductionStep = std::variant<Elimination, SumOfEquations>;

}  // namespace corank
