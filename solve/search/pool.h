// The threads of a search, each with a shard of what is found. What happens to a box does not depend on any other box, so
// threads only share the work, and what all shards hold together is the same for any number of them.
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

#include "corank/core/threads.h"
#include "corank/solve/search/box_processor.h"
#include "corank/solve/step/options.h"
#include "corank/solve/step/problem.h"
#include "corank/solve/store/shard.h"
#include "corank/solve/store/tally.h"

namespace corank::solve {

class Pool {
 public:
  /// Its shards get numbers above `last_shard`. prepared and tally have to outlive it.
  /// `like`, where given: a problem of the same question, which need not be made again.
  Pool(const Prepared& prepared, Tally& tally, ShardNumber last_shard = 0, const Problem* like = nullptr);
  /// One that goes on where these shards, which are its own now, were made.
  Pool(const Prepared& prepared, Tally& tally, std::vector<Shard> earlier);
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  const Problem& problem() const { return problem_; }
  int threads() const { return arena_.threads(); }
  /// To be called before sheets are cut.
  void set_sigma(const Sigma& sigma) { problem_.set_sigma(sigma); }
  /// f() where its parallel parts have the threads that the options allow.
  template <class F>
  void execute(const F& f) {
    arena_.execute(f);
  }

  /// Depth first, so that memory grows with the depth and the results. Once a limit ends the search, or the tally pauses,
  /// what is not processed goes to Shard::left.
  void search(const Work& work);
  bool ended() const { return tally_.ended(); }
  /// Keeps a postponed box that was proven to hold a self-motion.
  void add_proven(const Postponed& box);
  /// A postponed box that is not divided any further.
  void give_up(const Postponed& box, Reason reason);
  /// Cuts the sheets, those that other pools have found as well, to σ, into boxes of its own shards; what is left becomes
  /// `pending` boxes. Returns false where the tally pauses before all are cut: to be called again. Where a thread has found
  /// more than `most` boxes it begins no other sheet, which stays as it is.
  bool cut(const std::vector<Shard*>& shards, std::size_t most = std::numeric_limits<std::size_t>::max());

  /// Those that it was given, and its own.
  std::vector<Shard*> shards();
  /// The shards, each up to the first sheet that is not cut as it would have been, had nothing ended the search.
  std::vector<SearchView::ShardView> finished();
  /// Where the calling thread's shard ends now.
  SearchView::ShardView end_of_mine();
  /// Of the pool, which is not to be used any more.
  std::vector<Shard> take_shards();

 private:
  struct Worker {  // one per thread
    Worker(const Problem& problem, ShardNumber number, bool recorded) : shard(number, recorded), processor(problem, shard) {}
    Shard shard;
    BoxProcessor processor;
    Tally::Counted counted{};
    std::optional<Shard::Mark> finished{};  // before the first sheet that was not cut to its end
  };

  int variables() const { return problem_.compiled.variables(); }
  void count(Worker& worker) { tally_.count(worker.shard, worker.counted); }
  // Boxes that wait, the newest last.
  using WorkList = std::deque<Waiting>;
  // Adds the halves of the box at its processor's split_variable(), with nodes of their own.
  static void divide(Worker& worker, Waiting box, WorkList& list);
  void spawn(WorkList list, const Work& of);
  void work(WorkList list, const Work& of);

  const Prepared& prepared_;
  Tally& tally_;
  std::vector<Shard> earlier_;
  bool cutting_ = false, whole_ = false;
  Problem problem_;
  std::atomic<ShardNumber> numbers_;
  std::atomic<int> busy_{0};
  tbb::enumerable_thread_specific<Worker> workers_;
  ThreadArena arena_;
  tbb::task_group group_;
};

/// Takes one of their lists out of the shards: &Shard::postponed, or &Shard::left, newest first, as Pool::search takes them.
template <class T>
std::vector<T> take(const std::vector<Shard*>& shards, std::vector<T> Shard::*list) {
  std::vector<T> all;
  for (Shard* shard : shards) {
    std::move((shard->*list).begin(), (shard->*list).end(), std::back_inserter(all));
    (shard->*list).clear();
  }
  return all;
}

}  // namespace corank::solve
