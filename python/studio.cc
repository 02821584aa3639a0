// The studio's server, for a process of its own.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <sys/prctl.h>

#include <csignal>

#include "corank/python/bindings.h"
#include "corank/studio/server.h"

namespace corank::python {
namespace {

// Serves until a signal ends this process, or the one that has made it ends.
void serve_studio(const std::string& file, const std::string& text, std::uint16_t port, int threads,
                  const std::function<void(const std::string&)>& on_address) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  studio::Server server({.port = port, .page = {.file = file, .text = text}, .limits = {.threads = threads}});
  on_address(server.address());
  const py::gil_scoped_release unlocked;
  server.run();
}

}  // namespace

void bind_studio(py::module_& module) {
  py::register_exception<studio::ServerError>(module, "ServerError", PyExc_OSError);
  module.def("serve_studio", &serve_studio, py::arg("file"), py::arg("text"), py::arg("port"), py::arg("threads"),
             py::arg("on_address"));
}

}  // namespace corank::python
