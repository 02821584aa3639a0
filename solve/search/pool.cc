#include "corank/solve/search/pool.h"

#include <tbb/parallel_for.h>

#include <memory>
#include <utility>

#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/solve/store/strata.h"

namespace corank::solve {

Pool::Pool(const Prepared& prepared, Tally& tally, ShardNumber last_shard, const Problem* like)
    : prepared_(prepared),
      tally_(tally),
      // What was found before may lie on strata: then they are all there, however late it is.
      problem_(like ? *like : problem_with_strata(prepared, [&] { return last_shard == 0 && tally.ended(); })),
      numbers_(last_shard),
      workers_([this] {
        tally_.keep_thread();
        return Worker(problem_, ++numbers_, prepared_.options.proof);
      }),
      arena_(prepared.options.threads) {
  problem_.ended = [this] {
    tally_.report(false);
    count(workers_.local());
    return tally_.ended();
  };
}

Pool::Pool(const Prepared& prepared, Tally& tally, std::vector<Shard> earlier)
    : Pool(prepared, tally, last_number(earlier)) {
  earlier_ = std::move(earlier);
  for (const Shard& shard : earlier_) {
    Tally::Counted counted;
    tally.count(shard, counted);
  }
}

void Pool::spawn(WorkList list, const Work& of) {
  ++busy_;
  auto shared = std::make_shared<WorkList>(std::move(list));
  group_.run([this, shared, &of] {
    work(std::move(*shared), of);
    --busy_;
  });
}

void Pool::divide(Worker& worker, Waiting box, WorkList& list) {
  auto [lower, upper] = worker.processor.halves(std::move(box));
  if (auto& script = worker.shard.script) {
    lower.node = script->new_node();
    upper.node = script->new_node();
    const int j = worker.processor.split_variable();
    script->split(j, upper.x[j].lo(), lower.node, upper.node);
  }
  list.push_back(std::move(upper));
  list.push_back(std::move(lower));
}

// Depth first, so that memory grows with the depth; or the oldest first (Work::until), so that there soon are many.
void Pool::work(WorkList list, const Work& of) {
  const UpwardRounding rounding;
  Worker& worker = workers_.local();
  BoxProcessor& processor = worker.processor;
  std::optional<Recorder>& script = worker.shard.script;
  const auto take_next = [&] {
    Waiting next = std::move(of.until > 0 ? list.front() : list.back());
    if (of.until > 0)
      list.pop_front();
    else
      list.pop_back();
    return next;
  };
  Box given;
  std::int64_t listed = 0;
  while (!list.empty()) {
    tally_.keep_waiting(list.size(), listed);
    if ((of.until > 0 && list.size() >= of.until) || tally_.pausing() || !tally_.count_box()) break;
    Waiting box = take_next();
    given = box.x;
    const Recorder::Mark before = script ? script->mark() : Recorder::Mark{};
    const Statistics counted = worker.shard.statistics;
    if (script) script->begin(box.node, box.x, variables());
    const auto outcome = processor.process(box.x, of.postpone, box.share);
    if (outcome == BoxProcessor::Outcome::interrupted) {
      if (script) script->go_back_to(before);
      worker.shard.statistics = counted;
      worker.shard.left.push_back({given, box.share, box.node});
      continue;
    }
    if (outcome == BoxProcessor::Outcome::split) {
      divide(worker, std::move(box), list);
      tally_.one_more_waits();
    } else {
      tally_.one_less_waits();
      if (outcome == BoxProcessor::Outcome::done) tally_.done_with(box.share);
    }
    count(worker);
    if (of.until == 0 && busy_.load(std::memory_order_relaxed) < threads() && threads() > 1 && list.size() > 1) {
      // The older half: the larger boxes.
      const auto half = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
      spawn({std::make_move_iterator(list.begin()), std::make_move_iterator(half)}, of);
      list.erase(list.begin(), half);
    }
  }
  tally_.keep_waiting(0, listed);
  while (!list.empty()) worker.shard.left.push_back(take_next());
}

void Pool::search(const Work& work) {
  WorkList list(work.boxes.rbegin(), work.boxes.rend());
  tally_.wait_for(list.size());
  execute([&] {
    if (threads() == 1 || work.until > 0) {
      this->work(std::move(list), work);
    } else {
      spawn(std::move(list), work);
      CORANK_CHECK(group_.wait() != tbb::canceled);  // else waiting boxes would be lost
    }
  });
}

void Pool::add_proven(const Postponed& box) {
  Worker& worker = workers_.local();
  worker.processor.add_proven(box);
  tally_.done_with(box.box.share);
  count(worker);
}

void Pool::give_up(const Postponed& box, Reason reason) {
  Worker& worker = workers_.local();
  WorkList parts{box.box};
  while (!parts.empty()) {
    Waiting part = std::move(parts.back());
    parts.pop_back();
    if (worker.shard.script) worker.shard.script->begin(part.node, part.x, variables());
    if (worker.processor.give_up(part.x, reason) == BoxProcessor::Outcome::split) divide(worker, std::move(part), parts);
  }
  tally_.done_with(box.box.share);
  count(worker);
}

bool Pool::cut(const std::vector<Shard*>& shards, std::size_t most) {
  if (!std::exchange(cutting_, true)) whole_ = tally_.begin_cutting();
  std::vector<Proven*> sheets;
  for (Shard* shard : shards)
    for (Proven& sheet : shard->sheets)
      if (!sheet.cut) sheets.push_back(&sheet);
  const std::vector<Waiting> left = take(shards, &Shard::left);
  std::atomic<bool> paused{false};
  const double grace = Control::kGrace / threads();  // of all together
  execute([&] {
    const auto cut_one = [&](std::size_t i) {
      const UpwardRounding rounding;
      Worker& worker = workers_.local();
      if (i < sheets.size()) {
        if (tally_.pausing()) {
          paused = true;
          return;
        }
        if (worker.shard.found.size() > most) return;
        const Shard::Mark before = worker.shard.mark();
        if (whole_ && tally_.overdue(grace)) {
          worker.processor.leave({sheets[i]->x, 0, sheets[i]->node});
        } else {
          sheets[i]->cut = worker.processor.cut(*sheets[i], whole_);
        }
        if (!sheets[i]->cut && !worker.finished) worker.finished = before;
      } else {
        worker.processor.leave(left[i - sheets.size()]);
      }
      count(worker);
    };
    const std::size_t all = sheets.size() + left.size();
    if (threads() == 1) {
      for (std::size_t i = 0; i < all; ++i) cut_one(i);
    } else {
      tbb::parallel_for(std::size_t{0}, all, cut_one);
    }
  });
  return !paused;
}

std::vector<Shard*> Pool::shards() {
  std::vector<Shard*> all;
  for (Shard& shard : earlier_) all.push_back(&shard);
  for (Worker& w : workers_) all.push_back(&w.shard);
  return all;
}

std::vector<SearchView::ShardView> Pool::finished() {
  std::vector<SearchView::ShardView> all;
  for (const Shard& shard : earlier_) all.push_back({&shard, {}});
  for (const Worker& w : workers_) all.push_back({&w.shard, w.finished});
  return all;
}

SearchView::ShardView Pool::end_of_mine() {
  const Shard& shard = workers_.local().shard;
  return {&shard, shard.mark()};
}

std::vector<Shard> Pool::take_shards() {
  std::vector<Shard> all = std::move(earlier_);
  for (Worker& w : workers_) all.push_back(std::move(w.shard));
  return all;
}

}  // namespace corank::solve
