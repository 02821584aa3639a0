// Directed rounding as a scope. All interval arithmetic of certify/ assumes that the rounding mode is upward; a thread that
// computes with intervals holds one UpwardRounding for the whole computation, so that no inner loop switches modes.
//
// The compiler does not know that arithmetic depends on the rounding mode (gcc ignores #pragma STDC FENV_ACCESS). Three things
// keep it honest: everything here is compiled with -frounding-math (no folding, no re-association of signs) and
// -ffp-contract=off; the constructor and destructor are barriers for memory; and whoever creates the guard reads its operands
// from memory and calls out-of-line functions.
#pragma once

#include <cfenv>

#include "corank/certify/check.h"

namespace corank::certify {

/// Sets upward rounding for the calling thread and restores the former mode at the end of the scope.
class UpwardRounding {
 public:
  UpwardRounding() : former_(std::fegetround()) {
    CORANK_CHECK(former_ >= 0 && std::fesetround(FE_UPWARD) == 0);
    asm volatile("" ::: "memory");
  }
  ~UpwardRounding() {
    asm volatile("" ::: "memory");
    std::fesetround(former_);
  }
  UpwardRounding(const UpwardRounding&) = delete;
  UpwardRounding& operator=(const UpwardRounding&) = delete;

  /// True where the calling thread rounds upward: the precondition of every interval operation.
  static bool active() { return std::fegetround() == FE_UPWARD; }

 private:
  int former_;
};

}  // namespace corank::certify
