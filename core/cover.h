// Boxes, verdicts and covers: what a solver returns and a report reads.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "corank/core/exact_point.h"
#include "corank/core/interval.h"
#include "corank/core/proof.h"
#include "corank/core/reduction_step.h"
#include "corank/core/singularity_types.h"
#include "corank/core/system.h"

namespace corank {

/// A box X = X_1 × … × X_n.
using Box = std::vector<Interval>;

/// What is proven about a box; see the table in doc/theory.md.
enum class Verdict : std::uint8_t {
  /// The Jacobian has full rank at every solution in the box, and there is one; for every value of the free variables in
  /// the box exactly one, or, where the box's region is narrower (spans_free_sides), at most one.
  regular,
  isolated,   ///< exactly one solution in the box (no free variables)
  exact,      ///< the solution is known exactly and verified in exact arithmetic
  boundary,   ///< as regular, but the piece may leave the search domain or an inequality inside the box
  undecided,  ///< not excluded, nothing proven
  /// over-determined systems: as regular or isolated for a maximal independent subset of the equations; along that piece
  /// the other equations hold within Cover::tolerance, not exactly
  partial,
  pending,  ///< not processed: the cover is incomplete
};
inline constexpr int kVerdicts = 7;

/// The largest edge that a box of proven solutions may have: in lengths, in the model's unit, and in the sine and the cosine
/// of angles. Kernel vectors and auxiliary variables may be as wide as their proof is.
struct Sigma {
  double length = 0, angle = 0;
  double largest() const { return length > angle ? length : angle; }
  friend bool operator==(const Sigma&, const Sigma&) = default;
};

/// The tolerance within which the equations outside a `partial` proof hold, in coefficient tolerances: their values combine
/// the tolerances of several equations.
inline constexpr double kPartialTolerance = 10;

/// Its place where something is listed by verdicts.
constexpr std::size_t index(Verdict verdict) { return static_cast<std::size_t>(verdict); }
const char* to_string(Verdict verdict);

/// Why a box is `undecided`.
enum class Reason : std::uint8_t {
  none,              ///< it is not, or nobody knows
  degenerate_point,  ///< next to a solution at which the Jacobian has not its full rank, as far as doubles tell
  degenerate_set,    ///< the same along a curve or a larger set of such solutions
  tolerance,         ///< the coefficients' tolerance is too large, or redundant equations are not shown to hold
  precision,         ///< doubles divide it no further
  limit,             ///< a limit or an interrupt ended the search before it was divided further
};
inline constexpr int kReasons = 6;

const char* to_string(Reason reason);

/// A set of larger dimension than the count of equations says: linear relations with rational coefficients that hold on it
/// and make the others of the system's equations dependent (certify/self_motion.h).
struct SelfMotionRecord {
  int dimension = 0;
  std::vector<Polynomial> relations;  ///< in all variables, each = 0
};

struct CoverBox {
  Box box;
  Verdict verdict = Verdict::undecided;
  /// Indices of the free variables (regular, boundary, partial). In the list of a whole set that was solved in parts: none,
  /// unless there is a solution for every value of theirs.
  std::vector<int> free;
  int region = -1;  ///< index in Cover::regions: the box of the proof, −1 where there is none
  /// Index in Cover::exact_points: of an `exact` box its point; of an undecided one the point that explains it. −1: none.
  int point = -1;
  /// No solution in the box has a kernel of larger dimension (certify/kernel_bound.h); −1: the system has no kernel, or
  /// nobody asked.
  int kernel_at_most = -1;
  int motion = -1;               ///< index in Cover::self_motions: it is `regular` with the free variables of that set
  Reason reason = Reason::none;  ///< what was found where it was given up; no claim
  Passage passage = Passage::unproven;  ///< of a workspace boundary (certify/passage.h)
  /// In the coordinates of the outputs, where `passage` is proven: a unit vector from the boundary to the side on which the
  /// output stays (barrier), or to either one. Everywhere in the box its product with the boundary's normal, turned to that
  /// side, is positive.
  std::vector<double> side{};
  int part = -1;          ///< of a result that consists of parts: the index of the one it comes from
  TypeLabels types = {};  ///< of every solution in it (certify/type_bounds.h)
};

/// Does the region of its proof reach as far as the box along the free variables? Then there is a solution for every value
/// of theirs in the box; else at most one for each, and a sheet may leave the box through its other sides.
inline bool spans_free_sides(const CoverBox& box, const Box& region) {
  for (const int j : box.free)
    if (!region[j].contains(box.box[j])) return false;
  return true;
}

/// What is known of a box is about solutions in it; is there one at all?
inline bool holds_a_solution(const CoverBox& box) {
  switch (box.verdict) {
    case Verdict::regular:
    case Verdict::isolated:
    case Verdict::exact:
    case Verdict::boundary: return true;
    case Verdict::undecided: return box.point >= 0;
    case Verdict::partial:
    case Verdict::pending: break;
  }
  return false;
}

/// About the types of singularity that boxes are labelled with (core/singularity_types.h).
struct CoverTypes {
  TypeSet asked = 0;         ///< which labels were asked for; 0: none
  TypeSet of_set = 0;        ///< of these, the ones that make up the set: a box is typed where they are settled
  std::size_t left_out = 0;  ///< boxes in which no solution has the type that the set is of
  friend bool operator==(const CoverTypes&, const CoverTypes&) = default;
};

struct Statistics {
  std::uint64_t processed = 0;     ///< boxes taken from the work list (a proven one is cut to σ without further search)
  std::uint64_t newton_steps = 0;  ///< interval Newton contractions
  std::uint64_t proofs_tried = 0;  ///< existence tests begun
  double seconds_total = 0;        ///< elapsed
  double seconds_search = 0, seconds_certify = 0;  ///< its parts, averaged over the threads
};

/// A list of boxes whose union holds every solution of the system in its domain, where complete().
struct Cover {
  /// Sorted by their sides in the variables that were kept: lower end, upper end of the first, of the second …
  std::vector<CoverBox> boxes;
  /// For a set of dimension 0: the distinct solutions. An `isolated` one is exactly one solution, and no two entries hold
  /// the same one; an `undecided` one is the hull of a cluster of touching boxes that may hold any number, none included.
  std::vector<CoverBox> points;
  /// In all variables: a box of proof holds, for every value of its box's free variables in it, exactly one solution
  /// (regular, boundary), or exactly one solution (isolated). Boxes that were cut from one sheet share it. One that does
  /// not span its box's free sides lies in its box.
  std::vector<Box> regions;
  std::vector<ExactPoint> exact_points;
  std::vector<SelfMotionRecord> self_motions;
  CoverTypes types;
  /// The largest dimension, as samples show, of sets along which boxes stayed undecided (Reason::degenerate_set); 0: none is
  /// known to be larger than expected. No claim.
  int observed_dimension = 0;
  /// Of each point and variable a decimal that is wrong by less than a unit of its last digit; no decimals where nothing is
  /// proven. Empty where nobody asked.
  std::vector<std::vector<std::string>> decimals;
  /// How the system was reduced before the search; the sides of a box are of all variables.
  std::vector<ReductionStep> reduction;
  std::shared_ptr<const Proof> proof;  ///< of completeness, where it was asked for
  int dimension = 0;                   ///< of the set; for an over-determined system, the largest that a partial box shows
  Sigma sigma;
  double tolerance = 0;  ///< relative tolerance of the coefficients and of what `partial` says; 0: every equation is exact
  /// How many proven boxes have an edge longer than σ: ill-conditioned pieces that double arithmetic or the coefficients'
  /// tolerance keep so wide, and pieces that were still to be cut when a limit ended the search.
  std::size_t wider_than_sigma = 0;
  Statistics statistics;

  /// The number of boxes with each verdict: one pass over the boxes.
  std::array<std::size_t, kVerdicts> counts() const;
  std::size_t count(Verdict verdict) const;
  /// True where every point of the domain outside the boxes has been excluded: no box is `pending`.
  bool complete() const { return count(Verdict::pending) == 0; }
};

/// Is there a solution in the box for every value of its free variables (spans_free_sides)? Of boxes without a region those
/// say so that have free variables.
inline bool spans(const Cover& cover, const CoverBox& box) {
  return box.region >= 0 ? spans_free_sides(box, cover.regions[box.region]) : !box.free.empty();
}

}  // namespace corank
