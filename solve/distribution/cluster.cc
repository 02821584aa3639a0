#include "corank/solve/distribution/cluster.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <utility>

#include "corank/core/check.h"
#include "corank/solve/search/assembly.h"
#include "corank/solve/search/passes.h"
#include "corank/solve/store/memory.h"
#include "corank/solve/store/shard_bytes.h"

namespace corank::solve {
namespace {

// So many times the boxes that are to wait may be processed until they do: a thin tree is not for one worker.
constexpr std::uint64_t kBeginning = 4;

// Splits a list into up to so many parts, of every k-th each: neighbours cost about the same.
template <class T>
std::vector<std::vector<T>> dealt(std::vector<T> all, std::size_t parts) {
  std::vector<std::vector<T>> hands(std::min(parts, all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) hands[i % hands.size()].push_back(std::move(all[i]));
  return hands;
}

// Whoever runs units beside the coordinator is not to be held to its threads.
Prepared with_all_threads(Prepared prepared) {
  prepared.options.threads = 0;
  return prepared;
}

}  // namespace

struct Coordinator::Search {
  Search(std::string bytes, const std::optional<std::string>& from, Control* of_run)
      : prepared_text(std::move(bytes)),
        prepared(with_all_threads(prepared_from(prepared_text))),
        state(from ? state_from(*from, prepared) : SearchState{}),
        run(of_run ? *of_run : unlimited),
        memory(prepared.reduction, run.limits().later_bytes),
        tally(prepared, control, 0),
        judge(prepared, tally, number_of_judge()) {
    if (!from) state.first = state.pass = first_pass(prepared);
    if (!prepared.reduction.consistent) {  // there is nothing to search
      state.pass.boxes.clear();
      state.cutting = true;
      state.sigma = sigma_of_search(prepared, judge.problem());
    }
    for (Shard& shard : state.shards) parts.push_back(std::make_unique<Finished>(Finished{std::move(shard), {}, {}}));
    next_id = number_of_judge() / kNumbersOfUnit + 2;  // the judge has one of its own
    open = std::exchange(state.pass.boxes, {});
    state.motions.begin(judge.problem());
    judge.set_sigma(state.cutting ? state.sigma : sigma_of_search(prepared, judge.problem()));
    if (state.cutting) list_sheets();
    for (const auto& part : parts) keep(of(*part));
    keep(memory.of_waiting(open.size()));
    advance();
  }
  ~Search() { run.keep(-kept); }

  // Behind which the judge's own numbers are.
  ShardNumber number_of_judge() const { return (last_number(state.shards) / kNumbersOfUnit + 1) * kNumbersOfUnit; }

  std::vector<Shard*> all_shards() {
    std::vector<Shard*> all = judge.shards();
    for (const auto& part : parts) all.push_back(&part->shard);
    return all;
  }

  // As a search with threads counts it (solve/store/tally.cc).
  std::int64_t of(const Shard& shard, const PackedFound& found) const {
    std::int64_t bytes = memory.of(found) + memory.of_waiting(shard.left.size() + shard.postponed.size());
    for (std::size_t i = 0; i < shard.found.size(); ++i)
      bytes += memory.of(shard.found[i], i > 0 ? &shard.found[i - 1] : nullptr);
    for (const Proven& sheet : shard.sheets) bytes += memory.of_sheet(sheet.sheet);
    return bytes + (shard.script ? memory.of_script(shard.script->bytes()) : 0);
  }
  void keep(std::int64_t bytes) {
    kept += bytes;
    run.keep(bytes);
  }

  double share_that_waits() const {
    double share = 0;
    for (const Waiting& box : open) share += box.share;
    for (const auto& [id, given] : under_way)
      for (const Waiting& box : given.boxes) share += box.share;
    return share;
  }
  bool waits() const { return !open.empty() || !open_sheets.empty() || !under_way.empty(); }
  bool ended() {
    if (over || (state.cutting && !waits())) return over;
    const InStage stage(run, Stage::search);
    over = run.search_ended();
    const bool no_more = run.limits().boxes > 0 && run.boxes_left() == 0;
    if (!over && no_more && !state.cutting && under_way.empty()) {
      run.note(Limit::boxes);
      over = true;
    }
    return over;
  }

  // Makes of what is left what a search with threads makes of it (solve/search/solve.cc).
  void end_early() {
    const auto by = run.ending();
    stop = !by || by->by != Limit::boxes;
    judge.execute([&] { static_cast<void>(judge.ended()); });
    Shard left(next_id++ * kNumbersOfUnit, prepared.options.proof);
    left.left = std::move(open);
    for (auto& [id, given] : under_way) std::move(given.boxes.begin(), given.boxes.end(), std::back_inserter(left.left));
    under_way.clear();
    if (!state.cutting) {
      Work rest = next_pass(prepared, state.pass, take(all_shards(), &Shard::postponed), judge, state.motions);
      std::move(rest.boxes.begin(), rest.boxes.end(), std::back_inserter(left.left));
      begin_cutting();
    }
    parts.push_back(std::make_unique<Finished>(Finished{std::move(left)}));
    judge.cut(all_shards());
    open_sheets.clear();
  }

