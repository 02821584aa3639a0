// What each file of this folder puts into the module corank._corank.
#pragma once

#include <pybind11/pybind11.h>

namespace corank::python {

namespace py = pybind11;

void bind_expression(py::module_& module);
void bind_model(py::module_& module);
void bind_options(py::module_& module);
void bind_result(py::module_& module);
void bind_solve(py::module_& module);
void bind_analyses(py::module_& module);
void bind_maps(py::module_& module);
void bind_report(py::module_& module);
void bind_studio(py::module_& module);
void bind_cluster(py::module_& module);

}  // namespace corank::python
