// Where a piece of the solution set lies: inside the search domain and the inequalities, outside, or across.
#pragma once

#include <span>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/implied.h"
#include "corank/certify/newton.h"
#include "corank/core/system.h"

namespace corank::certify {

/// Intersects each side of x with its domain: no solution of the system, which lies in the domain, is lost. Sides that do
/// not meet stay as they are. Not for proven pieces, whose claim is about the whole box.
void clip_to_domain(const System& system, std::vector<Interval>& x);

enum class Location { inside, outside, across };

/// Is every point of x in the domain (implied sides need no check) and does it satisfy every inequality (inside), does
/// no point (outside), or is neither proven (across)?
class DomainTest {
 public:
  explicit DomainTest(const System& system);
  /// Encloses the exact domain of variable j.
  const Interval& side(std::size_t j) const { return domain_[j]; }
  /// With a tolerance > 0 (verdict `partial`) a piece counts as inside where it leaves the domain by no more than
  /// tolerance · max(1, |domain|), and an inequality by no more than the tolerance.
  Location locate(const CompiledSystem& compiled, std::span<const Interval> x, double tolerance = 0) const;
  /// The same of the zeros of the step's rows in x, a part of its box, whose free values are in the domain: an inequality
  /// that the box does not decide may be decided there (NewtonStep::value_at_zeros). So a free side may reach as far beyond
  /// an end as that end is rounded to become a double: the values there are not in the domain.
  Location locate_zeros(const NewtonStep& step, std::span<const Interval> x, double tolerance = 0) const;

 private:
  template <class Value>
  Location locate(const CompiledSystem& compiled, std::span<const Interval> x, double tolerance,
                  const std::vector<int>* dependent, Value value) const;

  std::vector<Interval> domain_;       // encloses the exact domain
  std::vector<double> lower_, upper_;  // inside the exact domain; infinite where that side is implied
};

/// The verdict `partial`: what is asked of the equations that a proof does not speak of. For systems with a coefficient
/// tolerance τ; applies() is false for all others.
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
