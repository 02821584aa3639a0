// What interval tests cannot prove, proven in exact arithmetic: degenerate isolated solutions, and the configurations where
// the kernel has dimension 2 or more, at which the kernel vector is a continuum.
#pragma once

#include <optional>

#include "corank/core/cover.h"
#include "corank/solve/search/box_labels.h"
#include "corank/solve/step/control.h"
#include "corank/solve/step/options.h"

namespace corank::solve {

/// Improves the cover that solve() returned. It stays a cover of the same solutions.
///
/// Dimension 0: for each point exact coordinates are guessed, from many digits (Ipopt, then Newton in MPFR), and verified
/// (certify::verify_exactly). An `isolated` point keeps its verdict and gets its exact point. A cluster of undecided boxes
/// that holds a verified point, and no other solution within its hull (certify::blow_up, each face without solution),
/// becomes one `exact` box.
///
/// Dimension ≥ 1, systems with kernel equations: near each cluster of undecided boxes the points where the kernel has
/// dimension 2 or more are sought, as solutions of the system with as many kernel vectors, and verified. What surrounds such
/// a point is searched again without a small box about it: the result is one undecided box that holds the point, named in
/// CoverBox::point, and proven boxes around it.
///
/// Systems with kernel equations: CoverBox::kernel_at_most bounds the kernel's dimension in each box (certify::KernelBound,
/// on parts of the box where it must); a proven box where it may be 2 or more, and that holds a known point where it is,
/// names that point, too.
///
/// What cannot be proven stays as it was, and so does what is left once the control has ended the run. Systems with a
/// tolerance, irrational coefficients or sines and cosines are left alone.
void prove_exactly(const Prepared& prepared, Cover& cover, Control& control);

/// The same within the limits of the options, of which this call is told alone.
void prove_exactly(const System& system, const Options& options, Cover& cover);

/// Fills cover.decimals: for every isolated or exact point of a set of dimension 0 decimals with so many digits after the
/// point, proven by certify::prove_zero, or from its exact coordinates. Points that are left once the control has ended the
/// run have none.
void prove_decimals(const Prepared& prepared, int digits, Cover& cover, Control& control);

/// What follows a search.
struct Settling {
  std::optional<Labelling> labelling{};  ///< nothing: boxes get no types
  int digits = 0;                        ///< of decimals, of a set of dimension 0; 0: none
  std::uint64_t processed_before = 0;    ///< boxes, to find out where to search
};

/// All that is said of the cover that solve() returned: prove_exactly(), label_types(), prove_decimals(). It knows no model,
/// whose algebra is for one thread alone: several threads may settle covers at once.
void settle(const Prepared& prepared, const Settling& settling, Cover& cover, Control& control);

}  // namespace corank::solve
