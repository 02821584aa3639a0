// The extension module corank._corank: thin functions over study/, result/, analyze/ and report/. What users see is made of
// them in corank/*.py.
#include <pybind11/pybind11.h>

#include "corank/python/bindings.h"
#include "corank/python/watched.h"
#include "corank/result/result.h"

PYBIND11_MODULE(_corank, module) {
  using namespace corank::python;
  module.doc() = "The C++ part of corank; use the package corank, which is built on it.";
  module.attr("__version__") = corank::result::version();
  bind_errors();
  bind_expression(module);
  bind_model(module);
  bind_options(module);
  bind_result(module);
  bind_solve(module);
  bind_analyses(module);
  bind_maps(module);
  bind_report(module);
  bind_cluster(module);
  py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_the_abandoned));
}