  // In the arena. Bytes go as their boxes come.
  void unpack() {
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
      Finished& part = *parts[i];
      part.found.unpack(part.shard.found);
      part.found = {};
      part.owner.reset();
    });
  }

  void begin_cutting() {
    state.sigma = judge.problem().tolerant ? sigma_of_search(prepared, judge.problem())
                                           : sigma_of_set(prepared, judge.problem(), all_shards());
    judge.set_sigma(state.sigma);
    state.cutting = true;
  }

  void list_sheets() {
    for (Shard* shard : all_shards())
      for (Proven& sheet : shard->sheets)
        if (!sheet.cut) open_sheets.push_back(&sheet);
  }

  // That are open, as the others were cut.
  double boxes_of_sheets() const {
    return sheets_cut == 0 ? 0 : static_cast<double>(open_sheets.size()) * boxes_cut / static_cast<double>(sheets_cut);
  }

  // Where a pass is done, the next one begins; after the last one sheets are to be cut.
  void advance() {
    while (!state.cutting && open.empty() && under_way.empty()) {
      std::vector<Postponed> postponed = take(all_shards(), &Shard::postponed);
      if (!postponed.empty()) {
        ++passes;
        state.pass = next_pass(prepared, state.pass, std::move(postponed), judge, state.motions);
        open = std::exchange(state.pass.boxes, {});
        if (!open.empty()) return;
      }
      begin_cutting();
      list_sheets();
    }
  }

  // What came of a unit, or was in the state from which the search goes on.
  struct Finished {
    Shard shard;
    PackedFound found{};  // until the search is done
    std::shared_ptr<const void> owner{};
  };
  std::int64_t of(const Finished& part) const { return of(part.shard, part.found); }

  // What a unit is made of, as long as it is under way.
  struct Given {
    std::vector<Waiting> boxes;
    std::vector<Proven*> sheets;
    std::uint64_t most = 0;  // boxes, where there is a limit
  };

  const std::string prepared_text;
  Prepared prepared;
  std::atomic<bool> stop{false};
  Control control{{.stop = &stop}};  // the judge's: what it decides is the same with limits and without
  Control unlimited;
  SearchState state;  // its pass without boxes, and no shards
  Control& run;
  const MemoryEstimate memory;
  std::int64_t kept = 0;  // bytes that the run has been told of
  bool over = false;
  std::uint64_t processed = 0;   // by the units of this coordinator
  std::uint64_t sheets_cut = 0;  // by them, about
  double boxes_cut = 0;          // from these
  std::uint64_t promised = 0;    // boxes, to the units that are under way
  Tally tally;
  Pool judge;
  std::vector<std::unique_ptr<Finished>> parts;
  std::vector<Waiting> open;
  std::vector<Proven*> open_sheets;
  std::map<std::uint64_t, Given> under_way;
  std::uint64_t next_id = 1;
  Pace pace;
  int passes = 0;
};

Coordinator::Coordinator(std::string prepared, std::optional<std::string> from, Control* control)
    : search_(std::make_unique<Search>(std::move(prepared), from, control)) {}
Coordinator::~Coordinator() = default;

const std::string& Coordinator::prepared_bytes() const { return search_->prepared_text; }
bool Coordinator::ended() { return search_->ended(); }
bool Coordinator::done() const {
  return search_->state.cutting && search_->open_sheets.empty() && search_->under_way.empty();
}

double Coordinator::share_done() const { return std::clamp(1 - search_->share_that_waits(), 0.0, 1.0); }

Pace::Units Coordinator::next_units(std::size_t threads, double longest, double time) {
  Search& s = *search_;
  if (s.state.cutting) return Pace::of_sheets(threads, longest);
  return s.pace.next(threads, longest, {s.passes, s.share_that_waits(), s.under_way.size(), time});
}

