// Searches that are too small for all threads, several at a time: one thread each, ahead of whoever takes what they find,
// one after the other. A search that turns out not to be small is given up, and is to be made again with all threads: what
// comes of it does not depend on which way it went.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "corank/study/search_steps.h"

namespace corank::study {

/// A search to be made early. What it refers to has to outlive it.
struct EarlyTask {
  std::optional<symbolic::SingularitySet> set;  ///< of the question
  const System& system;                         ///< system(question)
  std::optional<solve::Labelling> labelling;    ///< labelling(question, system)
  Options options;
  solve::Control::Limits limits;
  std::size_t kind = 0;  ///< of the same kind are alike: where one is not small, the others are not tried any more
  std::function<void(const Cover&)> then{};  ///< called with what is found, by the thread that has found it
};

class EarlySearches {
 public:
  /// A small search processes at most this many boxes and, as its control counts, takes at most this memory.
  static constexpr std::uint64_t kBoxes = 10'000, kBytes = std::uint64_t{64} << 20;

  /// Makes none where `threads` is 1.
  EarlySearches(std::vector<EarlyTask> tasks, int threads);
  ~EarlySearches();

  /// What task i has found, for describe(), each asked for once and in ascending order; waits for it. Nothing where the
  /// search is not small or like one that was not, where a limit or an interrupt has ended it, or where it has failed.
  std::optional<Cover> take(std::size_t i);

 private:
  void work();

  const std::vector<EarlyTask> tasks_;
  const std::size_t workers_;
  std::mutex mutex_;
  std::condition_variable changed_;
  // All below is the mutex's.
  std::size_t next_ = 0, asked_ = 0;  // the next task, and the one that is asked for
  bool over_ = false;
  std::vector<bool> done_, not_small_;  // of tasks; of kinds
  std::vector<std::optional<Cover>> found_;
  std::vector<std::thread> threads_;
};

}  // namespace corank::study
