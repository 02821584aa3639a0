#include "corank/core/threads.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <mutex>
#include <optional>

namespace corank {

void allow_threads(int threads) {
  static std::mutex mutex;
  static std::optional<tbb::global_control> control;  // kept: TBB says so on standard error where a limit falls and rises
  static int allowed = tbb::info::default_concurrency();
  const std::lock_guard lock(mutex);
  if (threads <= allowed) return;
  allowed = threads;
  control.reset();  // the least of several counts
  control.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
}

}  // namespace corank
