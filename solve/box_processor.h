// What happens to one box of the search: contraction, proof, slicing of proven sheets to the size asked for, or bisection.
//
// All that deletes, shrinks or certifies is a call into certify/; this file only decides what to try when.
#pragma once

#include <vector>

#include "corank/solve/preconditioner.h"
#include "corank/solve/problem.h"
#include "corank/solve/recorder.h"
#include "corank/solve/slicer.h"

namespace corank::solve {

/// One per thread.
class BoxProcessor {
 public:
  enum class Outcome { done, split };

  /// Where given, the recorder keeps what is done.
  explicit BoxProcessor(const Problem& problem, Recorder* recorder = nullptr);
  BoxProcessor(const BoxProcessor&) = delete;  // the slicer refers to its siblings
  BoxProcessor& operator=(const BoxProcessor&) = delete;

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
  // The widest side that Newton leaves free, −1 where there is none.
  int widest_free(const certify::Interval* x);
  // If a sheet over x can be proven, of all equations (full) or of an independent subset (partial), adds its pieces to found() and
  // returns true.
  enum class Proof { full, partial };
  certify::Sheet prove(const certify::Interval* x);
  // The dependent variables of a good chart where preconditioners_ was asked last.
  std::vector<int> chart_of_last() const;
  // Proves an independent subset and bounds the others over a box no narrower than σ: in a tiny box around a singular point any
  // equation looks redundant.
  certify::Sheet prove_partially(const certify::Interval* x);
  bool certify(certify::Interval* x, Proof proof);
  // For a box whose own sides need no cut: what to cut where an eliminated variable's side is wider than σ, −1 where none is.
  int choose_for_values(const certify::Interval* x) const;
  void add_unproven(const certify::Interval* x, certify::Verdict verdict);

  const Problem& problem_;
  Recorder* const recorder_;
  std::vector<certify::Interval> before_;  // for the recorder
  PreconditionerFactory preconditioners_;
  certify::NewtonWorkspace workspace_;
  Slicer slicer_;
  std::vector<std::uint8_t> changed_, pending_rows_;
  std::vector<int> queue_;
  std::vector<double> widths_;
  std::vector<Found> found_;
  certify::Statistics statistics_;
  int split_variable_ = -1;
  std::vector<int> dependent_;
  bool regular_ = false;        // the last Newton step divided by no interval with 0
  bool worth_proving_ = false;  // and was near a proof
};

}  // namespace corank::solve
