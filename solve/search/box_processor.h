// What happens to one box of the search: contraction, proof, or bisection; and later the cutting of proven sheets to the
// size asked for.
//
// All that deletes, shrinks or certifies is a call into certify/; this file only decides what to try when.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "corank/solve/cutting/slicer.h"
#include "corank/solve/step/local_solution.h"
#include "corank/solve/step/preconditioner.h"
#include "corank/solve/step/problem.h"
#include "corank/solve/step/propagation.h"
#include "corank/solve/store/shard.h"

namespace corank::solve {

/// One per thread.
class BoxProcessor {
 public:
  enum class Outcome { done, split, postponed, interrupted };

  /// What is found goes to the shard, and what is done to its script, where it has one.
  BoxProcessor(const Problem& problem, Shard& shard);
  BoxProcessor(const BoxProcessor&) = delete;  // the slicer refers to its siblings
  BoxProcessor& operator=(const BoxProcessor&) = delete;

  /// Treats the box x (changed in place), which has that share of the search domain. done: it is empty, or its solutions are
  /// in a sheet or a found box of the shard. split: it has shrunk to x and is to be bisected at split_variable().
  /// postponed: it is the shard's last. interrupted: the search ends, and nothing was made of the box as it was given.
  /// `postpone`, of the typical sizes: how small a box is before it may be postponed.
  Outcome process(std::span<Interval> x, double postpone, double share);
  /// Keeps a postponed box that was proven to hold a self-motion.
  void add_proven(const Postponed& box);
  /// Cuts a sheet into found pieces, or leaves it whole. False: the search ended meanwhile, some are pending.
  bool cut(const Proven& proven, bool whole);
  /// Makes a box that a limit has left a pending one, unless it is outside the domain.
  void leave(const Waiting& box);
  /// Adds x, which nothing could be proven of, to the found boxes: done; so is an x that turns out empty. But where settled
  /// sides are still wide and the search goes on, x shrinks and is to be bisected along them: split.
  Outcome give_up(std::span<Interval> x, Reason reason);
  int split_variable() const { return split_variable_; }
  /// The lower and the upper part of a box that is to be bisected, without nodes.
  std::array<Waiting, 2> halves(Waiting box) const;

 private:
  void find_settled(std::span<const Interval> x);
  // Problem::limits for these sides; the others may be as wide as they are.
  enum class Sides { open, settled };
  std::vector<double> limits(double share, Sides of) const;
  // Of these sides the one that is widest in typical sizes; −1: there is none.
  int widest_of(const std::vector<int>& sides, std::span<const Interval> x) const;
  // The widest of the sides that Newton leaves free and that are not settled; −1 where there is none.
  int widest_free(std::span<const Interval> x);
  // The largest ratio of a side that is not settled to its typical size.
  double relative_width(std::span<const Interval> x) const;
  // If a sheet over x can be proven, of all equations (full) or of an independent subset (partial), keeps it and returns
  // true.
  enum class Proof { full, partial };
  certify::Sheet prove(std::span<const Interval> x, int steps);
  // The same for what a sheet leaves: after prove(x), by its preconditioner.
  certify::Sheet prove_in_part(std::span<const Interval> x);
  // Proves an independent subset and bounds the others over a box no narrower than σ: in a tiny box around a singular point
  // any equation looks redundant.
  certify::Sheet prove_partially(std::span<const Interval> x);
  bool certify(std::span<Interval> x, Proof proof);
  // Is x wide, may it hold solutions outside the domain, and is such a box better divided (kAcrossShare)?
  bool reaches_beyond(std::span<const Interval> x) const;
  // A solution in x or next to it at which the Jacobian has not its full rank.
  std::optional<LocalSolution> degenerate_solution(std::span<const Interval> x, double share) const;
  std::vector<double> midpoint(std::span<const Interval> x) const;
  // Where strata are known: cuts a box at the faces of their tubes, and treats those inside. Nothing: x is none of these.
  std::optional<Outcome> process_on_strata(std::span<Interval> x, double postpone, double share);
  // Inside a tube a box is proven, or divided, the widest side first; below kTubeShare it is postponed.
  Outcome process_in_tube(std::span<Interval> x, int stratum, double postpone, double share);
  // The side that is widest in typical sizes, of those wider than this share; −1: none can be divided.
  int widest(std::span<const Interval> x, double share) const;
  int choose_split(std::span<const Interval> x, double share, std::optional<LocalSolution>& near);
  void add_unproven(std::span<const Interval> x, Verdict verdict, Reason reason = Reason::none);
  NodeId go_on_later() { return recorder_ ? recorder_->go_on_later() : NodeId{}; }
  Box copy_of(std::span<const Interval> x) const { return {x.begin(), x.begin() + problem_.compiled.variables()}; }

  const Problem& problem_;
  Shard& shard_;
  Recorder* const recorder_;  // the shard's script, where it has one
  PreconditionerFactory preconditioners_;
  certify::NewtonWorkspace workspace_;
  Contractor contractor_;
  Slicer slicer_;
  int split_variable_ = -1;
  std::optional<double> split_at_;  // nothing: off the side's middle
  std::vector<bool> settled_;       // BranchingRule::settled() of the box that is treated
  std::vector<int> dependent_;
};

}  // namespace corank::solve
