// What a search will cost, from a short trial: how many boxes it processes and returns, its time, its memory, its file.
//
// The size of the search tree is estimated by many random descents at once: level by level all boxes are processed while
// they are few; of more, so many are chosen at random and count for the others. The expectation of the sum is the size of
// the tree (D. E. Knuth, Estimating the efficiency of backtrack programs, Math. Comp. 29, 1975; with one box per level it is
// his estimator). The sheets met on the way, each with its weight, are cut to σ until the trial's time is over.
#pragma once

#include <cstdint>

#include "corank/solve/step/control.h"
#include "corank/solve/step/options.h"

namespace corank::solve {

/// low ≤ likely ≤ high; the interval is of two standard errors of the trial, no proof.
struct CostRange {
  double low = 0, likely = 0, high = 0;
};

struct CostEstimate {
  CostRange processed, sheets, boxes;  ///< boxes: returned ones
  CostRange seconds;                   ///< elapsed, with the options' threads, each with a core of its own
  CostRange memory, file;              ///< bytes
  Sigma sigma;                         ///< for which it is; where none was asked for, the trial's own default
  /// The trial was as large as the first pass of the search: nothing but later passes, and times, is uncertain.
  bool whole_tree = false;
  double trial_seconds = 0;
  /// The share of processed boxes that were put off next to degenerate solutions: later passes may divide them, which is not
  /// estimated.
  double postponed = 0;
};

CostEstimate estimate(const Prepared& prepared, Control& control, double trial_seconds = 3, std::uint32_t seed = 1);

}  // namespace corank::solve
