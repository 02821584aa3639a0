// Where a piece of a sheet that is wider than σ is cut along its free sides, so that few pieces become narrow enough.
// Heuristic: pieces inherit the sheet's proof wherever they are cut.
#pragma once

#include <vector>

#include "corank/certify/newton.h"
#include "corank/solve/step/problem.h"

namespace corank::solve {

class CutPlanner {
 public:
  explicit CutPlanner(const Problem& problem) : problem_(problem) {}

  /// The number of equal parts along each free side that makes all sides narrower than `sigma` in the step's linearization,
  /// few in all.
  std::vector<int> parts(const certify::NewtonStep& step, const std::vector<int>& free, const Box& piece,
                         const std::vector<double>& sigma);
  /// The search's σ of each variable, or more where parameters within their tolerances move it farther: no cut makes such a
  /// side narrower.
  std::vector<double> widened_sigma(const certify::NewtonStep& step, const Box& piece);
  /// Where each free side is cut now, given what parts() has said of the piece: into no more parts at once than a linear
  /// picture is good for, and into two at least along one side.
  std::vector<std::vector<double>> places(const Box& piece, const std::vector<int>& free, std::vector<int> parts) const;

 private:
  // steepness_[a·k + f] = |∂a/∂f| in σ of a on the step's piece, linearized, of each dependent, then each eliminated
  // variable a that has a σ, with respect to the f-th of k free variables.
  void measure_steepness(const certify::NewtonStep& step, const std::vector<int>& free, const Box& piece,
                         const std::vector<double>& sigma);
  // Of the free sides: that with most parts, the widest of these.
  std::size_t longest(const Box& piece, const std::vector<int>& free, const std::vector<int>& parts) const;

  const Problem& problem_;
  std::vector<double> steepness_, gradient_;
  std::vector<Interval> slope_;
};

}  // namespace corank::solve
