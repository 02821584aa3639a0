// One step of an exact reduction (certify/reduction.h): what a checker needs to repeat it on its own.
#pragma once

#include "corank/core/exact_number.h"

namespace corank {

/// Either a variable was replaced everywhere by its value, or an equation by the sum of itself and a multiple of another.
/// Equations are named by their indices in the original system, and are meant as the steps before have left them.
struct ReductionStep {
  int variable = -1;        ///< the one that was eliminated; −1: none was, this is a sum
  int equation = -1;        ///< that defines the variable (−1: its domain is one number); of a sum: the one replaced
  int other = -1;           ///< of a sum: equation := equation + factor · other
  ExactNumber factor = {};  ///< rational

  static ReductionStep elimination(int variable, int equation) { return {variable, equation, -1, 0}; }
  static ReductionStep sum(int equation, int other, ExactNumber factor) { return {-1, equation, other, std::move(factor)}; }
  bool is_sum() const { return variable < 0; }
  friend bool operator==(const ReductionStep&, const ReductionStep&) = default;
};

}  // namespace corank
