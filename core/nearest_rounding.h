// Rounding to nearest where other libraries compute, for provers and checker alike: no statement rests on it.
#pragma once

#include <cfenv>

namespace corank {

/// Rounding to nearest for a scope, whatever the caller computes with: what code expects that is not ours, MPFR's own small
/// double computations among it.
class NearestRounding {
 public:
  NearestRounding() : former_(std::fegetround()) { std::fesetround(FE_TONEAREST); }
  ~NearestRounding() { std::fesetround(former_); }
  NearestRounding(const NearestRounding&) = delete;
  NearestRounding& operator=(const NearestRounding&) = delete;

 private:
  int former_;
};

}  // namespace corank
