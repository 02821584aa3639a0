#include "corank/solve/pool.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <utility>

#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/core/threads.h"
#include "corank/solve/box_processor.h"
#include "corank/solve/work_list.h"

namespace corank::solve {

struct Pool::Threads {
  struct Worker {  // one per thread
    Worker(const Problem& problem, ShardNumber number, bool recorded) : shard(number, recorded), processor(problem, shard) {}
    Shard shard;
    BoxProcessor processor;
    Tally::Counted counted{};
    std::optional<Shard::Mark> finished{};  // before the first sheet that was not cut to its end
  };

  Threads(const Prepared& p, Tally& t, ShardNumber last_shard, const Problem* like)
      : prepared(p),
        tally(t),
        problem(like ? *like : Problem(p.system, p.reduction, {})),
        numbers(last_shard),
        workers([this] {
          tally.keep_thread();
          return Worker(problem, ++numbers, prepared.options.proof);
        }),
        arena(p.options.threads) {
    problem.ended = [this] {
      tally.report(false);
      count(workers.local());
      return tally.ended();
    };
  }

  int variables() const { return problem.compiled.variables(); }
  void count(Worker& worker) { tally.count(worker.shard, worker.counted); }

  void spawn(WorkList list, double postpone) {
    ++busy;
    auto shared = std::make_shared<WorkList>(std::move(list));
    group.run([this, shared, postpone] {
      work(std::move(*shared), postpone);
      --busy;
    });
  }

  // `until`: of Work.
  void work(WorkList list, double postpone, std::uint64_t until = 0) {
    const UpwardRounding rounding;
    Worker& worker = workers.local();
    BoxProcessor& processor = worker.processor;
    std::optional<Recorder>& script = worker.shard.script;
    std::vector<Interval> x(variables()), given;
    std::int64_t listed = 0;
    while (!list.empty()) {
      tally.keep_waiting(list.size(), listed);
      if ((until > 0 && list.size() >= until) || tally.pausing() || !tally.count_box()) break;
      const NodeId node = list.node();
      const double share = list.pop(x);
      given = x;
      const Recorder::Mark before = script ? script->mark() : Recorder::Mark{};
      const Statistics counted = worker.shard.statistics;
      if (script) script->begin(node, x, variables());
      const auto outcome = processor.process(x, postpone, share);
      if (outcome == BoxProcessor::Outcome::interrupted) {
        if (script) script->go_back_to(before);
        worker.shard.statistics = counted;
        worker.shard.left.push_back({given, share, node});
        continue;
      }
      if (outcome == BoxProcessor::Outcome::split) {
        const std::size_t j = processor.split_variable();
        const Interval side = x[j];
        const double at = *split_point(side);
        NodeId lower, upper;
        if (script) {
          lower = script->new_node();
          upper = script->new_node();
          script->split(processor.split_variable(), at, lower, upper);
        }
        x[j] = Interval(at, side.hi());
        list.push(x, share * (1 - kBisectionPoint), upper);
        x[j] = Interval(side.lo(), at);
        list.push(x, share * kBisectionPoint, lower);
        tally.one_more_waits();
      } else {
        tally.one_less_waits();
      }
      if (outcome == BoxProcessor::Outcome::done) tally.done_with(share);
      count(worker);
      if (until == 0 && busy.load(std::memory_order_relaxed) < arena.threads() && arena.threads() > 1 && list.size() > 1)
        spawn(list.split_off(), postpone);
    }
    tally.keep_waiting(0, listed);
    while (!list.empty()) {
      const NodeId node = list.node();
      const double share = list.pop(x);
      worker.shard.left.push_back({x, share, node});
    }
  }

