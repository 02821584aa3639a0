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
  if (known_.states.empty()) known_.states.resize(1);
  plan_next(Clock::now());
}

std::optional<solve::SearchState> RunJournal::begin(std::size_t search, const solve::Prepared& prepared) {
  known_.under_way = search;
  const std::string state = std::exchange(known_.states.at(search), {});
  if (state.empty()) return std::nullopt;
  try {
    return solve::state_from(state, prepared);
  } catch (const solve::ShardError& error) {
    throw result::ResultFileError(error.what());
  }
}

std::uint64_t RunJournal::bytes_of_others() const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < known_.states.size(); ++i) sum += i == known_.under_way ? 0 : known_.states[i].size();
  return sum;
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
  if (ended_) return;  // what follows is not of the run any more
  const auto state_writer = [&state](std::ostream& out) { solve::write(out, state); };
  ended_ = moment == Moment::ended;
  const bool is_over = moment == Moment::turn_over || moment == Moment::cut;
  const bool to_file = ended_ || moment == Moment::paused || (is_over && due());
  if (to_file && !plan_.path.empty()) {
    result::write_checkpoint(plan_.path, solve::engine_version(), known_, state_writer);
    asked_ = 0;
    plan_next(begun);
  }
  const std::uint64_t bytes = bytes_of(state) + bytes_of_others();
  left_out_ = plan_.keep_end && ended_ && bytes >= plan_.most_in_result ? bytes : 0;
  if (plan_.keep_end && ended_ && left_out_ == 0)
    search_ = result::checkpoint_bytes(solve::engine_version(), known_, state_writer, bytes);
  const bool is_kept = plan_.keep_end || !plan_.path.empty();  // a finished search's, beside those that go on
  if (known_.states.size() > 1 && (moment == Moment::turn_over || (moment == Moment::cut && is_kept)))
    known_.states[known_.under_way] = solve::to_bytes(state);
}

}  // namespace corank::study
