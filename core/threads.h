// How many threads a piece of work may have.
#pragma once

#include <tbb/task_arena.h>

namespace corank {

/// `asked`, or one for each core where that is 0.
inline int threads_for(int asked) { return asked > 0 ? asked : tbb::this_task_arena::max_concurrency(); }

/// From now on TBB may use that many threads, even where the machine has fewer cores.
void allow_threads(int threads);

/// Work of TBB's by a number of threads, the caller's among them.
class ThreadArena {
 public:
  /// @param asked 0: one for each core
  explicit ThreadArena(int asked) : threads_(threads_for(asked)), arena_(threads_) { allow_threads(threads_); }

  int threads() const { return threads_; }
  template <class F>
  decltype(auto) execute(const F& f) {
    return arena_.execute(f);
  }

 private:
  int threads_;
  tbb::task_arena arena_;
};

}  // namespace corank
