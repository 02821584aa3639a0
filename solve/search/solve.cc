#include "corank/solve/search/solve.h"

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "corank/solve/search/assembly.h"
#include "corank/solve/search/passes.h"
#include "corank/solve/store/journal.h"

namespace corank::solve {
namespace {

SearchState beginning(const Prepared& prepared) {
  SearchState state;
  state.first = state.pass = first_pass(prepared);
  return state;
}

// One search, from a state on.
class Search {
 public:
  Search(const Prepared& prepared, Control& control, std::uint64_t most, Journal* journal, SearchState from)
      : prepared_(prepared),
        control_(control),
        journal_(journal),
        first_(std::move(from.first)),
        pass_(std::move(from.pass)),
        motions_(std::move(from.motions)),
        cutting_(from.cutting),
        seconds_before_(from.seconds),
        tally_(prepared, control, most, journal),
        pool_(prepared, tally_, std::move(from.shards)),
        sigma_(cutting_ ? from.sigma : sigma_of_search(prepared, pool_.problem())) {
    motions_.begin(pool_.problem());
    pool_.set_sigma(sigma_);
  }

  /// Nothing where the journal has got the state of a search whose turn is over.
  std::optional<Cover> run() {
    if (prepared_.reduction.consistent) {
      const InStage stage(control_, Stage::search);
      if (!cutting_) search();
      if (turn_is_over_) return std::nullopt;
      cut();
    }
    Cover cover;
    pool_.execute([&] { cover = assemble(prepared_, pool_.problem(), pool_.shards(), first_, motions_, sigma_, control_); });
    cover.statistics.seconds_certify /= pool_.threads();
    cover.statistics.seconds_total = seconds();
    cover.statistics.seconds_search = cover.statistics.seconds_total - cover.statistics.seconds_certify;
    tally_.report(true);
    return cover;
  }

 private:
  double seconds() const { return seconds_before_ + tally_.seconds(); }

  void search() {
    while (search_pass() && next()) {
    }
  }

  // False: nothing was there to search.
  bool search_pass() {
    bool any = !pass_.boxes.empty();
    for (const Shard* shard : pool_.shards()) any = any || !shard->postponed.empty();
    while (any) {
      pool_.search(pass_);
      if (tally_.ended() || !tally_.pausing()) break;
      pass_.boxes = take(pool_.shards(), &Shard::left);
      keep(view(), Moment::paused);
      tally_.resume();
    }
    return any;
  }

  // The pass after this one; false: there is none.
  bool next() {
    const double postpone = pass_.postpone;
    if (journal_) {
      pass_.boxes = left();
      if (tally_.ended() || !pass_.boxes.empty()) end(view());
    }
    pass_.boxes.clear();
    if (!journal_) return advance(take(pool_.shards(), &Shard::postponed));
    // What ends meanwhile is done again by whoever resumes: as it is before.
    const SelfMotions motions = motions_;
    const std::vector<Postponed> postponed = take(pool_.shards(), &Shard::postponed);
    const Work done{{}, postpone};
    SearchView before{.first = first_, .pass = done, .motions = motions, .parts = pool_.finished()};
    const SearchView::ShardView mine = pool_.end_of_mine();
    std::erase_if(before.parts, [&](const auto& part) { return part.shard == mine.shard; });
    before.parts.push_back(mine);
    before.postponed = &postponed;
    before.seconds = seconds();
    const bool more = advance(postponed);
    if (tally_.ended()) end(std::move(before));
    return more;
  }

  bool advance(std::vector<Postponed> postponed) {
    pass_ = next_pass(prepared_, pass_, std::move(postponed), pool_, motions_);
    return !pass_.boxes.empty();
  }

  void cut() {
    if (!cutting_ && !pool_.problem().tolerant) sigma_ = sigma_of_set(prepared_, pool_.problem(), pool_.shards());
    cutting_ = true;
    pool_.set_sigma(sigma_);
    while (!pool_.cut(pool_.shards())) {
      keep(view(), Moment::paused);
      tally_.resume();
    }
    if (journal_) keep(view(), tally_.ended() ? Moment::ended : Moment::cut);
  }

  std::vector<Waiting> left() {
    std::vector<Waiting> all;
    for (const Shard* shard : pool_.shards()) all.insert(all.end(), shard->left.begin(), shard->left.end());
    return all;
  }

  SearchView view() {
    return {.first = first_,
            .pass = pass_,
            .motions = motions_,
            .cutting = cutting_,
            .sigma = sigma_,
            .parts = pool_.finished(),
            .seconds = seconds()};
  }

  void keep(const SearchView& state, Moment moment) { journal_->keep(state, moment); }

  // The last state that can be gone on from: what follows is made for the result.
  void end(const SearchView& state) {
    turn_is_over_ = tally_.turn_is_over();
    keep(state, turn_is_over_ ? Moment::turn_over : Moment::ended);
    journal_ = nullptr;
    tally_.forget_journal();
  }

  const Prepared& prepared_;
  Control& control_;
  Journal* journal_;
  const Work first_;
  Work pass_;
  SelfMotions motions_;
  bool cutting_;
  bool turn_is_over_ = false;
  const double seconds_before_;
  Tally tally_;
  Pool pool_;
  Sigma sigma_;
};

// To free millions of sheets takes as long as a search of seconds; with the process they go at once.
std::optional<Cover> run(std::unique_ptr<Search> search, const Control& control) {
  std::optional<Cover> cover = search->run();
  if (control.limits().leaves_memory && control.ended()) {
    static std::mutex mutex;
    static auto* const left = new std::vector<std::unique_ptr<Search>>;
    const std::lock_guard lock(mutex);
    left->push_back(std::move(search));
  }
  return cover;
}

}  // namespace

double printed_tolerance(const System& system) {
  constexpr double kPrintedDecimals = 1e-6;
  return system.equations.size() > system.variables.size() ? kPrintedDecimals : 0;
}

Cover solve(const System& system, const Options& options) {
  Control control(limits_of(options));
  return solve(prepare(system, options, control), control);
}

Cover solve(const Prepared& prepared, Control& control, std::uint64_t most) {
  return *run(std::make_unique<Search>(prepared, control, most, nullptr, beginning(prepared)), control);
}

Cover solve_on(const Prepared& prepared, Control& control, Journal* journal, std::optional<SearchState> from) {
  return *run(std::make_unique<Search>(prepared, control, 0, journal, from ? std::move(*from) : beginning(prepared)),
              control);
}

std::optional<Cover> solve_turn(const Prepared& prepared, Control& control, Journal& journal, std::uint64_t most,
                                std::optional<SearchState> from) {
  return run(std::make_unique<Search>(prepared, control, most, &journal, from ? std::move(*from) : beginning(prepared)),
             control);
}

}  // namespace corank::solve
