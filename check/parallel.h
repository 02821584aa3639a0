// Work of many parts by many threads.
#pragma once

#include <tbb/parallel_for.h>

#include <atomic>

#include "corank/check/stop.h"
#include "corank/core/nearest_rounding.h"
#include "corank/core/threads.h"

namespace corank::check {

/// Calls work(i) for each i < n. False: it was stopped (Stopped), and parts are missing.
template <class Work>
[[nodiscard]] bool parallel(ThreadArena& arena, std::size_t n, const Work& work) {
  std::atomic<bool> stopped = false;
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
      if (stopped) return;
      const NearestRounding nearest;
      try {
        work(i);
      } catch (const Stopped&) {
        stopped = true;
      }
    });
  });
  return !stopped;
}

}  // namespace corank::check