  const Prepared& prepared;
  Tally& tally;
  std::vector<Shard> earlier;
  bool cutting = false, whole = false;
  Problem problem;
  std::atomic<ShardNumber> numbers;
  std::atomic<int> busy{0};
  tbb::enumerable_thread_specific<Worker> workers;
  ThreadArena arena;
  tbb::task_group group;
};

Pool::Pool(const Prepared& prepared, Tally& tally, ShardNumber last_shard, const Problem* like)
    : threads_(std::make_unique<Threads>(prepared, tally, last_shard, like)) {}
Pool::Pool(const Prepared& prepared, Tally& tally, std::vector<Shard> earlier) {
  ShardNumber last = 0;
  for (const Shard& shard : earlier) last = std::max(last, shard.number);
  threads_ = std::make_unique<Threads>(prepared, tally, last, nullptr);
  threads_->earlier = std::move(earlier);
  for (const Shard& shard : threads_->earlier) {
    Tally::Counted counted;
    tally.count(shard, counted);
  }
}
Pool::~Pool() = default;

const Problem& Pool::problem() const { return threads_->problem; }
bool Pool::ended() const { return threads_->tally.ended(); }
int Pool::threads() const { return threads_->arena.threads(); }
void Pool::set_sigma(const Sigma& sigma) { threads_->problem.set_sigma(sigma); }
void Pool::execute(const std::function<void()>& f) { threads_->arena.execute(f); }

void Pool::search(const Work& work) {
  Threads& t = *threads_;
  WorkList list(t.variables(), work.until > 0);
  for (auto box = work.boxes.rbegin(); box != work.boxes.rend(); ++box) list.push(box->x, box->share, box->node);
  t.tally.wait_for(list.size());
  execute([&] {
    if (t.arena.threads() == 1 || work.until > 0) {
      t.work(std::move(list), work.postpone, work.until);
    } else {
      t.spawn(std::move(list), work.postpone);
      CORANK_CHECK(t.group.wait() != tbb::canceled);  // else waiting boxes would be lost
    }
  });
}

void Pool::add_proven(const Postponed& box) {
  Threads::Worker& worker = threads_->workers.local();
  worker.processor.add_proven(box);
  threads_->tally.done_with(box.box.share);
  threads_->count(worker);
}

void Pool::give_up(const Postponed& box, Reason reason) {
  Threads::Worker& worker = threads_->workers.local();
  if (worker.shard.script) worker.shard.script->begin(box.box.node, box.box.x, threads_->variables());
  worker.processor.give_up(box.box.x, reason);
  threads_->tally.done_with(box.box.share);
  threads_->count(worker);
}

bool Pool::cut(const std::vector<Shard*>& shards, std::size_t most) {
  Threads& t = *threads_;
  if (!std::exchange(t.cutting, true)) t.whole = t.tally.begin_cutting();
  std::vector<Proven*> sheets;
  for (Shard* shard : shards)
    for (Proven& sheet : shard->sheets)
      if (!sheet.cut) sheets.push_back(&sheet);
  const std::vector<Waiting> left = take(shards, &Shard::left);
  std::atomic<bool> paused{false};
  execute([&] {
    const auto cut_one = [&](std::size_t i) {
      const UpwardRounding rounding;
      Threads::Worker& worker = t.workers.local();
      if (i < sheets.size()) {
        if (t.tally.pausing()) {
          paused = true;
          return;
        }
        if (worker.shard.found.size() > most) return;
        const Shard::Mark before = worker.shard.mark();
        if (t.whole && t.tally.overdue()) {
          worker.processor.leave({sheets[i]->x, 0, sheets[i]->node});
        } else {
          sheets[i]->cut = worker.processor.cut(*sheets[i], t.whole);
        }
        if (!sheets[i]->cut && !worker.finished) worker.finished = before;
      } else {
        worker.processor.leave(left[i - sheets.size()]);
      }
      t.count(worker);
    };
    const std::size_t all = sheets.size() + left.size();
    if (t.arena.threads() == 1) {
      for (std::size_t i = 0; i < all; ++i) cut_one(i);
    } else {
      tbb::parallel_for(std::size_t{0}, all, cut_one);
    }
  });
  return !paused;
}

std::vector<Shard*> Pool::shards() {
  std::vector<Shard*> all;
  for (Shard& shard : threads_->earlier) all.push_back(&shard);
  for (Threads::Worker& w : threads_->workers) all.push_back(&w.shard);
  return all;
}

std::vector<SearchView::Part> Pool::finished() {
  std::vector<SearchView::Part> all;
  for (const Shard& shard : threads_->earlier) all.push_back({&shard, {}});
  for (const Threads::Worker& w : threads_->workers) all.push_back({&w.shard, w.finished});
  return all;
}

SearchView::Part Pool::end_of_mine() {
  const Shard& shard = threads_->workers.local().shard;
  return {&shard, shard.mark()};
}

std::vector<Shard> Pool::take_shards() {
  std::vector<Shard> all = std::move(threads_->earlier);
  for (Threads::Worker& w : threads_->workers) all.push_back(std::move(w.shard));
  return all;
}

}  // namespace corank::solve
