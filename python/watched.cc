#include "corank/python/watched.h"

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <set>
#include <thread>

namespace corank::python {
namespace {

constexpr std::chrono::milliseconds kTick(50);  // between two looks at the signals

struct Job {
  Watcher watcher;
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  std::exception_ptr error;
};

std::mutex abandoned_mutex;
std::set<std::shared_ptr<Job>> abandoned;

// True once the job is done; without the interpreter's lock.
bool wait(Job& job, std::chrono::milliseconds time) {
  const py::gil_scoped_release unlocked;
  std::unique_lock lock(job.mutex);
  return job.changed.wait_for(lock, time, [&job] { return job.done; });
}

// What a signal's handler raises now, or None.
py::object signals() {
  if (PyErr_CheckSignals() == 0) return py::none();
  const py::error_already_set error;
  return error.value();
}

py::object say(const py::object& progress, const Progress& news) {
  try {
    progress(news.stage, news.share, news.text);
  } catch (const py::error_already_set& error) {
    return error.value();
  }
  return py::none();
}

}  // namespace

void Watcher::show(Progress progress) {
  const std::lock_guard lock(mutex_);
  news_ = std::move(progress);
}

std::optional<Progress> Watcher::news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, std::nullopt);
}

void Watcher::follow(solve::Control& control) {
  control.progress = [this](const solve::Control::Progress& p) {
    const double share = p.all == 0 ? -1 : static_cast<double>(p.done) / static_cast<double>(p.all);
    show({to_string(p.stage), share, ""});
  };
  control.search_progress = [this, &control](const solve::SearchProgress& p) {
    show({to_string(control.stage()), p.excluded, fmt::format("{} boxes done, {} waiting", p.processed, p.waiting)});
  };
}

py::object run(const py::object& progress, std::function<void(Watcher&)> work) {
  const auto job = std::make_shared<Job>();
  std::thread([job, work = std::move(work)]() mutable {
    try {
      work(job->watcher);
    } catch (...) {
      job->error = std::current_exception();
    }
    work = nullptr;  // what it owns goes before anybody is told
    {
      const std::lock_guard lock(job->mutex);
      job->done = true;
      job->changed.notify_all();
    }
    const std::lock_guard lock(abandoned_mutex);
    abandoned.erase(job);
  }).detach();
  py::object raised = py::none();
  while (!wait(*job, kTick)) {
    if (py::object now = signals(); !now.is_none()) {
      if (!raised.is_none()) {
        const std::lock_guard lock(abandoned_mutex);
        abandoned.insert(job);
        return now;
      }
      raised = std::move(now);
    }
    if (const auto news = job->watcher.news(); news && !progress.is_none() && raised.is_none())
      raised = say(progress, *news);
    if (!raised.is_none()) job->watcher.stop = true;
  }
  if (job->error && raised.is_none()) std::rethrow_exception(job->error);
  // Something so short that the loop never saw the signal.
  if (raised.is_none()) raised = signals();
  return raised;
}

void wait_for_the_abandoned() {
  std::set<std::shared_ptr<Job>> jobs;
  {
    const std::lock_guard lock(abandoned_mutex);
    jobs = abandoned;
  }
  for (const auto& job : jobs)
    while (!wait(*job, kTick))
      if (!signals().is_none()) std::_Exit(130);
}

}  // namespace corank::python
