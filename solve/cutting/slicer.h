// From a proven sheet to boxes of the size asked for. Heuristic in where it cuts; what it says of a slice comes from
// certify/: each slice inherits the sheet's proof, which holds for every value of the free variables.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "corank/solve/cutting/cut_planner.h"
#include "corank/solve/step/preconditioner.h"
#include "corank/solve/step/problem.h"
#include "corank/solve/step/recorder.h"

namespace corank::solve {

/// A thread that cuts looks so rarely whether it is to end.
inline constexpr unsigned kPiecesBetweenChecks = 16;

/// One per thread.
class Slicer {
 public:
  /// Where given, the recorder keeps what becomes of the sheet.
  Slicer(const Problem& problem, PreconditionerFactory& preconditioners, certify::NewtonWorkspace& workspace,
         Recorder* recorder = nullptr)
      : problem_(problem), preconditioners_(preconditioners), workspace_(workspace), recorder_(recorder) {}

  /// Adds the slices of the sheet that meet x and the domain to `found`, each no wider than σ unless rounding keeps it so.
  /// Where the search ends meanwhile, the rest is added as pending boxes: false. `whole`: the sheet is not cut at all.
  bool slice(const certify::Sheet& sheet, std::span<const Interval> x, FoundList& found, bool whole = false) {
    left_some_ = false;
    slice(sheet, x, found, whole, true);
    return !left_some_;
  }

  /// Does a slice of the sheet lie in the domain, and do the equations that its proof does not speak of hold within the
  /// tolerance? Cuts the slice as finely as the bounds need, `depth` times at most. True is proven, on each of the parts.
  bool holds_on_parts(const certify::Sheet& sheet, const std::vector<int>& free, Box slice, int depth);

 private:
  void slice(const certify::Sheet& sheet, std::span<const Interval> x, FoundList& found, bool whole, bool rechartable);
  // Adds the box of a sheet that leaves it (certify::newton_prove_in_part).
  void add_part(const certify::Sheet& sheet, FoundList& found);
  // A slice: its sides and, behind them, the eliminated variables'; how often in a row a cut did not make it narrower; how
  // far Y·S was from I in the last step, on this slice or on the one that it was cut from.
  struct Slice {
    Box sides;
    double former_width = HUGE_VAL;
    int futile_cuts = 0;
    double spread = 0;
    int charts_tried = 0;
  };
  // A part of a slice, and what becomes of it: it goes on as a slice, is added as it is, or holds nothing that is wanted
  // here.
  struct CutSlice {
    enum class Fate { open, found, elsewhere };
    Box sides;
    Fate fate = Fate::open;
  };
  // What is the same for all slices of one sheet.
  struct Task {
    const certify::Sheet& sheet;
    std::span<const Interval> x;
    FoundList& found;
    std::vector<int> free;
    std::vector<int> cuttable;  // of these: parameters keep their whole domains
    std::shared_ptr<const Box> region;
    std::vector<double> sigma;  // CutPlanner::widened_sigma
    bool whole = false;
    bool rechartable = true;  // not yet in a chart that was chosen for σ: slices of one never change it again
    unsigned turns = 0;
    bool ended = false;
  };

  // Tightens the slice, adds it where it is small enough, else cuts it and goes on with the parts. `inherited` is the
  // preconditioner of the slice that this one was cut from.
  void descend(Task& task, Slice slice, const certify::Preconditioner& inherited);
  // Shrinks a slice, renews the eliminated variables' sides behind its own, and its spread. Returns the last step; p becomes
  // its preconditioner: the inherited one that it is, or `own`, made for the slice where the sheet has turned too much.
  certify::NewtonStep tighten(const Task& task, Slice& slice, const certify::Preconditioner*& p,
                              certify::Preconditioner& own);
  // Shrinks the free sides to where the solutions may lie in x, and the others with them. False: none does. By the slice's
  // own step, renewed with the preconditioner `own`, or, without one, by the slopes of the step on the slice that it was cut
  // from.
  bool trim(const Task& task, certify::NewtonStep& step, const certify::Preconditioner* own, Box& sides);
  // The same, and where the solutions lie with respect to the domain. Nothing: none in x, or none in the domain.
  std::optional<certify::Location> place(const Task& task, certify::NewtonStep& step, const certify::Preconditioner* own,
                                         Box& sides);
  // Cuts the slice there, along all free sides, and goes on with each part. The parts are tightened by the slice's step
  // first, where there is one: many are small enough then, and need no step of their own.
  void cut(Task& task, const Slice& slice, const certify::Preconditioner& p, std::optional<certify::NewtonStep> step,
           const std::vector<std::vector<double>>& places);
  // Tightens a part by the step on the slice that it was cut from, and finds its fate.
  void settle(const Task& task, certify::NewtonStep& step, CutSlice& part);
  // Widens the sides that are not free a little, where σ allows: who verifies the box has to come that close only.
  void leave_room(const Task& task, Box& slice) const;
  // The search chose free variables that prove well; others may need fewer boxes of size σ: their dependents, where there
  // are such.
  std::optional<std::vector<int>> better_chart(const Task& task, const Box& sides);
  // Proves the slice's solutions in x to be a sheet with these dependents, and slices that; false: that is not proven.
  bool slice_in_chart(Task& task, Box sides, const std::vector<int>& dependent);
  void add(Task& task, Box slice, certify::Location location);
  std::vector<double> sigma_for(const certify::Sheet& sheet, const certify::Preconditioner& p);
  // What a limit leaves of a slice.
  void leave_slice(Task& task, Box sides);
  // It is another box's business, or outside the domain.
  void leave_elsewhere() {
    if (recorder_) recorder_->leaf_elsewhere();
  }
  // What a limit leaves, unless it is outside the domain.
  void leave(FoundList& found, Box sides);

  const Problem& problem_;
  PreconditionerFactory& preconditioners_;
  certify::NewtonWorkspace& workspace_;
  Recorder* recorder_;
  Box met_;
  bool left_some_ = false;  // of the sheet, since the search has ended
  CutPlanner planner_{problem_};
};

}  // namespace corank::solve
