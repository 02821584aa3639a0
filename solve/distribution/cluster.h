// A search whose parts run anywhere: work and what was found in it are bytes, and running a part is a pure function of them.
//
//   Coordinator c(to_bytes(prepare(system, options, control)));
//   while (!c.done())
//     for (const std::string& unit : c.take_units(idle workers)) c.add(UnitRunner(c.prepared_bytes()).run(unit, budget));
//   Cover cover = c.assemble(control);
//
// Units may be run in any order, more than once, and by any number of threads: the first answer counts, and the cover is
// solve()'s, to the last bit. Where σ was asked for, sheets are cut by whoever has found them, as long as
// their boxes are not too many for one answer. What a budget leaves of a unit comes back and is given out again, in smaller
// parts.
//
// Limits are the coordinator's business: it gives out no more boxes than may be processed, and takes no answer for which
// there is no memory. Once one has ended the search, what was not answered counts as not begun: `pending` in the cover, and
// waiting in the state, from which the search goes on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "corank/solve/distribution/pace.h"
#include "corank/solve/step/problem.h"
#include "corank/solve/store/journal.h"

namespace corank::solve {

/// What running one unit may take; 0: no limit. A sheet, or a unit of sheets to cut, is cut to the end, whatever the budget.
struct Budget {
  std::uint64_t boxes = 0;  ///< processed
  double seconds = 0;
  int threads = 1;  ///< 1 … kMostUnitThreads
  /// Boxes of sheets after which no other one is cut: of a long answer's memory nothing is free before it has come.
  std::size_t found = 100'000;
  /// By which the seconds are counted; default: the machine's steady clock. Called from any thread.
  std::function<double()> clock = {};
};
inline constexpr int kMostUnitThreads = 31;
/// How many numbers of shards are each unit's own: those of its search, then those of its cutting.
inline constexpr ShardNumber kNumbersOfUnit = 2 * (kMostUnitThreads + 1);

/// Runs units of one Coordinator. What they share is made once. For one thread.
class UnitRunner {
 public:
  /// This and run() throw ShardError where the bytes cannot be read, or are of another version.
  explicit UnitRunner(std::string_view prepared);
  std::string run(std::string_view unit, const Budget& budget = {});

 private:
  Prepared prepared_;
  Problem problem_;
};

class Coordinator {
 public:
  /// `prepared`: of to_bytes(). `from`: a state of the same search to go on from. `control`, where given: of the run, whose
  /// limits hold and which is told of boxes and memory; it outlives the coordinator. Throws ShardError.
  explicit Coordinator(std::string prepared, std::optional<std::string> from = {}, Control* control = nullptr);
  ~Coordinator();
  Coordinator(const Coordinator&) = delete;
  Coordinator& operator=(const Coordinator&) = delete;

  const std::string& prepared_bytes() const;
  /// What to ask take_units() for, where the workers have so many threads and a unit is to take so many seconds at most (but
  /// see Pace::next).
  /// time: of any clock, in seconds.
  Pace::Units next_units(std::size_t threads, double longest, double time);
  /// What can be done now and has not been given out, in up to so many units, each of so many boxes or more; but as long as
  /// something is under way, fewer wait for others. None, though done() is false: the units that are under way have to be
  /// added first. At the beginning there is one unit, which ends as soon as there are boxes enough for all.
  std::vector<std::string> take_units(std::size_t wanted, std::size_t fewest_boxes = 1);
  /// What UnitRunner::run() has returned. False: nothing is done, since that unit has been added before, or there is no
  /// memory for it. Throws ShardError where it is none of this search's. The boxes in it stay as they are until the search
  /// is done: in the bytes that `owner` keeps where they are, or else in a copy.
  bool add(std::string_view answer, std::shared_ptr<const void> owner = {});
  bool done() const;
  /// A limit of the control has ended the search before it was done: nothing more is given out. Answers to what is under way
  /// may still be added.
  bool ended();
  /// Of the search domain: the share that is done with.
  double share_done() const;
  /// For a checkpoint (solve::SearchState): units that are under way count as not begun.
  std::string state() const;
  /// Of a search that is done, or has ended. The coordinator is not to be used any more.
  Cover assemble(Control& control);

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

}  // namespace corank::solve
