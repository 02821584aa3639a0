// Counts what a search does and finds, and says when a limit ends it; tells who waits how far it is. Of all threads.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "corank/certify/distinct.h"
#include "corank/core/box_tree.h"
#include "corank/solve/step/control.h"
#include "corank/solve/step/options.h"
#include "corank/solve/store/journal.h"
#include "corank/solve/store/memory.h"
#include "corank/solve/store/shard.h"

namespace corank::solve {

/// Which isolated solutions have been found, as certify::compare_isolated sees it: what merge_isolated will remove or doubt
/// at the end does not count.
class DistinctSolutions {
 public:
  void add(const certify::Sheet& sheet) {
    if (!images_) images_.emplace(sheet.image.size());
    std::vector<std::size_t> close;  // all others are different
    images_->for_each_overlapping(sheet.image, [&](std::size_t k) { close.push_back(k); });
    std::ranges::sort(close);
    bool unclear = false;
    for (const std::size_t k : close) {
      switch (certify::compare_isolated(known_[k].sheet, sheet)) {
        case certify::Identity::same: return;
        case certify::Identity::different: break;
        case certify::Identity::unknown:
          unclear = true;
          if (!known_[k].unclear) --clear_;
          known_[k].unclear = true;
          break;
      }
    }
    known_.push_back({sheet, unclear});
    images_->add(known_.back().sheet.image);
    if (!unclear) ++clear_;
  }
  std::uint64_t count() const { return clear_; }

 private:
  struct Known {
    certify::Sheet sheet;
    bool unclear;
  };
  std::deque<Known> known_;  // they stay where they are
  std::optional<GrowingBoxTree> images_;
  std::uint64_t clear_ = 0;
};

class Tally {
 public:
  /// Ends after `most` processed boxes, which is no limit of the run; 0: no limit. `journal`, where given, says
  /// when the threads are to pause.
  Tally(const Prepared& prepared, Control& control, std::uint64_t most, Journal* journal = nullptr);
  ~Tally() { control_.keep(-kept_); }
  Tally(const Tally&) = delete;
  Tally& operator=(const Tally&) = delete;

  /// How much of a shard has been counted.
  struct Counted {
    std::size_t found = 0, sheets = 0, weighed = 0;
    std::uint64_t recorded = 0;  // bytes of the script
  };
  /// Counts what the shard has got since the last call: for the progress, and towards the limits.
  void count(const Shard& shard, Counted& counted);
  /// A box is about to be processed; false: there is to be none.
  bool count_box();
  void wait_for(std::uint64_t boxes) { waiting_ = boxes; }
  void one_more_waits() { waiting_.fetch_add(1, std::memory_order_relaxed); }
  void one_less_waits() { waiting_.fetch_sub(1, std::memory_order_relaxed); }
  void done_with(double share) { done_share_.fetch_add(share, std::memory_order_relaxed); }
  /// A thread begins; so many boxes wait in its list, `before` at the last call.
  void keep_thread() { keep(memory_.of_thread()); }
  void keep_waiting(std::size_t boxes, std::int64_t& before);

  bool ended();
  /// Has it ended by `most`, and not the run?
  bool turn_is_over() const {
    return most_ > 0 && processed_.load(std::memory_order_relaxed) >= most_ && !out_of_time() && !control_.search_ended();
  }
  /// The run ended a while ago: what is found and not yet a box becomes one without any more work.
  bool overdue(double seconds) const { return control_.overdue(seconds); }
  /// All threads are to stop between two boxes or sheets, until resume().
  bool pausing();
  void resume() { pausing_ = false; }
  /// No pause any more.
  void forget_journal() { journal_ = nullptr; }
  /// From now on sheets are cut. True: the search was long enough, and what it has found is to stay whole. What another
  /// limit has ended is cut all the same.
  bool begin_cutting();
  void report(bool last);
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  void count_sheets(const Shard& shard, Counted& counted);
  void weigh(const Shard& shard, Counted& counted);
  void end(Limit by);
  void keep(std::int64_t bytes);
  // Is there no more time than it takes to make a result of what is kept?
  bool out_of_time() const;

  const Options& options_;
  Control& control_;
  const std::uint64_t most_;
  Journal* journal_;
  const int parameters_;  // of the system
  std::atomic<bool> pausing_{false};
  MemoryEstimate memory_;
  const std::int64_t soon_found_;      // bytes of the pieces that threads cut before they look again, and of those in hand
  std::atomic<std::int64_t> kept_{0};  // bytes that this search has told the control of
  std::atomic<bool> ended_{false}, cutting_{false};
  std::atomic<std::uint64_t> processed_{0}, waiting_{0}, found_{0}, sheets_{0}, cut_{0};
  std::atomic<double> done_share_{0};
  std::array<std::atomic<std::uint64_t>, kVerdicts> verdicts_{};
  std::mutex solutions_mutex_;
  DistinctSolutions isolated_;
  std::uint64_t pieces_ = 0;  // proven boxes with free variables
  std::mutex progress_mutex_;
  double last_report_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace corank::solve
