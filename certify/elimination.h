// Which equation defined a variable that was eliminated: what a checker needs to repeat an exact reduction on its own.
#pragma once

namespace corank::certify {

/// The variable was replaced by the value that an equation gives it, with what had been eliminated before put in.
struct Elimination {
  int variable = 0;
  int equation = -1;  ///< −1: the variable's domain is one number
  friend bool operator==(const Elimination&, const Elimination&) = default;
};

}  // namespace corank::certify
