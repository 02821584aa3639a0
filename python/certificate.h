// Certificates' files in Python: what an analysis has found with its proofs, to be written and checked.
#pragma once

#include <pybind11/stl/filesystem.h>

#include "corank/python/watched.h"
#include "corank/result/verification.h"

namespace corank::python {

template <class File>
py::tuple verify_file(const File& file, int threads, const py::object& progress) {
  return said(progress, [file, threads](Watcher& watcher) {
    check::Options options;
    options.threads = threads;
    options.ended = [&watcher] { return watcher.stop.load(); };
    const auto report = verify(file, options);
    return std::tuple(to_json(report, file), to_table(report, file));
  });
}

/// A class with write(path) and verify(threads, progress), which returns JSON, a table and what ended it.
template <class File, class Write>
void bind_certificate(py::module_& module, const char* name, Write write) {
  py::class_<File, std::shared_ptr<File>>(module, name)
      .def("write", [write](const File& file, const std::filesystem::path& path) { write(path, file); })
      .def("verify", &verify_file<File>);
}

}  // namespace corank::python