std::vector<std::string> Coordinator::take_units(std::size_t wanted, std::size_t fewest_boxes) {
  Search& s = *search_;
  std::vector<std::string> units;
  const auto give = [&](Unit unit, Search::Given given) {
    unit.id = s.next_id++;
    units.push_back(to_bytes(unit));
    s.under_way.emplace(unit.id, std::move(given));
  };
  if (s.ended()) return units;
  if (!s.state.cutting) {
    // Of what may be processed each unit gets its share.
    const bool limited = s.run.limits().boxes > 0;
    std::uint64_t left = limited ? s.run.boxes_left() - s.promised : 0;
    if (limited) wanted = std::min<std::uint64_t>(wanted, left);
    // At the beginning one unit makes boxes enough for all.
    const std::size_t enough = wanted * fewest_boxes, full = s.open.size() / std::max<std::size_t>(1, fewest_boxes);
    const bool spread = s.under_way.empty() && s.open.size() < enough && s.processed < kBeginning * enough;
    wanted = spread ? 1 : s.under_way.empty() ? std::min(wanted, s.open.size()) : std::min(wanted, full);
    if (wanted == 0 || s.open.empty()) return units;
    // The largest first: who waits for work gets most of it.
    std::ranges::stable_sort(s.open, [](const Waiting& a, const Waiting& b) { return a.share > b.share; });
    std::vector<std::vector<Waiting>> hands = dealt(std::exchange(s.open, {}), wanted);
    for (std::size_t i = 0; i < hands.size(); ++i) {
      const std::uint64_t most = left / (hands.size() - i);
      left -= most;
      s.promised += most;
      Unit unit{.boxes = most, .work = {hands[i], s.state.pass.postpone, spread ? enough : 0}};
      give(std::move(unit), {std::move(hands[i]), {}, most});
    }
  } else {
    const std::size_t parts =
        std::max(wanted, static_cast<std::size_t>(s.boxes_of_sheets() / static_cast<double>(Budget{}.found)));
    for (std::vector<Proven*>& sheets : dealt(std::exchange(s.open_sheets, {}), parts)) {
      if (units.size() == wanted) {
        std::move(sheets.begin(), sheets.end(), std::back_inserter(s.open_sheets));
        continue;
      }
      Unit unit{.cut = true, .sigma = s.state.sigma};
      for (const Proven* sheet : sheets) unit.sheets.push_back(*sheet);
      give(std::move(unit), {{}, std::move(sheets), 0});
    }
  }
  return units;
}

bool Coordinator::add(std::string_view bytes, std::shared_ptr<const void> owner) {
  Search& s = *search_;
  if (!owner) {
    const auto copy = std::make_shared<const std::string>(bytes);
    bytes = *copy;
    owner = copy;
  }
  Received answer = answer_from(bytes, s.prepared);
  const auto given = s.under_way.find(answer.id);
  if (given == s.under_way.end()) {
    if (answer.id >= s.next_id) throw ShardError("the answer to a unit that was never given out");
    return false;
  }
  for (const Received::PackedShard& part : answer.parts)
    if (part.shard.number / kNumbersOfUnit != answer.id) throw ShardError("an answer with the numbers of another unit");
  std::int64_t more = 0;
  for (const Received::PackedShard& part : answer.parts) more += s.of(part.shard, part.found);
  const std::uint64_t most = s.run.limits().memory;
  if (most > 0 && s.run.kept() + more > static_cast<std::int64_t>(most)) {
    const InStage stage(s.run, Stage::search);
    s.run.note(Limit::memory);
    s.over = true;
    return false;
  }
  s.keep(more - s.memory.of_waiting(given->second.boxes.size()));
  for (const Received::PackedShard& part : answer.parts) {
    s.run.count_boxes(part.shard.statistics.processed);
    s.processed += part.shard.statistics.processed;
  }
  s.promised -= given->second.most;
  for (Proven* sheet : given->second.sheets) {
    s.keep(-s.memory.of_sheet(sheet->sheet));
    *sheet = {.x = {}, .sheet = {}, .node = sheet->node, .cut = true};  // its boxes are there now
  }
  s.under_way.erase(given);
  for (auto& [shard, found] : answer.parts) {
    std::move(shard.left.begin(), shard.left.end(), std::back_inserter(s.open));
    shard.left.clear();
    const bool any = found.size() > 0;
    s.sheets_cut += any ? found.regions() : 0;
    s.boxes_cut += any ? static_cast<double>(found.size()) : 0;
    s.parts.push_back(std::make_unique<Search::Finished>(
        Search::Finished{std::move(shard), any ? std::move(found) : PackedFound(), any ? owner : nullptr}));
  }
  s.advance();
  return true;
}

std::string Coordinator::state() const {
  const Search& s = *search_;
  Work pass{s.open, s.state.pass.postpone};
  for (const auto& [id, given] : s.under_way) pass.boxes.insert(pass.boxes.end(), given.boxes.begin(), given.boxes.end());
  SearchView view{.first = s.state.first,
                  .pass = pass,
                  .motions = s.state.motions,
                  .cutting = s.state.cutting,
                  .sigma = s.state.sigma,
                  .seconds = s.state.seconds};
  for (const Shard* shard : search_->judge.shards()) view.parts.push_back({shard, {}});
  for (const auto& part : s.parts) view.parts.push_back({&part->shard, {}, part->owner ? &part->found : nullptr});
  return to_bytes(view);
}

Cover Coordinator::assemble(Control& control) {
  CORANK_CHECK(done() || ended());
  Search& s = *search_;
  if (!done()) s.end_early();
  Cover cover;
  s.judge.execute([&] {
    s.unpack();
    cover = solve::assemble(s.prepared, s.judge.problem(), s.all_shards(), s.state.first, s.state.motions, s.state.sigma,
                            control);
  });
  s.keep(-s.kept);
  cover.statistics.seconds_total = s.state.seconds + s.tally.seconds();
  cover.statistics.seconds_search = cover.statistics.seconds_total - cover.statistics.seconds_certify;
  return cover;
}

}  // namespace corank::solve
