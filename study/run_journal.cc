#include "corank/study/run_journal.h"

#include <algorithm>
#include <utility>

#include "corank/solve/store/shard_bytes.h"

namespace corank::study {
namespace {

// Of a state, nearly.
std::uint64_t bytes_of(const solve::SearchView& state) {
  constexpr std::uint64_t kBeside = 100;
  std::uint64_t sum = 0;
  for (const auto& part : state.parts) {
    if (!part.shard->found.empty())
      sum += part.shard->found.size() * (kBeside + sizeof(Interval) * part.shard->found[0].box.box.size());
    if (!part.shard->sheets.empty())
      sum += part.shard->sheets.size() * (kBeside + 3 * sizeof(Interval) * part.shard->sheets[0].x.size());
    if (part.shard->script) sum += part.shard->script->bytes();
  }
  return sum;
}

}  // namespace

RunJournal::RunJournal(result::Checkpoint from, Plan plan) : known_(std::move(from)), plan_(std::move(plan)) {
  plan_next(Clock::now());
}

std::optional<solve::SearchState> RunJournal::next_search(const solve::Prepared& prepared) {
  if (ended_) return std::nullopt;
  const std::size_t index = searches_++;
  if (index > 0 && index > known_.finished.size()) known_.finished.push_back(std::exchange(last_, {}));
  const bool resumed = index < known_.finished.size();
  const std::string state = resumed ? known_.finished[index] : std::exchange(known_.state, {});
  if (state.empty()) return std::nullopt;
  try {
    return solve::state_from(state, prepared);
  } catch (const solve::ShardError& error) {
    throw result::ResultFileError(error.what());
  }
}

bool RunJournal::due() {
  if (plan_.path.empty() || ended_) return false;
  const auto now = Clock::now().time_since_epoch().count();
  if (now < next_.load(std::memory_order_relaxed)) return false;
  Clock::duration::rep never = 0;
  asked_.compare_exchange_strong(never, now);  // the threads come to their next boxes meanwhile
  return true;
}

void RunJournal::plan_next(Clock::time_point begun) {
  const auto now = Clock::now();
  const std::chrono::duration<double> took = now - begun;
  const double wait = std::max(plan_.every, took.count() * (1 / kMostShare - 1));
  constexpr double kLongest = 1e8;  // seconds: no overflow
  next_ = (now + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(wait, kLongest))))
              .time_since_epoch()
              .count();
}

void RunJournal::keep(const solve::SearchView& state, solve::Moment moment) {
  using solve::Moment;
  const auto asked = asked_.exchange(0);
  const auto begun = asked > 0 ? Clock::time_point(Clock::duration(asked)) : Clock::now();
  // What is done was kept before; what follows an end is not of the run any more.
  if (ended_ || searches_ <= known_.finished.size()) return;
  const auto state_writer = [&state](std::ostream& out) { solve::write(out, state); };
  ended_ = moment == Moment::ended;
  const bool to_file = ended_ || moment == Moment::paused || (moment == Moment::cut && due());
  if (to_file && !plan_.path.empty()) {
    result::write_checkpoint(plan_.path, solve::engine_version(), known_, state_writer);
    asked_ = 0;
    plan_next(begun);
  }
  const std::uint64_t bytes = bytes_of(state);
  left_out_ = plan_.keep_end && ended_ && bytes >= plan_.most_in_result ? bytes : 0;
  if (plan_.keep_end && ended_ && left_out_ == 0)
    search_ = result::checkpoint_bytes(solve::engine_version(), known_, state_writer, bytes);
  if (searches_ < expected_ && moment == Moment::cut) last_ = solve::to_bytes(state);
}

}  // namespace corank::study
