#include "corank/study/early_searches.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

#include "corank/core/threads.h"
#include "corank/symbolic/model/set_definition.h"

namespace corank::study {
namespace {

std::uint64_t lesser(std::uint64_t limit, std::uint64_t most) { return limit > 0 ? std::min(limit, most) : most; }

bool goes_without_model(std::optional<symbolic::SingularitySet> set) {
  const symbolic::SetDefinition& definition = symbolic::definition(set);
  return !definition.of_parts && definition.part != symbolic::LocusPart::nodes;
}

std::size_t workers(std::size_t tasks, int asked) {
  const int threads = threads_for(asked);
  return threads > 1 ? std::min(tasks, static_cast<std::size_t>(threads)) : 0;
}

std::optional<Cover> search(const EarlyTask& task) {
  if (!goes_without_model(task.set)) return std::nullopt;
  solve::Control::Limits limits = task.limits;
  limits.boxes = lesser(limits.boxes, EarlySearches::kBoxes);
  limits.memory = lesser(limits.memory, EarlySearches::kBytes);
  solve::Control control(limits);
  Options options = task.options;
  options.search.threads = 1;
  const solve::Prepared prepared = solve::prepare(task.system, options.search, control);
  Cover cover = solve::solve(prepared, control);
  if (control.ending()) return std::nullopt;
  solve::settle(prepared, {task.labelling, options.digits}, cover, control);
  if (control.ending() || !cover.complete()) return std::nullopt;
  if (task.then) task.then(cover);
  return cover;
}

std::size_t kinds(const std::vector<EarlyTask>& tasks) {
  std::size_t last = 0;
  for (const EarlyTask& task : tasks) last = std::max(last, task.kind);
  return last + 1;
}

}  // namespace

EarlySearches::EarlySearches(std::vector<EarlyTask> tasks, int threads)
    : tasks_(std::move(tasks)),
      workers_(workers(tasks_.size(), threads)),
      done_(tasks_.size(), workers_ == 0),
      not_small_(kinds(tasks_)),
      found_(tasks_.size()) {
  try {
    for (std::size_t k = 0; k < workers_; ++k) threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {  // the machine grants no more of them
    if (threads_.empty()) done_.assign(tasks_.size(), true);
  }
}

EarlySearches::~EarlySearches() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void EarlySearches::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    // Not far ahead: what is found takes memory, and an interrupt would throw it away.
    changed_.wait(lock, [this] { return over_ || next_ >= tasks_.size() || next_ < asked_ + 2 * workers_; });
    if (over_ || next_ >= tasks_.size()) return;
    const std::size_t i = next_++, kind = tasks_[i].kind;
    if (!not_small_[kind]) {
      lock.unlock();
      std::optional<Cover> found;
      try {
        found = search(tasks_[i]);
      } catch (const std::exception&) {  // it will be thrown again, in its turn
      }
      lock.lock();
      not_small_[kind] = not_small_[kind] || !found;
      found_[i] = std::move(found);
    }
    done_[i] = true;
    changed_.notify_all();
  }
}

std::optional<Cover> EarlySearches::take(std::size_t i) {
  std::unique_lock lock(mutex_);
  asked_ = i;
  changed_.notify_all();
  changed_.wait(lock, [&] { return done_[i]; });
  return std::exchange(found_[i], std::nullopt);
}

}  // namespace corank::study
