// Options, and from a model's question to a result.
#include "corank/python/bindings.h"
#include "corank/python/result.h"
#include "corank/python/watched.h"

#include <pybind11/stl.h>

#include "corank/solve/store/memory.h"
#include "corank/study/answer.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::python {
namespace {

solve::Options default_options() {
  solve::Options options;
  options.threads = 0;
  options.memory_limit = solve::machine_memory() / 4 * 3;
  return options;
}

// The result, and what Ctrl-C or the progress function raised.
py::tuple solve_question(const study::Question& question, const solve::Options& options, int digits,
                         const py::object& progress) {
  options.validate();
  return said(progress, [question, options, digits](Watcher& watcher) {
    solve::Control control(limits_of(options, &watcher.stop));
    watcher.follow(control);
    return std::tuple(Result(study::answer(study::systems_of(question, control), {options, digits}, control)));
  });
}

std::string derivation(const study::Question& question, const std::string& format) {
  const std::vector<symbolic::TrigonometricSystem> systems = study::equations_of_parts(question);
  if (format == "cuik") return symbolic::to_cuik(symbolic::algebrize(systems.front()));
  const symbolic::Derivation d = symbolic::derive(question.model);
  return format == "latex" ? symbolic::to_latex(d, systems) : symbolic::to_text(d, systems);
}

std::string derive(const study::Question& question, const std::string& format) {
  if (format != "text" && format != "latex" && format != "cuik")
    throw std::invalid_argument("the format is text, latex or cuik, not '" + format + "'");
  if (format == "cuik" && (symbolic::definition(question.set).of_parts || question.in_parts.value_or(false)))
    throw std::invalid_argument("format cuik: the set consists of several systems");
  return run_whole(py::none(), [question, format](Watcher&) { return derivation(question, format); });
}

}  // namespace

void bind_options(py::module_& module) {
  py::class_<solve::Options>(module, "Options")
      .def(py::init(&default_options))
      .def_readwrite("sigma", &solve::Options::sigma)
      .def_readwrite("sigma_length", &solve::Options::sigma_length)
      .def_readwrite("sigma_angle", &solve::Options::sigma_angle)
      .def_readwrite("coarser", &solve::Options::coarser)
      .def_readwrite("surfaces_whole", &solve::Options::surfaces_whole)
      .def_readwrite("threads", &solve::Options::threads)
      .def_readwrite("max_boxes", &solve::Options::max_boxes)
      .def_readwrite("max_found", &solve::Options::max_found)
      .def_readwrite("max_solutions", &solve::Options::max_solutions)
      .def_readwrite("time_limit", &solve::Options::time_limit)
      .def_readwrite("memory_limit", &solve::Options::memory_limit)
      .def_readwrite("proof", &solve::Options::proof)
      .def("validate", [](const solve::Options& options) { options.validate(); });
}

void bind_solve(py::module_& module) {
  module.def("solve", &solve_question);
  module.def("derive", &derive);
  // What a call costs by itself: bench/python_bench.py.
  module.def("do_nothing", [] { run(py::none(), [](Watcher&) {}); });
}

}  // namespace corank::python
