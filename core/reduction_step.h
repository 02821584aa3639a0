// One step of an exact reduction (certify/reduction.h): what a checker needs to repeat it on its own.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "corank/core/exact_number.h"
#include "corank/core/system.h"

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

/// A new equation Σ factor · product · equation, which serves to shrink boxes and is no part of the system. It may be named
/// in later steps of this kind: those of a system of m equations are numbered m, m + 1 …
struct ImpliedEquation {
  struct Multiple {
    int equation = 0;
    ExactNumber factor;           ///< rational
    std::vector<Factor> product;  ///< of powers of variables, sorted; none: 1
    friend bool operator==(const Multiple&, const Multiple&) = default;
  };
  std::vector<Multiple> parts;
  friend bool operator==(const ImpliedEquation&, const ImpliedEquation&) = default;
};

/// Equations are named by their indices in the original system, and are meant as the steps before have left them. Implied
/// equations come last.
using ReductionStep = std::variant<Elimination, SumOfEquations, ImpliedEquation>;

}  // namespace corank
