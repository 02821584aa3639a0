// What happens to one box of the search: contraction, proof, slicing of proven sheets to the size asked for, or bisection.
//
// All that deletes, shrinks or certifies is a call into certify/; this file only decides what to try when.
#pragma once

#include <functional>
#include <vector>

#include "corank/certify/cover.h"
#include "corank/certify/domain.h"
#include "corank/certify/newton.h"
#include "corank/solve/branching.h"
#include "corank/solve/preconditioner.h"

namespace corank::solve {

/// What all threads share, constant during a search.
struct Problem {
  /// `ended` tells, from any thread, that a limit or a stop has ended the search.
  Problem(const certify::System& system, double sigma, std::function<bool()> ended);

  certify::CompiledSystem compiled;
  certify::DomainTest domain;
  BranchingRule branching;
  double sigma;
  /// Over-determined with a coefficient tolerance: proofs speak of an independent subset of the equations (`partial`), the others
  /// must hold within `tolerance` · Σ|coefficients|.
  bool over_determined;
  double tolerance;
  std::vector<double> row_scale;  ///< Σ|coefficients| of each equation
  std::function<bool()> ended;
};

/// A box of the result and, for an isolated solution, its sheet.
struct Found {
  certify::CoverBox box;
  certify::Sheet sheet;
};

/// One per thread.
class BoxProcessor {
 public:
  enum class Outcome { done, split };

  explicit BoxProcessor(const Problem& problem);

  /// Treats the box x (changed in place). done: it is empty, or its solutions are in found(). split: it has shrunk to x and is to
  /// be bisected at split_variable(). Where the search ends while a sheet is being cut, the rest of it is found as pending boxes.
  Outcome process(certify::Interval* x);
  int split_variable() const { return split_variable_; }

  std::vector<Found>& found() { return found_; }
  certify::Statistics& statistics() { return statistics_; }

 private:
  // Projections of every row until no variable loses more than a tenth of its width. False: empty.
  bool propagate(certify::Interval* x);
  // Propagation and interval Newton in turns. False: empty.
  bool contract(certify::Interval* x);
  // Do the equations that the sheet's proof does not speak of hold within the tolerance on a piece of it? Cuts the piece as finely as
  // the bound needs, `depth` times at most.
  bool others_hold(const certify::Sheet& sheet, const std::vector<int>& free, std::vector<certify::Interval> piece,
                   int depth);
  // The widest side that Newton leaves free, −1 where there is none.
  int widest_free(const certify::Interval* x);
  // If a sheet over x can be proven, adds its pieces to found() and returns true.
  bool certify(certify::Interval* x);
  // The pieces of a proven sheet that meet x, each no wider than σ.
  void slice(const certify::Sheet& sheet, const certify::Interval* x);
  // Parts of a piece that is too wide, by a grid over its free variables.
  std::vector<std::vector<certify::Interval>> cut(const std::vector<certify::Interval>& piece,
                                                  const std::vector<int>& dependent, const std::vector<int>& free) const;
  void add(const certify::Sheet& sheet, const std::vector<int>& free, std::vector<certify::Interval> piece);

  const Problem& problem_;
  PreconditionerFactory preconditioners_;
  certify::NewtonWorkspace workspace_;
  std::vector<std::uint8_t> changed_, pending_rows_;
  std::vector<int> queue_;
  std::vector<Found> found_;
  certify::Statistics statistics_;
  int split_variable_ = -1;
  bool worth_proving_ = false;
};

}  // namespace corank::solve
