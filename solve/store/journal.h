// Where a search keeps its state as it goes, so that a run that was ended, in whatever way, can go on.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "corank/solve/step/options.h"
#include "corank/solve/store/degeneracy.h"
#include "corank/solve/store/shard.h"

namespace corank::solve {

class PackedFound;

/// All that a search knows between two boxes. Whoever has it can go on with the search, and comes to the same cover.
struct SearchState {
  Work first;                 ///< what the search began with
  Work pass;                  ///< of the pass that is under way: the boxes that wait
  SelfMotions motions;        ///< those met in the passes before
  bool cutting = false;       ///< nothing waits; sheets are being cut to…
  Sigma sigma;                ///< where `cutting`
  std::vector<Shard> shards;  ///< what is finished; the sheets are those that are not cut yet
  double seconds = 0;         ///< that it took so far
};

/// The same of a search that goes on: nothing is copied.
struct SearchView {
  struct ShardView {
    const Shard* shard;
    std::optional<Shard::Mark> end{};     ///< what came later does not count
    const PackedFound* packed = nullptr;  ///< where given: its found boxes, of which the shard has none
  };
  const Work& first;
  const Work& pass;
  const SelfMotions& motions;
  bool cutting = false;
  Sigma sigma{};
  std::vector<ShardView> parts{};
  const std::vector<Postponed>* postponed = nullptr;  ///< where given: besides those of the parts
  double seconds = 0;
};

/// The moments at which a search offers its state.
enum class Moment : std::uint8_t {
  paused,     ///< the journal was due
  turn_over,  ///< solve_turn() has processed its boxes
  ended,      ///< a limit or an interrupt ends the search
  cut         ///< nothing is left to do
};

class Journal {
 public:
  virtual ~Journal() = default;
  /// True: the search is to pause soon, and to offer its state. From any thread, before each box; it does not take long.
  virtual bool due() = 0;
  /// No thread of the search works meanwhile.
  virtual void keep(const SearchView& state, Moment moment) = 0;
};

/// solve::solve with a journal, where one is given, and from a state on, which is of a search of the same system with the
/// same options but for limits and threads.
Cover solve_on(const Prepared& prepared, Control& control, Journal* journal, std::optional<SearchState> from = {});

/// A part of it: nothing, unless `most` boxes more were enough or the run has ended. The journal then has the state to go on
/// from. 0: no limit.
std::optional<Cover> solve_turn(const Prepared& prepared, Control& control, Journal& journal, std::uint64_t most,
                                std::optional<SearchState> from = {});

}  // namespace corank::solve
