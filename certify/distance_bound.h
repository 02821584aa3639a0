// Do bodies keep their distances (core/requirement.h) all over a box of a system's variables?
#pragma once

#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/core/cover.h"
#include "corank/core/requirement.h"

namespace corank::certify {

/// Theorem: a function is f(c) + s·(x − c) with slopes s over the box, an affine form in the offsets of the box from its
/// middle c; certify/distance.h does the rest.
class DistanceBound {
 public:
  DistanceBound(const System& system, const KeptDistances& distances);

  /// At every point of the box, which is bisected where need be. Requires UpwardRounding::active().
  bool holds(const Box& box, int halvings) const;

 private:
  bool holds_in_one(const Box& box) const;

  std::vector<DistanceTest> tests_;
  std::vector<int> arguments_;  // the variables that the functions depend on
  CompiledSystem compiled_;
};

}  // namespace corank::certify
