// The extension module corank._corank: thin functions over study/, result/, analyze/ and report/. What users see is made of
// them in corank/*.py.
#include "corank/analyze/paths/path.h"
#include "corank/python/bindings.h"
#include "corank/python/watched.h"
#include "corank/result/cuik/cuik_files.h"
#include "corank/result/files/hdf5_file.h"
#include "corank/result/values/result.h"
#include "corank/solve/step/options.h"
#include "corank/symbolic/model/model_error.h"

namespace corank::python {
namespace {

template <class... Values>
void raise(const char* type, const Values&... values) {
  const py::object error = py::module_::import("corank.errors").attr(type)(values...);
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
}

// Exceptions of corank as those of corank/errors.py, which say in attributes where the fault is.
void bind_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const symbolic::ModelError& e) {
      raise("ModelError", e.what(), e.where().file, e.where().line, e.where().column);
    } catch (const result::CuikFileError& e) {
      raise("ResultFileError", e.what(), e.line());
    } catch (const result::ResultFileError& e) {
      raise("ResultFileError", e.what());
    } catch (const analyze::EndError& e) {
      const py::object text = py::module_::import("corank.errors").attr("in_python")(e.what());
      PyErr_SetObject(PyExc_ValueError, text.ptr());
    } catch (const solve::OptionError& e) {
      raise("OptionError", e.option(), e.reason());
    }
  });
}

}  // namespace
}  // namespace corank::python

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
  bind_studio(module);
  bind_cluster(module);
  py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_the_abandoned));
}
