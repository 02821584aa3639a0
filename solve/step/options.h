// What a search is asked for, as a plain value that says itself whether it makes sense.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "corank/certify/reduction.h"
#include "corank/core/cover.h"
#include "corank/core/system.h"
#include "corank/solve/step/control.h"

namespace corank::solve {

/// An option that no search can follow: option() is its name among the Options, reason() what is asked of it.
class OptionError : public std::invalid_argument {
 public:
  OptionError(std::string option, std::string reason);
  const std::string& option() const { return option_; }
  const std::string& reason() const { return reason_; }

 private:
  std::string option_, reason_;
};

/// A σ with which no sheet is cut.
inline constexpr double kWhole = std::numeric_limits<double>::infinity();

struct Options {
  /// Largest edge that a proven box may have, in lengths and in the sines and cosines of angles; kernel vectors and
  /// auxiliary variables may be wider. Default: a share of the size of the set that is found (solve/step/sigma.h). σ says
  /// how finely proven sheets are cut, it does not steer the search, unless coefficients carry a tolerance. Boxes that stay
  /// wider are counted in Cover::wider_than_sigma. kWhole: the proven sheets stay whole.
  std::optional<double> sigma{};
  std::optional<double> sigma_length{}, sigma_angle{};  ///< take sigma's place, each for its kind
  /// Where no σ is asked for, sheets of surfaces and larger sets stay whole; curves are cut. solve::recut cuts them later.
  /// Boxes then need not hold a whole sheet: Problem::parts_of_sheets.
  bool surfaces_whole = false;
  double coarser = 1;           ///< the default of σ, multiplied
  int threads = 1;              ///< 0: one for each core; at most kMostThreads
  std::uint64_t max_boxes = 0;  ///< stop after this many processed boxes; 0: no limit
  std::uint64_t max_found = 0;  ///< stop when this many boxes are found, proven or undecided; 0: no limit
  /// Stop when this many proven boxes are found, 0: all. Isolated solutions count as distinct ones, as far as the boxes
  /// found so far tell them apart. A sheet that is being cut, and other threads, may add a few more: no proof is thrown
  /// away. What is not processed then is `pending`, as with the other limits. With one thread the result is always the same.
  std::uint64_t max_solutions = 0;
  double time_limit = 0;           ///< seconds; 0: no limit
  std::uint64_t memory_limit = 0;  ///< stop when what is found, and what is made of it, takes more bytes; 0: no limit
  /// Keep the script of the search (Cover::proof), so that a checker can replay why the cover is complete. Systems with a
  /// tolerance, and covers with self-motions, have none.
  bool proof = false;
  bool proof_of_parts = true;  ///< false: a cover that a limit left incomplete needs no script, and to make it takes time
  /// Where given: search these boxes, in all variables, instead of the whole domain; the cover is of their solutions.
  std::vector<Box> roots{};

  std::optional<double> asked_length() const { return sigma_length ? sigma_length : sigma; }
  std::optional<double> asked_angle() const { return sigma_angle ? sigma_angle : sigma; }
  bool leaves_whole() const { return surfaces_whole && !asked_length() && !asked_angle(); }
  /// May boxes of surfaces and larger sets hold parts of sheets? With σ those may that are no wider.
  bool allows_parts() const {
    return leaves_whole() ||
           (surfaces_whole && asked_length() && asked_angle() && std::min(*asked_length(), *asked_angle()) < kWhole);
  }
  /// Throws OptionError where a number is out of its range, whatever the system.
  void validate() const;
  /// The same, and where a σ is below smallest_sigma(system).
  void validate(const System& system) const;
};
inline constexpr int kMostThreads = 1024;

/// Those of the options that end a run; `stop`: Control::Limits::stop.
Control::Limits limits_of(const Options& options, const std::atomic<bool>* stop = nullptr);

/// The least σ that a search accepts: below it the rounding of doubles would keep boxes from becoming that narrow.
Sigma smallest_sigma(const System& system);

/// A question to the solver, made ready once for all that is done about it: searches, exact proofs, decimals.
struct Prepared {
  System system;
  certify::Reduction reduction;  ///< of the system; valid, if not the whole of it, where the control had ended before
  Options options;
};

/// Throws std::invalid_argument where the system is not valid (System::validate), OptionError where the options are not.
Prepared prepare(System system, const Options& options, Control& control);

}  // namespace corank::solve
