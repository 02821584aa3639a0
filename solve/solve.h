// Branch and prune: encloses every solution of a system in boxes and asks certify/ for a proof of each.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "corank/certify/reduction.h"
#include "corank/core/cover.h"
#include "corank/core/system.h"
#include "corank/solve/control.h"

namespace corank::solve {

struct Progress {
  std::uint64_t processed = 0;  ///< boxes done
  std::uint64_t waiting = 0;    ///< boxes left
  double excluded = 0;          ///< share of the domain's volume that is done with, 0 … 1
  std::array<std::uint64_t, kVerdicts> verdicts{};
  double seconds = 0;
};

struct Options {
  /// Largest edge that a proven box may have, in lengths and in the sines and cosines of angles; kernel vectors and
  /// auxiliary variables may be wider. Default: a share of the size of the set that is found (solve/sigma.h). σ says how
  /// finely proven sheets are cut, it does not steer the search, unless coefficients carry a tolerance. Boxes that stay
  /// wider are counted in Cover::wider_than_sigma.
  std::optional<double> sigma_length, sigma_angle;
  void set_sigma(std::optional<double> both) { sigma_length = sigma_angle = both; }
  /// The default of σ, multiplied.
  double coarser = 1;
  int threads = 1;              ///< 0: one for each core
  std::uint64_t max_boxes = 0;  ///< stop after so many processed boxes; 0: no limit
  std::uint64_t max_found = 0;  ///< stop when so many boxes are found, proven or undecided; 0: no limit
  /// Stop when so many proven boxes are found; 0: all. Isolated solutions count as distinct ones, as far as the boxes found
  /// so far tell them apart. A sheet that is being cut, and other threads, may add a few more: no proof is thrown away. What
  /// is not processed then is `pending`, as with the other limits. With one thread the result is always the same.
  std::uint64_t max_solutions = 0;
  double time_limit = 0;  ///< seconds; 0: no limit
  std::uint64_t memory_limit =
      0;  ///< stop when the boxes found, and what is to be made of them, take more bytes; 0: no limit
  /// Keep the script of the search (Cover::proof), so that a checker can replay why the cover is complete. Systems with a
  /// tolerance, and covers with self-motions, have none.
  bool proof = false;
  /// Where given: search these boxes, in all variables, instead of the whole domain; the cover is of their solutions.
  std::vector<Box> roots;
  /// Called every `progress_interval` seconds or so, from one thread at a time.
  std::function<void(const Progress&)> progress;
  double progress_interval = 0.1;
  /// Where set by another thread or a signal handler, the search ends soon with a valid, incomplete cover.
  const std::atomic<bool>* stop = nullptr;
  /// Where given: it ends this search and whatever else it is given to; it takes the place of time_limit, memory_limit and
  /// stop, and max_boxes are those of this search alone.
  Control* control = nullptr;
  /// Where given: certify::reduce(system), which is then not made again.
  const certify::Reduction* reduction = nullptr;
};

/// certify::reduce(system), as long as the control lets it.
certify::Reduction reduced(const System& system, Control& control);

/// What the options say of when to end.
Control::Limits limits_of(const Options& options);

/// The coefficient tolerance (System::coefficient_tolerance) to take for a system as somebody printed it: 1e-6 where it has
/// more equations than variables, since rounded decimals make redundant equations inconsistent; else 0, exact. Not for
/// systems that symbolic/ derives from a mechanism: their redundancy is exact.
double printed_tolerance(const System& system);

/// The least σ that solve() accepts: below it the rounding of doubles would keep boxes from becoming that narrow.
Sigma smallest_sigma(const System& system);

/// The cover of the system's solution set in its domain. Never throws for a mathematical outcome; throws
/// std::invalid_argument where the system is not valid (System::validate) or a σ is not a positive number of at least
/// smallest_sigma(system). The result does not depend on `threads` unless a limit or a stop ends the search.
Cover solve(const System& system, const Options& options = {});

}  // namespace corank::solve
