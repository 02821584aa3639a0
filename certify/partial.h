// The verdict `partial`: what is asked of the equations that a proof does not speak of.
#pragma once

#include <span>
#include <vector>

#include "corank/certify/domain.h"
#include "corank/certify/newton.h"
#include "corank/core/system.h"

namespace corank::certify {

/// For systems with a coefficient tolerance τ; applies() is false for all others.
class RedundantEquations {
 public:
  explicit RedundantEquations(const System& system);
  bool applies() const { return tolerance_ > 0; }
  /// kPartialTolerance · τ, relative to the sum of an equation's |coefficients|; 0 where applies() is false.
  double tolerance() const { return tolerance_; }

  /// Do all zeros of the step's rows in x, a part of its box, lie in the domain and satisfy every other equation and every
  /// inequality, each within the tolerance? True proves it (NewtonStep::value_at_zeros); false proves nothing.
  bool hold(const DomainTest& domain, const NewtonStep& step, std::span<const Interval> x) const;

 private:
  double tolerance_ = 0;
  std::vector<double> bounds_;  // of each equation
};

}  // namespace corank::certify
