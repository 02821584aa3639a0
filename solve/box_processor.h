// What happens to one box of the search: contraction, proof, slicing of proven sheets to the size asked for, or bisection.
//
// All that deletes, shrinks or certifies is a call into certify/; this file only decides what to try when.
#pragma once

#include <functional>
#include <vector>

#include "corank/certify/cover.h"
#include "corank/certify/domain.h"
#include "corank/certify/newton.h"
#include "corank/certify/partial.h"
#include "corank/certify/reduction.h"
#include "corank/solve/branching.h"
#include "corank/solve/preconditioner.h"

namespace corank::solve {

/// What all threads share, constant during a search.
struct Problem {
  /// `ended` tells, from any thread, that a limit or a stop has ended the search.
  Problem(const certify::Reduction& reduction, double sigma, std::function<bool()> ended);

  certify::CompiledSystem compiled;
  certify::RedundantEquations redundant;  ///< applies(): proofs speak of an independent subset of the equations (`partial`)
  certify::DomainTest domain;
  double rank_tolerance;  ///< pivots below count as zero where equations may be redundant
  BranchingRule branching;
  double sigma;
  std::function<bool()> ended;
};

/// A box of the result and, for an isolated solution, its sheet. The sides of the eliminated variables follow those of the others, as
/// certify::Reduction::lift takes them; the sheet and `free` know only the others.
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
  /// Adds x, unprocessed, to found().
  void leave(const certify::Interval* x) { add_unproven(x, certify::Verdict::pending); }
  int split_variable() const { return split_variable_; }

  std::vector<Found>& found() { return found_; }
  certify::Statistics& statistics() { return statistics_; }

 private:
  // Projections of every row until no variable loses more than a tenth of its width. False: empty.
  bool propagate(certify::Interval* x);
  // Propagation and interval Newton in turns. False: empty.
  bool contract(certify::Interval* x);
  // Is the proof about an independent subset of the equations only?
  bool is_partial(const certify::Sheet& sheet) const {
    return static_cast<int>(sheet.equations.size()) < problem_.compiled.equations();
  }
  // Does a piece of a sheet lie in the domain, and do the equations that its proof does not speak of hold within the tolerance? Cuts
  // the piece as finely as the bounds need, `depth` times at most.
  bool holds_on_parts(const certify::Sheet& sheet, const std::vector<int>& free, std::vector<certify::Interval> piece,
                      int depth);
  // The widest side that Newton leaves free, −1 where there is none.
  int widest_free(const certify::Interval* x);
  // If a sheet over x can be proven, of all equations (full) or of an independent subset (partial), adds its pieces to found() and
  // returns true.
  enum class Proof { full, partial };
  certify::Sheet prove(const certify::Interval* x);
  // Proves an independent subset and bounds the others over a box no narrower than σ: in a tiny box around a singular point any
  // equation looks redundant.
  certify::Sheet prove_partially(const certify::Interval* x);
  std::vector<int> free_variables(const certify::Sheet& sheet) const;
  bool certify(certify::Interval* x, Proof proof);
  // The pieces of a proven sheet that meet x, each no wider than σ.
  void slice(const certify::Sheet& sheet, const certify::Interval* x);
  // Shrinks a piece of a sheet and renews the eliminated variables' sides behind its own.
  void tighten(const certify::Preconditioner& p, std::vector<certify::Interval>& piece);
  // The eliminated variables' sides over x, behind it.
  void append_values(std::vector<certify::Interval>& sides) const;
  // For a box whose own sides need no cut: what to cut where an eliminated variable's side is wider than σ, −1 where none is.
  int choose_for_values(const certify::Interval* x) const;
  // Parts of a piece that is too wide, by a grid over its free variables.
  std::vector<std::vector<certify::Interval>> cut(const std::vector<certify::Interval>& piece,
                                                  const std::vector<int>& dependent, const std::vector<int>& free);
  // |∂a/∂f| on the piece, linearized, for each dependent and then each eliminated variable a (rows) and each free one f.
  std::vector<double> steepness_over(const std::vector<certify::Interval>& piece, const std::vector<int>& dependent,
                                     const std::vector<int>& free);
  void add_unproven(const certify::Interval* x, certify::Verdict verdict);
  void add(const certify::Sheet& sheet, const std::vector<int>& free, std::vector<certify::Interval> piece,
           certify::Location location);

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
