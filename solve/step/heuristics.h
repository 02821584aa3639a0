// The numbers by which a search decides what to try, in one place. What is proven does not depend on any of them; how many
// boxes a proof takes does. Those marked * were measured (bench/HISTORY.md).
#pragma once

#include <algorithm>
#include <cstddef>

#include "corank/core/system.h"

namespace corank::solve {

/// How the search divides its work between Newton steps on a box and bisections, by the kind of set. *
struct Heuristics {
  double gain = 0.3;          ///< repeat Newton while some variable loses this share of its width
  int repeats = 4;            ///< at most
  double proof_spread = 1.5;  ///< try a proof below this spread |I − Y·S|
  double sheet_spread = 1.5;  ///< below it what is in the box may soon be a sheet: divide along its free variables alone
  double free_share = 0.1;    ///< cut a free side unless it is already so much narrower than the others
  double worthwhile = 0.1;    ///< a projection that gains a smaller share is not followed up
  double wide = 0.2;          ///< of the typical sizes: what a Newton step says of narrower boxes misleads a bisection
};

/// For a (reduced) system. `tolerant`: its equations may be redundant, and its solutions of larger dimension. Each division
/// of a surface makes many boxes, most where it has a kernel vector.
inline Heuristics heuristics_for(const System& system, bool tolerant) {
  const std::size_t dimension = system.variables.size() - std::min(system.variables.size(), system.equations.size());
  const bool singular =
      std::ranges::any_of(system.variables, [](const Variable& v) { return v.kind == VariableKind::kernel; });
  if (dimension == 0) return tolerant || singular ? Heuristics{} : Heuristics{.gain = 0.07, .repeats = 8, .worthwhile = 0.4};
  if (dimension == 1) return singular ? Heuristics{.gain = 0.1} : Heuristics{};
  if (!singular) return {.proof_spread = 2, .free_share = 0.4};
  return {.gain = 0.02, .repeats = 20, .proof_spread = 2, .sheet_spread = 3, .free_share = 0.5, .wide = 0.03};
}
/// For the solutions over cells of parameters.
inline constexpr Heuristics kForCells{.proof_spread = 2};

// Shares and sizes without another word are of typical sizes (TypicalSizes).

// Projections and Newton steps (propagation.h)
inline constexpr std::size_t kTurns = 8;  ///< of all rows, at most
inline constexpr int kDomainRuns = 8;     ///< of projections over the search domain
/// Of a side: what rounding alone makes as wide is divided in vain. Sides below kNarrow of the widest one do not count.
inline constexpr double kNoise = 0.5, kRegularNoise = 8, kNarrow = 1e-3;
/// Pivots below this share of a row's largest entry, each times its variable's scale, count as zero: as a rule; near a
/// solution of redundant equations; where their coefficients are rounded.
inline constexpr double kRankTolerance = 1e-9, kRedundantRankTolerance = 1e-7, kRoundedRankTolerance = 1e-4;
inline constexpr int kGaussNewtonSteps = 8;  ///< to where the rank of redundant equations shows
inline constexpr double kChartGain = 1.05;   ///< of a proof's volume: an exchange of free variables costs an elimination
inline constexpr int kMostExchanges = 16;
/// Of ε-inflation, where what a proof leaves may be a part of a sheet, which takes less work. Two are too few where a side
/// is as narrow as rounding: a set along which nothing is proven has no end. *
inline constexpr int kProofSteps = 8, kProofStepsBeforeParts = 4;
/// Wider boxes that may leave the domain are divided, where sheets are not cut: of a `boundary` box no solution in the
/// domain is known.
inline constexpr double kAcrossShare = 1.0 / 2;
// A solution in a box that a sheet leaves (box_about_solution)
inline constexpr int kMostFreeOfPoints = 8;
inline constexpr int kPointTries = 4;            ///< of Newton's method
inline constexpr int kPointShifts = 12;          ///< of the free variables, towards values whose solution is in the box
inline constexpr double kPointRoom = 1.0 / 512;  ///< of a side: between the solution and the side's ends
inline constexpr double kPointMiss = 1;          ///< of half a side: from farther outside no further try leads into it

/// A parameter never becomes narrower, so beside this its domain counts as narrow.
inline constexpr double kParameterSize = 1e150;
/// Boxes are not bisected below this share of what parameters change (Problem::tolerance_width).
inline constexpr double kToleranceShare = 1, kWidestTolerance = 0.02;

// Bisection (branching.h)
/// Off-centre, because mechanisms put solutions on planes of symmetry, and a face through a solution doubles its boxes.
inline constexpr double kBisectionPoint = 0.47;
inline constexpr double kLeastSmear = 1e-6;   ///< a variable that no equation holds has its turn, too
inline constexpr double kAloneWeight = 1000;  ///< of a variable with an equation of its own: before all others *
/// An equation alone has a sheet where a derivative varies by less than this share of its least magnitude.
inline constexpr double kSettledShare = 0.5;
/// A kernel vector of this many unknowns or more waits for the configuration. *
inline constexpr int kManyUnknowns = 6;
inline constexpr double kLateWeight = 0.01, kLatePatience = 100;

// Small boxes that resist proof (box_processor.h) *
/// They wait until the others are done, first of this size, then of the next one.
inline constexpr double kFirstShare = 1.0 / 20, kNextShare = 1.0 / 4;
inline constexpr double kOpenShare = 1.0 / 8;  ///< of that size: how much smaller other unproven boxes get
inline constexpr double kRankShare = 1;  ///< of a box's size: singular values below make its solution count as degenerate
inline constexpr double kReach = 8;      ///< of a box's size: how far from it a degenerate solution is looked for
/// Of that size: what is regular and not proven in such a box of a surface may be next to a degenerate solution. *
inline constexpr double kRegularShare = 1.0 / 4;
inline constexpr double kTiny = 1e-6;  ///< what is regular and yet not proven in such a box is next to a degenerate solution
inline constexpr double kFinestShare = 1e-13;  ///< doubles resolve little more
inline constexpr double kNoisySize = 2e-3;     ///< in larger boxes it is the choice of Y that makes noise
inline constexpr double kPartialShare = 0.05;  ///< the width of a box for which nobody says a σ
inline constexpr int kPartialDepth = 8;        ///< halvings of a piece on which redundant equations are bounded
inline constexpr int kLocalSteps = 40;         ///< of Gauss and Newton: a double solution is approached by halves
inline constexpr double kStill = 1e-11;        ///< a shorter step ends them

// Sets of degenerate solutions (degeneracy.h); sizes of boxes
inline constexpr double kPointShare = 1e-7, kOtherShare = 1.0 / 400;  ///< the last of the sizes
inline constexpr double kSetShare = 1.0 / 60;                         ///< the last along a set of degenerate solutions
inline constexpr double kIsolatedHull = 8;          ///< in box sizes: boxes around one point hardly reach farther
inline constexpr double kWideExtent = 0.25;         ///< reaches no cluster around one point
inline constexpr std::size_t kProbes = 8;           ///< of a cluster
inline constexpr int kDirections = 3;               ///< of a probe
inline constexpr double kProbeStep = 0.5;           ///< in box sizes of the first level
inline constexpr double kCloseShare = 1e-4;         ///< how near to a possible solution every equation's zero is
inline constexpr double kSolutionTolerance = 1e-6;  ///< of singular values, at the solutions themselves
inline constexpr double kDoublesEnd = 1e-11;
inline constexpr double kMotionRankTolerance = 1e-6;
inline constexpr int kMotionAttempts = 4;           ///< in a cluster, without success
inline constexpr std::size_t kManyAlongASet = 400;  ///< dividing them makes too many
/// More boxes are too many, whatever they are along, once there are kGrowth times as many as when they were four times as
/// large: around points their number hardly grows, along a curve by four.
inline constexpr std::size_t kTooManyBoxes = 30'000, kGrowth = 2;

// Samples of a self-motion (self_motion_search.h). Doubles find solutions at which the rank drops to a few digits only. What
// is read off is verified exactly: it may be wrong.
inline constexpr double kSampleTolerance = 1e-7;                ///< of singular values
inline constexpr double kSampleStep = 0.15, kShortStep = 0.03;  ///< between samples; for directions
inline constexpr int kSampleBits = 128;                         ///< of the arithmetic that makes samples precise
inline constexpr double kNullTolerance = 1e-10, kRelationTolerance = 1e-9;
inline constexpr double kDirectionShare = 0.15;  ///< of what the set's curvature and the samples' errors make of a direction
inline constexpr std::size_t kDirectionsEach = 4, kDimensionSamples = 3;  ///< for each dimension of the kernel; of the set

// Sets of degenerate solutions that are known before a search (strata.h, stratum.h) *
inline constexpr int kFirstStarts = 12, kStarts = 48;  ///< if none of the first ones leads to such a set, there are no more
inline constexpr double kTube = 0.2;                   ///< half the width of a tube
inline constexpr double kTubeShare = 1.0 / 10;         ///< boxes inside are divided to this size only
inline constexpr double kThinSlab = 1.0 / 16;          ///< of that: thinner slabs are not cut off at a face

// Cutting of sheets (slicer.h, cut_planner.h); widths of σ *
inline constexpr int kTightenings = 2, kPointTightenings = 20;  ///< an isolated solution: until its box stops shrinking
/// A piece may be so much wider than what parameters move: its solutions for one robot are that much narrower.
inline constexpr double kToleranceRoom = 2;
inline constexpr double kNearSigma = 1.2;    ///< a wider piece is cut anyway, however well it is tightened
inline constexpr double kStaleSpread = 0.1;  ///< |I − Y·S| beyond which a part gets its own Y
inline constexpr double kRoom = 1.0 / 128, kLeastRoom = 4e-16;  ///< of a side, at each end; of its magnitude
/// Wider boxes of a curve are not merged. A narrower piece gets a step of its own, after which it may be such a fragment.
inline constexpr double kFragment = 0.85, kPossibleFragment = 0.92;
inline constexpr double kTrimShare = 0.9;     ///< of a free side: if one gets that narrow, the others get narrower
inline constexpr double kFutileShare = 0.95;  ///< of its width: a cut that leaves more is futile
inline constexpr int kFutileCuts = 10;        ///< in a row
inline constexpr double kGainOfAChart = 1.2;  ///< another chart has seams with this one
inline constexpr double kPartsForAChart = 4;  ///< a piece to be cut into fewer stays in its chart
inline constexpr int kMostChartsTried = 6;
inline constexpr double kNoSigma = 1e6;              ///< of the typical size, where a variable has no σ: never free
inline constexpr int kBoundaryDepth = 2;             ///< halvings of a piece that may leave the domain
inline constexpr std::size_t kMostHalvedSides = 12;  ///< at once: 4,096 parts
inline constexpr double kCutMargin = 0.98;           ///< aim a little below σ: the linearization is not exact
inline constexpr int kMostSlabs = 3;                 ///< more parts than that: halve, and look again
inline constexpr int kMostPartsAtOnce = 81;          ///< of a piece with many free sides: the other sides wait

// Cells of parameters (cell_search.h)
inline constexpr double kFollow = 2.5;         ///< of how far solutions move: a narrower side is not worth bisecting
inline constexpr double kLeastMovement = 0.5;  ///< of what moves most: what hardly moves is bisected in vain
inline constexpr double kFinestCell = 1e-8;

}  // namespace corank::solve
