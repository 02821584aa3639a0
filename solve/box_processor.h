// What happens to one box of the search: contraction, proof, or bisection; and later the cutting of proven sheets to the
// size asked for.
//
// All that deletes, shrinks or certifies is a call into certify/; this file only decides what to try when.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "corank/solve/local_solution.h"
#include "corank/solve/preconditioner.h"
#include "corank/solve/problem.h"
#include "corank/solve/propagation.h"
#include "corank/solve/recorder.h"
#include "corank/solve/slicer.h"

namespace corank::solve {

/// A sheet over a box of the search, to be cut when the search is done.
struct Proven {
  Box x;
  certify::Sheet sheet;
  NodeId node = 0;  ///< its script goes on there, where one is recorded
};

/// A small box that resists proof next to a solution at which the Jacobian has not its full rank.
struct Postponed {
  Box x;
  LocalSolution near;
  double share = 0;  ///< of the search domain
  NodeId node = 0;
  bool noisy = false;            ///< rounding makes what the equations say as uncertain as the box is wide
  certify::Sheet proof = {};     ///< of a self-motion, where one was found
  certify::Preconditioner step;  ///< of that proof
};

/// One per thread.
class BoxProcessor {
 public:
  enum class Outcome { done, split, postponed };

  /// Where given, the recorder keeps what is done.
  explicit BoxProcessor(const Problem& problem, Recorder* recorder = nullptr);
  BoxProcessor(const BoxProcessor&) = delete;  // the slicer refers to its siblings
  BoxProcessor& operator=(const BoxProcessor&) = delete;

  /// Treats the box x (changed in place). done: it is empty, or its solutions are in a sheet of proven(), or in found().
  /// split: it has shrunk to x and is to be bisected at split_variable(). postponed: it is the last of postponed(). `share`
  /// of the typical sizes: how small a box is before it may be postponed.
  Outcome process(std::span<Interval> x, double share);
  /// Keeps a postponed box that was proven to hold a self-motion.
  void add_proven(const Postponed& box);
  /// Cuts a sheet into found() pieces, or leaves it whole.
  void cut(const Proven& proven, bool whole);
  /// Adds x, unprocessed, to found().
  void leave(std::span<const Interval> x);
  /// Adds x, which nothing could be proven of, to found().
  void give_up(std::span<const Interval> x, Reason reason) {
    add_unproven(x, Verdict::undecided);
    found_.back().box.reason = reason;
  }
  int split_variable() const { return split_variable_; }

  std::vector<Found>& found() { return found_; }
  std::vector<Proven>& proven() { return proven_; }
  std::vector<Postponed>& postponed() { return postponed_; }
  Statistics& statistics() { return statistics_; }

 private:
  // Propagation and interval Newton in turns. False: empty.
  bool contract(std::span<Interval> x);
  // The widest side that Newton leaves free, −1 where there is none.
  int widest_free(std::span<const Interval> x);
  // If a sheet over x can be proven, of all equations (full) or of an independent subset (partial), keeps it and returns
  // true.
  enum class Proof { full, partial };
  certify::Sheet prove(std::span<const Interval> x);
  // Proves an independent subset and bounds the others over a box no narrower than σ: in a tiny box around a singular point
  // any equation looks redundant.
  certify::Sheet prove_partially(std::span<const Interval> x);
  bool certify(std::span<Interval> x, Proof proof);
  // A solution in x or next to it at which the Jacobian has not its full rank.
  std::optional<LocalSolution> degenerate_solution(std::span<const Interval> x, double share) const;
  bool is_noisy(const certify::NewtonStep& step, std::span<const Interval> x) const;
  std::vector<double> midpoint(std::span<const Interval> x) const;
  int choose_split(std::span<const Interval> x, double share, std::optional<LocalSolution>& near);
  void add_unproven(std::span<const Interval> x, Verdict verdict);

  const Problem& problem_;
  Recorder* const recorder_;
  PreconditionerFactory preconditioners_;
  certify::NewtonWorkspace workspace_;
  Slicer slicer_;
  Propagator propagator_;
  std::vector<double> widths_;
  std::vector<Proven> proven_;
  std::vector<Postponed> postponed_;
  std::vector<Found> found_;
  Statistics statistics_;
  int split_variable_ = -1;
  std::vector<int> dependent_;
  bool regular_ = false;        // the last Newton step divided by no interval with 0
  bool noisy_ = false;          // rounding made it as uncertain as the box is wide
  bool worth_proving_ = false;  // and was near a proof
};

}  // namespace corank::solve
