// Do two proven pieces of a solution set meet? Then they are parts of one connected piece.
#pragma once

#include <optional>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/newton.h"
#include "corank/core/cover.h"

namespace corank::certify {

/// For a system of m equations in n variables and the regions of its cover's `regular` boxes (Cover::regions). Parameters
/// are free over their whole domains in what is proven here, but keep one value while it is sought.
///
/// Theorem: let R and S be regions, which for every value of their n − m free variables hold exactly one solution. Each
/// holds a connected set of solutions, the graph over its free sides. A solution in R ∩ S is on both graphs, since each is
/// all that its region holds: so the two are one connected piece.
class MeetingTest {
 public:
  explicit MeetingTest(const System& system) : system_(system) {}

  /// A box that lies in the one given and holds a solution, as narrow as doubles prove it: newton_prove for fixed values
  /// of n − m variables, those whose sides have no width among them. Sought about the middle of `near`. Nothing: none was
  /// proven. Requires UpwardRounding::active().
  std::optional<Box> solution_in(const Box& box, const Box& near);
  /// The same as the sheet that was proven, whose image that box is: a point in the variables that are not dependent.
  std::optional<Sheet> sheet_in(const Box& box, const Box& near);
  /// Likewise a solution in both regions.
  std::optional<Sheet> common(const Box& a, const Box& b, const Box& near);

  /// A piece of its own about a solution near the box's middle, about so large in units of the system's scales: in its
  /// region there is for every value of n − m variables exactly one solution. It may join pieces whose regions end where
  /// they touch. Not proven where none was found.
  Sheet sheet_about(const Box& near, double radius);

 private:
  // A point of the solution set near c, heuristically; sides of no width keep their value. False: none was found within.
  bool project(const Box& within, std::vector<double>& c);
  // A piece over the free sides of x, where the others have no width; the dependent ones are those that the point c and
  // the weights choose.
  Sheet prove(std::vector<Interval> x, const std::vector<double>& c, const std::vector<double>& weights);

  CompiledSystem system_;
  NewtonWorkspace workspace_;
};

}  // namespace corank::certify
