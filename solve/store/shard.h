// Parts of a search as plain values: boxes to search go in, what was found in them comes out, whoever runs it and where.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "corank/certify/newton.h"
#include "corank/core/cover.h"
#include "corank/solve/step/local_solution.h"
#include "corank/solve/step/problem.h"
#include "corank/solve/step/recorder.h"

namespace corank::solve {

/// A box that is to be searched, in the variables that are kept.
struct Waiting {
  Box x;
  double share = 0;  ///< of the search domain: 1 for all of it
  NodeId node{};     ///< its script begins there, where one is recorded
};

/// A sheet over a box of the search, to be cut when the search is done.
struct Proven {
  Box x;
  certify::Sheet sheet;
  NodeId node{};     ///< its script goes on there
  bool cut = false;  ///< its boxes are among those found
};

/// A small box that resists proof next to a solution at which the Jacobian has not its full rank.
struct Postponed {
  Waiting box;
  LocalSolution near;
  bool noisy = false;            ///< rounding makes what the equations say as uncertain as the box is wide
  certify::Sheet proof{};        ///< of a self-motion, where one was found
  certify::Preconditioner step;  ///< of that proof
};

/// What is to be done in one pass of a search.
struct Work {
  std::vector<Waiting> boxes;
  double postpone = 0;  ///< of the typical sizes: how small boxes are that may be postponed
  /// How the boxes are processed, which changes nothing of what becomes of them: the oldest first, by one thread, until so
  /// many wait, which are left; 0: depth first.
  std::uint64_t until = 0;
};

/// What one thread has made of its boxes. Every box that it was given, or has made of one by bisection, ends in one of the
/// lists, or holds no solution. Shards of one search differ in their numbers; what is in them depends on the boxes alone.
struct Shard {
  Shard(ShardNumber n, bool recorded) : number(n) {
    if (recorded) script.emplace(n);
  }
  Shard(Shard&&) noexcept = default;  // lists of shards grow
  Shard& operator=(Shard&&) noexcept = default;
  ShardNumber number;
  std::vector<Proven> sheets{};
  std::vector<Postponed> postponed{};
  FoundList found{};            ///< boxes of the cover: pieces of sheets, and what nothing could be proven of
  std::vector<Waiting> left{};  ///< what a limit has left unprocessed
  std::optional<Recorder> script{};
  Statistics statistics{};

  /// A moment in its life, between two boxes.
  struct Mark {
    std::size_t sheets = 0, found = 0;
    Recorder::Mark script{};
  };
  Mark mark() const { return {sheets.size(), found.size(), script ? script->mark() : Recorder::Mark{}}; }
};

/// The largest of their numbers; 0 where there are no shards.
inline ShardNumber last_number(const std::vector<Shard>& shards) {
  ShardNumber last = 0;
  for (const Shard& shard : shards) last = std::max(last, shard.number);
  return last;
}

/// A part of a search to be run somewhere, and what was found in it.
struct Unit {
  std::uint64_t id = 0;
  bool cut = false;         ///< the sheets are to be cut, to…
  std::uint64_t boxes = 0;  ///< else: processed at most, whatever the worker's budget; 0: no limit
  Work work{};              ///< else: is to be searched
  Sigma sigma{};
  std::vector<Proven> sheets{};
};
struct Answer {
  std::uint64_t id = 0;
  std::vector<Shard> shards;
};

}  // namespace corank::solve
