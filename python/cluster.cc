// Searches whose units dask's workers run: what corank.cluster stands on.
#include "corank/python/bindings.h"
#include "corank/python/result.h"
#include "corank/python/watched.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "corank/result/files/checkpoint.h"
#include "corank/solve/store/shard_bytes.h"
#include "corank/study/spread_run.h"

namespace corank::python {
namespace {

using Files = std::vector<std::tuple<std::string, std::string, std::string>>;

py::list bytes_list(const std::vector<std::string>& texts) {
  py::list list;
  for (const std::string& text : texts) list.append(py::bytes(text));
  return list;
}

template <class F>
auto unlocked(F f) {
  const py::gil_scoped_release released;
  return f();
}

result::Checkpoint checkpoint_of(const std::vector<std::string>& arguments, const Files& files,
                                 const std::vector<std::string>& states, std::size_t under_way) {
  result::Checkpoint checkpoint{.arguments = arguments, .files = {}, .states = states, .under_way = under_way};
  for (const auto& [option, name, text] : files) checkpoint.files.push_back({option, name, text});
  return checkpoint;
}

// The client's side: long work of its own runs where Ctrl-C is heard, what is left alone keeps what it needs alive.
class Run {
 public:
  Run(const study::Question& question, const solve::Options& options, int digits) {
    run_ = run_whole(py::none(), [question, options, digits](Watcher&) {
      return std::make_shared<study::SpreadRun>(question, study::Options{options, digits});
    });
  }

  std::size_t searches() const { return run_->searches(); }
  std::size_t finished() const { return run_->finished(); }
  void begin(const std::optional<std::string>& state) {
    run_here([run = run_, state](Watcher&) { run->begin(state); });
  }
  void finish() {
    run_here([run = run_](Watcher&) { run->finish(); });
  }
  Result result() { return Result(run_->result()); }

  py::bytes prepared() { return run_->search().prepared_bytes(); }
  py::tuple next_units(std::size_t threads, double longest, double time) {
    const solve::Pace::Units next = run_->search().next_units(threads, longest, time);
    return py::make_tuple(next.most, next.fewest_boxes, next.seconds);
  }
  py::list take_units(std::size_t wanted, std::size_t fewest_boxes) {
    return bytes_list(unlocked([&] { return run_->search().take_units(wanted, fewest_boxes); }));
  }
  bool add(const py::buffer& answer) {
    const std::shared_ptr<const py::buffer_info> info(new py::buffer_info(answer.request()),
                                                      [](const py::buffer_info* held) {
                                                        const py::gil_scoped_acquire locked;
                                                        delete held;
                                                      });
    if (info->itemsize != 1 || info->ndim != 1 || info->strides[0] != 1)
      throw std::invalid_argument("an answer is an array of bytes");
    const std::string_view bytes(static_cast<const char*>(info->ptr), info->size);
    return unlocked([&] { return run_->search().add(bytes, info); });
  }
  bool done() { return run_->search().done(); }
  bool ended() { return run_->search().ended(); }
  double seconds_left() { return run_->seconds_left(); }
  void keep_state(const std::vector<std::string>& arguments, const Files& files, const std::vector<std::string>& states) {
    unlocked([&] { run_->keep_state(checkpoint_of(arguments, files, states, finished())); });
  }
  double share_done() { return run_->search().share_done(); }
  py::bytes state() {
    return unlocked([&] { return run_->search().state(); });
  }

 private:
  static void run_here(std::function<void(Watcher&)> work) { raise_if_any(python::run(py::none(), std::move(work))); }

  std::shared_ptr<study::SpreadRun> run_;
};

// The worker's side. Units of one search come one after the other: what they share is kept, by each thread.
py::array_t<std::uint8_t> run_unit(std::string_view prepared, std::string_view unit, std::uint64_t boxes, double seconds,
                                   int threads) {
  thread_local std::string known;
  thread_local std::unique_ptr<solve::UnitRunner> runner;
  auto answer = std::make_unique<std::string>(unlocked([&] {
    if (!runner || known != prepared) {
      runner = std::make_unique<solve::UnitRunner>(prepared);
      known = prepared;
    }
    return runner->run(unit, {.boxes = boxes, .seconds = seconds, .threads = threads});
  }));
  const std::string& bytes = *answer;
  const py::capsule owner(answer.release(), [](void* text) { delete static_cast<std::string*>(text); });
  return py::array_t<std::uint8_t>(static_cast<py::ssize_t>(bytes.size()),
                                   reinterpret_cast<const std::uint8_t*>(bytes.data()), owner);
}

void write_checkpoint(const std::filesystem::path& path, const std::vector<std::string>& arguments, const Files& files,
                      const std::vector<std::string>& states, std::size_t under_way, std::string_view state) {
  const py::gil_scoped_release unlocked;
  result::write_checkpoint(path, solve::engine_version(), checkpoint_of(arguments, files, states, under_way),
                           [state](std::ostream& out) { out << state; });
}

py::tuple read_checkpoint(const std::filesystem::path& path) {
  const result::Checkpoint c = result::read_checkpoint(path, solve::engine_version());
  py::list files;
  for (const auto& file : c.files) files.append(py::make_tuple(file.option, file.path, file.text));
  return py::make_tuple(c.arguments, files, bytes_list(c.states));
}

}  // namespace

void bind_cluster(py::module_& module) {
  module.attr("engine_version") = solve::engine_version();
  module.attr("most_unit_threads") = solve::kMostUnitThreads;
  py::class_<Run>(module, "SpreadRun")
      .def(py::init<const study::Question&, const solve::Options&, int>())
      .def_property_readonly("searches", &Run::searches)
      .def_property_readonly("finished", &Run::finished)
      .def("begin", &Run::begin)
      .def("finish", &Run::finish)
      .def("result", &Run::result)
      .def_property_readonly("prepared", &Run::prepared)
      .def("take_units", &Run::take_units, py::arg("wanted"), py::arg("fewest_boxes") = 1)
      .def("next_units", &Run::next_units, py::arg("threads"), py::arg("longest"), py::arg("time"))
      .def("add", &Run::add)
      .def_property_readonly("done", &Run::done)
      .def_property_readonly("ended", &Run::ended)
      .def_property_readonly("seconds_left", &Run::seconds_left)
      .def("keep_state", &Run::keep_state)
      .def_property_readonly("share_done", &Run::share_done)
      .def("state", &Run::state);
  module.def("run_unit", &run_unit);
  module.def("write_checkpoint", &write_checkpoint);
  module.def("read_checkpoint", &read_checkpoint);
}

}  // namespace corank::python
