// Directed rounding as a scope. All interval arithmetic of certify/ assumes that the SSE unit rounds upward, keeps subnormal
// numbers and raises no traps; a thread that computes with intervals holds one UpwardRounding for the whole computation, so
// that no inner loop switches modes.
//
// The compiler does not know that arithmetic depends on the rounding mode (gcc ignores #pragma STDC FENV_ACCESS). Three
// things keep it honest: everything here is compiled with -frounding-math (no folding, no re-association of signs) and
// -ffp-contract=off; the constructor and destructor are barriers for memory; and whoever creates the guard reads its
// operands from memory and calls out-of-line functions.
#pragma once

#ifdef __FAST_MATH__
#error "corank's interval arithmetic needs exact IEEE semantics: compile without unsafe math optimizations"
#endif

#include <xmmintrin.h>

#include <cfenv>

#include "corank/core/check.h"

namespace corank {

/// Sets upward rounding for the calling thread, with subnormals (no flush to zero, which gcc turns on in programs linked for
/// unsafe math: 0 is no upper bound of a positive number) and all exceptions masked, and restores the former state at the
/// end of the scope.
class UpwardRounding {
 public:
  UpwardRounding() : former_(_mm_getcsr()), former_mode_(std::fegetround()) {
    CORANK_CHECK(former_mode_ >= 0 && std::fesetround(FE_UPWARD) == 0);
    _mm_setcsr(kState);
    asm volatile("" ::: "memory");
  }
  ~UpwardRounding() {
    asm volatile("" ::: "memory");
    std::fesetround(former_mode_);
    _mm_setcsr(former_);
  }
  UpwardRounding(const UpwardRounding&) = delete;
  UpwardRounding& operator=(const UpwardRounding&) = delete;

  /// True where the calling thread computes as UpwardRounding promises: the precondition of every interval operation.
  static bool active() { return (_mm_getcsr() & ~kFlags) == kState; }

 private:
  // MXCSR: exception flags 0x3f, denormals are zero 0x40, exception masks 0x1f80, rounding 0x6000 (up: 0x4000), flush to
  // zero 0x8000.
  static constexpr unsigned kFlags = 0x003f, kState = 0x1f80 | 0x4000;

  unsigned former_;
  int former_mode_;
};

}  // namespace corank
