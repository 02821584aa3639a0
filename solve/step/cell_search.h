// The solutions over a cell of parameters: those over all of its values at once, by bisection in the other variables alone.
//
// A cell knows the sheets that are proven over it (certify/solution_count.h) and boxes, as wide as the cell in the
// parameters, in which other solutions may be. Parts of a cell start with what is known of the whole.
#pragma once

#include <optional>
#include <vector>

#include "corank/certify/solution_count.h"
#include "corank/solve/step/control.h"
#include "corank/solve/step/preconditioner.h"
#include "corank/solve/step/problem.h"
#include "corank/solve/step/propagation.h"

namespace corank::solve {

struct ParameterCell {
  Box sides;                           ///< of the parameters
  std::vector<certify::Sheet> sheets;  ///< every zero over the cell lies on one of them
  std::vector<Box> open;               ///< … or in one of these, in all variables of the reduced system
};

/// One per thread. Each call requires UpwardRounding::active().
class CellSearch {
 public:
  /// `parameters`: variables of the problem's reduced system, which has as many equations as other variables.
  CellSearch(const Problem& problem, std::vector<int> parameters);

  /// All solutions in the domain, nothing known of them.
  ParameterCell whole(const Box& sides, const Box& domain) const;
  /// What is known over a part of the cell, or over one value of the parameters in it.
  ParameterCell part(const ParameterCell& cell, const Box& sides);

  /// Proves, excludes and bisects the open boxes until those that are left are no wider than the solutions in them move over
  /// the cell, or than `share` of the typical sizes where they move more; at most `most` boxes, and none once the control
  /// has ended: what is left then stays open. False: it has ended.
  bool refine(ParameterCell& cell, double share, std::uint64_t most, Control& control);

  /// The sheets on which the solutions in the domain lie, one for every value in the cell: indices into cell.sheets. Nothing
  /// where boxes are open, where two sheets are not told apart, or one may leave the domain.
  std::optional<std::vector<std::size_t>> solutions(ParameterCell& cell);

  std::uint64_t processed() const { return processed_; }  ///< boxes, in all cells

 private:
  enum class Outcome { empty, proven, open };
  Outcome shrink(const ParameterCell& cell, Box& x, std::optional<certify::Sheet>& sheet);
  /// Of each variable: so wide it may stay where nothing is proven.
  std::vector<double> limits(const Box& x, double share);
  void put_in(const Box& sides, Box& x) const;

  const Problem& problem_;
  const std::vector<int> parameters_;
  std::vector<int> unknowns_;
  PreconditionerFactory preconditioners_;
  certify::NewtonWorkspace workspace_;
  Propagator propagator_;
  std::uint64_t processed_ = 0;
};

}  // namespace corank::solve
