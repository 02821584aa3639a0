#include "corank/solve/store/tally.h"

#include <utility>

#include "corank/core/nearest_rounding.h"
#include "corank/solve/cutting/slicer.h"

namespace corank::solve {
namespace {
constexpr std::uint64_t kBoxesBetweenReports = 64;
// What a second makes a result of: of sheets, which become boxes first, and of boxes (bench/HISTORY.md, "What a limit
// leaves to do").
constexpr double kSheetBytesPerSecond = 100e6, kBoxBytesPerSecond = 400e6;
}  // namespace

Tally::Tally(const Prepared& prepared, Control& control, std::uint64_t most, Journal* journal)
    : options_(prepared.options),
      control_(control),
      most_(most),
      journal_(journal),
      parameters_(prepared.reduction.system.parameters()),
      memory_(prepared.reduction, control.limits().later_bytes),
      soon_found_(memory_.of_found(2 * kPiecesBetweenChecks * static_cast<std::size_t>(std::max(1, options_.threads)))) {}

void Tally::keep(std::int64_t bytes) {
  kept_.fetch_add(bytes, std::memory_order_relaxed);
  control_.keep(bytes);
}

void Tally::keep_waiting(std::size_t boxes, std::int64_t& before) {
  if (control_.limits().memory == 0) return;
  const std::int64_t now = memory_.of_waiting(boxes);
  keep(now - std::exchange(before, now));
}

void Tally::end(Limit by) {
  if (!ended_.exchange(true)) control_.note(by);
}

bool Tally::out_of_time() const {
  return control_.limits().time > 0 && control_.seconds_left() < static_cast<double>(control_.kept()) /
                                                                     (cutting_ ? kBoxBytesPerSecond : kSheetBytesPerSecond);
}

bool Tally::ended() {
  if (ended_.load(std::memory_order_relaxed)) return true;
  if (out_of_time()) {
    control_.note(Limit::time);
    ended_ = true;
    return true;
  }
  if (cutting_) {
    const std::uint64_t most = control_.limits().memory;
    const bool full = most > 0 && control_.kept() + soon_found_ > static_cast<std::int64_t>(most);
    if (full) control_.note(Limit::memory);
    if (full || control_.ended()) ended_ = true;
    return ended_;
  }
  const bool over = control_.search_ended() || (most_ > 0 && processed_.load(std::memory_order_relaxed) >= most_);
  if (over) ended_ = true;
  return over;
}

bool Tally::pausing() {
  if (!journal_) return false;
  if (!pausing_.load(std::memory_order_relaxed) && journal_->due()) pausing_ = true;
  return pausing_.load(std::memory_order_relaxed);
}

bool Tally::begin_cutting() {
  cutting_ = true;
  const auto ending = control_.ending();
  const bool whole = ended_ && ending && ending->by != Limit::boxes && ending->by != Limit::solutions;
  if (!whole) ended_ = false;
  return whole;
}

bool Tally::count_box() {
  if (ended() || !control_.count_box()) return false;
  const std::uint64_t before = processed_.fetch_add(1, std::memory_order_relaxed);
  if (before % kBoxesBetweenReports == 0) report(false);
  return true;
}

void Tally::weigh(const Shard& shard, Counted& counted) {
  if (control_.limits().memory == 0) return;
  std::int64_t bytes = 0;
  for (; counted.weighed < shard.found.size(); ++counted.weighed)
    bytes += memory_.of(shard.found[counted.weighed], counted.weighed > 0 ? &shard.found[counted.weighed - 1] : nullptr);
  if (shard.script) {
    const std::uint64_t recorded = shard.script->bytes();
    bytes += memory_.of_script(recorded - counted.recorded);
    counted.recorded = recorded;
  }
  if (bytes > 0) keep(bytes);
}

void Tally::count(const Shard& shard, Counted& counted) {
  weigh(shard, counted);
  if (!control_.search_progress && options_.max_solutions == 0 && options_.max_found == 0 && control_.limits().memory == 0)
    return;
  count_sheets(shard, counted);
  for (; counted.found < shard.found.size(); ++counted.found) {
    const Found& f = shard.found[counted.found];
    ++verdicts_[static_cast<std::size_t>(f.box.verdict)];
    if (++found_ == options_.max_found) end(Limit::found);
    const bool proven = f.box.verdict != Verdict::undecided && f.box.verdict != Verdict::pending;
    if (cutting_ && proven && std::cmp_greater(f.box.free.size(), parameters_) && ++cut_ == options_.max_solutions)
      end(Limit::solutions);
  }
}

// Sheets count before they are cut.
void Tally::count_sheets(const Shard& shard, Counted& counted) {
  if (options_.max_found > 0 && sheets_ + shard.postponed.size() >= options_.max_found) end(Limit::found);
  for (; counted.sheets < shard.sheets.size(); ++counted.sheets) {
    const certify::Sheet& sheet = shard.sheets[counted.sheets].sheet;
    keep(memory_.of_sheet(sheet));
    if (++sheets_ == options_.max_found) end(Limit::found);
    if (options_.max_solutions == 0) continue;
    const std::lock_guard lock(solutions_mutex_);
    if (std::ssize(sheet.dependent) + parameters_ == std::ssize(sheet.region)) {
      isolated_.add(sheet);
    } else {
      ++pieces_;
    }
    if (pieces_ + isolated_.count() < options_.max_solutions) continue;
    end(Limit::solutions);
  }
}

void Tally::report(bool last) {
  if (!control_.search_progress) return;
  std::unique_lock lock(progress_mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  const double now = seconds();
  if (!last && now - last_report_ < control_.search_progress_interval) return;
  last_report_ = now;
  SearchProgress p;
  p.processed = processed_;
  p.waiting = waiting_;
  p.excluded = done_share_.load();
  for (std::size_t v = 0; v < p.verdicts.size(); ++v) p.verdicts[v] = verdicts_[v];
  p.seconds = now;
  const NearestRounding nearest;  // the callback is not ours
  control_.search_progress(p);
}

}  // namespace corank::solve
