// The solutions of a system as one continuous function of some of its variables, proven cell by cell.
//
// Example: the configurations on a path for every robot within tolerances, as a function of the path's parameter and of the
// constants.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/newton.h"
#include "corank/core/cover.h"
#include "corank/solve/step/control.h"

namespace corank::analyze {

/// Of m equations in m + k variables, the function of k of them.
class SolutionFamily {
 public:
  using Values = std::vector<double>;
  /// A box of the free variables with all others' sides about it: exactly one solution for each of the free values, at
  /// which the Jacobian in the others is regular.
  using Cell = Box;

  SolutionFamily(const System& system, std::vector<int> free);

  const std::vector<int>& free() const { return free_; }

  /// Appends cells that together are the function over the box of the free variables that `over` has, none wider than is
  /// proven, about the solution that Newton's method finds from `near`. In each cell's image `keeps` is true. False: not
  /// proven; what was appended means nothing then. `effort`: cells that may be tried.
  ///
  /// Theorem: let each of two closed boxes A, B of free values that share a side have a continuous function of solutions
  /// with regular Jacobians, and let these agree at one point of the side. Then they agree on all of it, and are one such
  /// function on A ∪ B. Proof: the points of the side at which they agree are closed in it, and open, for about such a point
  /// the implicit function is unique; and the side is connected. ∎ So the function is put together from cells by the halves
  /// of each box that is bisected. The shared point's solution is proven in a box of its own, which lies in one cell of each
  /// half that holds the point: it is the one solution that either has there.
  bool cover(const Box& over, Values near, const std::function<bool(const Box& image)>& keeps, std::vector<Cell>& cells,
             int& effort, const solve::Control& control);

  /// For the free values in `at`: a box with exactly one solution for each, as narrow as doubles prove it, near `near`.
  std::optional<Box> solution(const Box& at, const Values& near);

  /// Newton's method in doubles from x, whose free values stay. False: it does not converge.
  bool approach(Values& x) const;

 private:
  bool cover(const Box& over, const Values& near, const Box& whole, const std::function<bool(const Box& image)>& keeps,
             std::vector<Cell>& cells, int& effort, const solve::Control& control);
  certify::Sheet prove(const Box& over, const Values& near);
  int widest(const Box& over, const Values& at, const Box& whole) const;

  System system_;
  certify::CompiledSystem compiled_;
  std::vector<int> free_, dependent_;
  certify::NewtonWorkspace workspace_;
};

/// Does one of the cells hold the box, so that its solution is the function's?
bool holds(std::span<const SolutionFamily::Cell> cells, const Box& solution);

}  // namespace corank::analyze
