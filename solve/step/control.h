// What may end a run before its end, and where the run is: one value for all that is done for one result, passed down
// through its stages.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "corank/core/cover.h"

namespace corank::solve {

/// What is being done, in its order.
enum class Stage : std::uint8_t {
  model,
  reduction,
  search,
  merging,
  points,
  exact,
  kernel,
  decimals,
  writing,
  figures,
  page
};
/// "reduction", "exact points" … for people.
const char* to_string(Stage stage);

/// What ended a run early. Time and interrupt end every stage; the others end searches only.
enum class Limit : std::uint8_t { time, interrupt, boxes, found, solutions, memory };
/// "the time limit", "an interrupt" …
const char* to_string(Limit limit);

struct Ending {
  Limit by;
  Stage stage;
  friend bool operator==(const Ending&, const Ending&) = default;
};
/// "the time limit, in the stage exact points".
std::string to_string(const Ending& ending);

/// The bytes that a cover takes, with what is made of its boxes later.
std::uint64_t bytes_of(const Cover& cover, std::uint64_t later_bytes);

/// The bytes that writing takes for a side of a box, beyond those of the cover: in a result file, or on a page with its
/// pictures as well.
inline constexpr std::uint64_t kFileBytes = 17, kPageBytes = 64;

/// Of a search.
struct SearchProgress {
  std::uint64_t processed = 0;  ///< boxes done
  std::uint64_t waiting = 0;    ///< boxes left
  double excluded = 0;          ///< share of the domain's volume that is done with, 0 … 1
  std::array<std::uint64_t, kVerdicts> verdicts{};
  double seconds = 0;
};

class Control {
 public:
  struct Limits {
    double time = 0;           ///< seconds from the control's construction on; 0: no limit
    std::uint64_t boxes = 0;   ///< processed in all searches together; 0: no limit
    std::uint64_t memory = 0;  ///< bytes, as keep() counts them; 0: no limit
    /// Where another thread or a signal handler sets it, the run ends.
    const std::atomic<bool>* stop = nullptr;
    /// Seconds since any moment; called from any thread. Default: the machine's steady clock.
    std::function<double()> clock = {};
    std::uint64_t later_bytes = kFileBytes;  ///< what later stages take for each side of a box
    bool leaves_memory = false;              ///< the process ends with the run: a search that was ended early is not freed
  };
  struct Progress {
    Stage stage;
    std::uint64_t done, all;  ///< of what the stage treats; all = 0: it does not say
  };

  Control() : Control(Limits{}) {}
  explicit Control(Limits limits);
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  const Limits& limits() const { return limits_; }
  /// Every stage ends soon once this is true, with a valid result; it stays true.
  bool ended() const;
  /// Until the limit of time; infinite where there is none.
  double seconds_left() const;
  /// Has the run been over for this long? Until then, what was found may still become a result.
  bool overdue(double seconds = kGrace) const;
  static constexpr double kGrace = 0.2;
  /// The same as ended() for a search, which also ends where it has used up boxes or memory.
  bool search_ended() const;
  /// A box is about to be processed; false: there is to be none.
  bool count_box();
  void count_boxes(std::uint64_t boxes) { boxes_ += boxes; }
  bool has_counted() const { return boxes_ > 0; }
  /// How many may still be processed, where there is a limit.
  std::uint64_t boxes_left() const { return limits_.boxes - std::min(limits_.boxes, boxes_.load()); }
  /// What is left of the limits, and at most these seconds and boxes, 0: any number. For a search under a
  /// control of its own, whose end is none of the run's.
  Limits rest(double seconds, std::uint64_t boxes) const;
  /// How many bytes more, or less, are kept.
  void keep(std::int64_t bytes) { kept_.fetch_add(bytes, std::memory_order_relaxed); }
  std::int64_t kept() const { return kept_; }
  /// Notes that the search has ended for this reason; the first reason is kept.
  void note(Limit by) const;
  /// What ended the run, and in which stage; nothing where it ran, or runs, to its end.
  std::optional<Ending> ending() const;

  Stage stage() const { return stage_; }
  /// Called where a stage begins, and by stages that know how far they are; from one thread. To be set before the run.
  std::function<void(const Progress&)> progress;
  void report(std::uint64_t done, std::uint64_t all) const;
  /// Called by searches every few seconds, from one thread at a time. To be set before the run.
  std::function<void(const SearchProgress&)> search_progress;
  double search_progress_interval = 0.1;

 private:
  friend class InStage;
  const Limits limits_;
  const double deadline_;
  std::atomic<Stage> stage_{Stage::model};
  int depth_ = 0;
  mutable std::atomic<bool> ended_{false};
  mutable std::atomic<double> ended_at_{0};
  mutable std::atomic<int> ending_{-1};  // limit and stage in one
  std::atomic<std::uint64_t> boxes_{0};
  std::atomic<std::int64_t> kept_{0};
};

/// What has ended the run by now: "the time limit, in the stage search"; empty where nothing did.
std::string stopped_by(const Control& control);

/// For its life the control is in the stage. Stages within a stage keep its name: a search in the exact stage is the exact
/// stage.
class InStage {
 public:
  InStage(Control& control, Stage stage);
  ~InStage() { --control_.depth_; }
  InStage(const InStage&) = delete;
  InStage& operator=(const InStage&) = delete;

 private:
  Control& control_;
};

}  // namespace corank::solve
