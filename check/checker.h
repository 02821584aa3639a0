// The independent checker: does a cover's certificate prove what its verdicts say? Everything is computed anew from the
// system as given, in MPFI at 160 bits and in rational arithmetic; from certify/ it uses plain values only (System, Cover,
// Proof, ExactNumber).
//
// What is checked, by verdict; theorems in check/*.h:
//   regular, isolated, boundary   the box of the proof, see check/sheets.h
//   exact                         the exact point, see check/exact.h
//   undecided                     claims nothing, but with an exact point: that it is a configuration with a kernel of
//                                 dimension 2 or more, in the box
//   partial, pending              not checkable
// besides, CoverBox::kernel_at_most: the bound of the kernel's dimension, see check/kernel.h; the labels of types, see
// check/types.h; CoverBox::passage and side: whether the output can pass, see check/passage.h;
// and that the reduction is legal, isolated boxes are disjoint, points belong to boxes, boxes are sorted and in bounds.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "corank/core/cover.h"
#include "corank/core/ended.h"
#include "corank/core/singularity_types.h"

namespace corank::check {

struct Tally {
  std::size_t verified = 0, failed = 0, unchecked = 0;
  friend bool operator==(const Tally&, const Tally&) = default;
};

struct Failure {
  enum class Place { cover, box, point, exact_point, step };  ///< step: of the proof's script
  Place place = Place::cover;
  std::size_t index = 0;  ///< from 0
  std::string reason;
};

struct ProofTally {
  bool present = false, verified = false;
  /// The script is well-formed, and not all of it could be shown; but the cover has self-motions, next to which equations
  /// say little. Nothing is said against any box then, nor for completeness.
  bool open = false;
  std::uint64_t steps = 0;     ///< of the script
  std::uint64_t leaves = 0;    ///< boxes shown to hold no zero, or none outside a box of the cover
  std::uint64_t searched = 0;  ///< parts that took a bisection of the checker's own
};

struct Report {
  std::array<Tally, kVerdicts> boxes;
  Tally points;                          ///< entries of Cover::points, for sets of dimension 0
  std::size_t points_without_claim = 0;  ///< undecided ones, counted as unchecked
  Tally exact_points;
  ProofTally proof;
  std::vector<Failure> failures;  ///< in the order of places and indices
  std::size_t left_out = 0;       ///< boxes that are not of the sample
  bool interrupted = false;
  std::string stage;  ///< where it ended early: "the boxes", "the proof" …

  /// Nothing failed, and the check came to its end.
  bool consistent() const { return failures.empty() && !interrupted; }
  /// consistent(), and every claim is confirmed; but nothing is said of completeness. An undecided box without an exact
  /// point and a pending one claim nothing.
  bool verified() const;
  /// The same of the boxes that were looked at, all or a sample.
  bool confirmed() const;
  /// verified(), and that nothing is missing in the search domain is shown, too.
  bool complete() const;
};

/// Of a check that is about more than boxes.
struct Findings {
  std::vector<std::string> failures;
  bool interrupted = false;
  std::string stage;  ///< where it ended early
};

struct Progress {
  std::uint64_t boxes = 0, all_boxes = 0, steps = 0, all_steps = 0;
};

struct Options {
  int threads = 1;                                ///< 0: one for each core
  std::function<void(const Progress&)> progress;  ///< called now and then, from one thread at a time
  Ended ended;                                    ///< asked from all threads
  /// 0: all boxes; else this many, chosen at random, and completeness is not looked at. What takes little is checked of all:
  /// that boxes are in order and in bounds, exact points, points.
  std::size_t sample = 0;
  std::uint64_t seed = 0;  ///< of that choice; who wrote the file must not know it
};

/// Never throws for what a cover says. Throws std::invalid_argument where the system is not valid. `blocks`: of the
/// mechanism, whose ranks the labels of types speak of; without it no label is confirmed.
Report check(const System& system, const Cover& cover, const Options& options = {}, const VelocityBlocks* blocks = nullptr);

}  // namespace corank::check
