// Long work on behalf of Python: it runs without the interpreter's lock on a thread of its own, while the thread that
// asked for it shows its progress and listens for Ctrl-C.
//
// What ends it early is asked for by a flag (Watcher::stop); the work then returns what it has. A second Ctrl-C leaves
// the work alone: it ends by itself, and nobody sees its result.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>

#include "corank/result/files/verification.h"
#include "corank/solve/step/control.h"

namespace corank::python {

namespace py = pybind11;

struct Progress {
  std::string stage;
  double share = -1;  ///< of the stage, 0 … 1; below 0: it does not say
  std::string text;   ///< what else there is to say, in words
};

/// What the thread that works and the one that waits share.
class Watcher {
 public:
  std::atomic<bool> stop{false};

  /// From any thread.
  void show(Progress progress);
  /// The control's progress; the watcher has to outlive its run.
  void follow(solve::Control& control);
  /// The last progress, where there was any since the last call.
  std::optional<Progress> news();

 private:
  std::mutex mutex_;
  std::optional<Progress> news_;
};

/// Does the work. `progress`: None, or a function of a stage, a share and a text. Returns None, or the exception that a
/// signal's handler (KeyboardInterrupt) or the function has raised, which made the flag be set; throws what the work
/// throws. The work may go on after this call, so it owns all that it uses and touches nothing of Python's.
py::object run(const py::object& progress, std::function<void(Watcher&)> work);

/// Raises what run() has returned, unless it is None.
void raise_if_any(const py::object& raised);

/// The same of work that has a value: the value and that exception. Where the work was left alone, throws the exception.
template <class Work>
auto run_for(const py::object& progress, Work work) {
  using Value = std::invoke_result_t<Work, Watcher&>;
  const auto value = std::make_shared<std::optional<Value>>();
  const auto finished = std::make_shared<std::atomic<bool>>(false);
  const py::object raised = run(progress, [value, finished, work = std::move(work)](Watcher& watcher) {
    *value = work(watcher);
    *finished = true;
  });
  if (!*finished) raise_if_any(raised);
  return std::pair<Value, py::object>(std::move(**value), raised);
}

/// The same where an early end leaves nothing of worth: its exception is thrown.
template <class Work>
auto run_whole(const py::object& progress, Work work) {
  auto [value, raised] = run_for(progress, std::move(work));
  raise_if_any(raised);
  return std::move(value);
}

/// The same of work that has a tuple: its values and that exception, for Python.
template <class Work>
py::tuple said(const py::object& progress, Work work) {
  auto known = run_for(progress, std::move(work));
  return std::apply([&known](auto&... values) { return py::make_tuple(std::move(values)..., known.second); }, known.first);
}

/// Work under a control with this limit of time, which shows its progress.
template <class Work>
auto within(double seconds, Work work) {
  return [seconds, work = std::move(work)](Watcher& watcher) {
    solve::Control control({.time = seconds, .stop = &watcher.stop});
    watcher.follow(control);
    return work(control);
  };
}

/// At the interpreter's end: waits for work that was left alone.
void wait_for_the_abandoned();

template <class File>
py::tuple verify_file(const File& file, int threads, const py::object& progress) {
  return said(progress, [file, threads](Watcher& watcher) {
    const check::Options options{.threads = threads, .progress = {}, .ended = [&watcher] { return watcher.stop.load(); }};
    const auto report = verify(file, options);
    return std::tuple(to_json(report, file), to_table(report, file));
  });
}

/// A class with write(path) and verify(threads, progress), which returns JSON, a table and what ended it.
template <class File, class Write>
void bind_certificate(py::module_& module, const char* name, Write write) {
  py::class_<File, std::shared_ptr<File>>(module, name)
      .def("write", [write](const File& file, const std::filesystem::path& path) { write(path, file, {}); })
      .def("verify", &verify_file<File>);
}

}  // namespace corank::python
