#include "corank/python/watched.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <thread>
#include <utility>
#include <vector>

namespace corank::python {
namespace {

constexpr std::chrono::milliseconds kTick(50);  // between two looks at the signals

struct Job {
  Watcher watcher;
  std::function<void(Watcher&)> work;
  std::exception_ptr error;
  bool done = false;  ///< under the worker's mutex, like `work`
};

// A thread that does one job after the other. Libraries keep caches for each thread, which a new one for each job would
// lose.
class Worker {
 public:
  Worker() {
    std::thread([this] { serve(); }).detach();
  }
  void give(std::shared_ptr<Job> job) {
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
    changed_.notify_all();
  }
  bool wait(const Job& job, std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, time, [&job] { return job.done; });
  }

 private:
  void serve() {
    while (true) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return job_ != nullptr; });
      const std::shared_ptr<Job> job = std::exchange(job_, nullptr);
      lock.unlock();
      try {
        job->work(job->watcher);
      } catch (...) {
        job->error = std::current_exception();
      }
      job->work = nullptr;  // what it owns goes before anybody is told
      lock.lock();
      job->done = true;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<Job> job_;
};

// Under the interpreter's lock. Workers are never destroyed, for their threads wait until the process ends; a child
// process that was forked has none of them.
struct Workers {
  pid_t process = getpid();
  std::vector<Worker*> idle;
  std::vector<std::pair<Worker*, std::shared_ptr<Job>>> abandoned;
};

Workers& workers() {
  static auto* known = new Workers;
  if (known->process != getpid()) known = new Workers;
  return *known;
}

Worker* take_worker() {
  Workers& all = workers();
  if (all.idle.empty()) return new Worker;
  Worker* worker = all.idle.back();
  all.idle.pop_back();
  return worker;
}

// True once the job is done; without the interpreter's lock.
bool wait(Worker& worker, const Job& job) {
  const py::gil_scoped_release unlocked;
  return worker.wait(job, kTick);
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
    show({to_string(control.stage()), std::clamp(p.excluded, 0.0, 1.0),
          fmt::format("{} boxes done, {} waiting", p.processed, p.waiting)});
  };
}

py::object run(const py::object& progress, std::function<void(Watcher&)> work) {
  const auto job = std::make_shared<Job>();
  job->work = std::move(work);
  Worker* worker = take_worker();
  worker->give(job);
  py::object raised = py::none();
  while (!wait(*worker, *job)) {
    if (py::object now = signals(); !now.is_none()) {
      if (!raised.is_none()) {
        workers().abandoned.emplace_back(worker, job);
        return now;
      }
      raised = std::move(now);
    }
    if (const auto news = job->watcher.news(); news && !progress.is_none() && raised.is_none())
      raised = say(progress, *news);
    if (!raised.is_none()) job->watcher.stop = true;
  }
  workers().idle.push_back(worker);
  if (job->error && raised.is_none()) std::rethrow_exception(job->error);
  // Something so short that the loop never saw the signal.
  if (raised.is_none()) raised = signals();
  return raised;
}

void raise_if_any(const py::object& raised) {
  if (raised.is_none()) return;
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(raised.ptr())), raised.ptr());
  throw py::error_already_set();
}

void wait_for_the_abandoned() {
  for (const auto& [worker, job] : workers().abandoned)
    while (!wait(*worker, *job))
      if (!signals().is_none()) std::_Exit(130);
}

}  // namespace corank::python
