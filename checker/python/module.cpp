// stormproof._core: what Python gets from the libraries. The package beside it (stormproof/) makes
// it pleasant; nothing is decided here that a verb decides elsewhere.
#include <string>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "checker/cli/in_process.hpp"
#include "checker/python/column.hpp"
#include "checker/python/interruptible.hpp"
#include "checker/python/runs.hpp"
#include "checker/python/scenarios.hpp"

namespace py = pybind11;

namespace {

/// Exit code, standard output, standard error; as bytes, because names of files may be anything.
py::tuple run(const std::vector<std::string>& words) {
  const stormproof::cli::Reply reply = stormproof::python::interruptible(
      [&] { return stormproof::cli::reply_to(words); }, stormproof::cli::interrupt_command);
  return py::make_tuple(reply.exit_code, py::bytes(reply.printed), py::bytes(reply.said));
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.attr("__version__") = STORMPROOF_VERSION;
  stormproof::python::declare_column<double>(module, "Float64Column");
  stormproof::python::declare_column<std::int64_t>(module, "Int64Column");
  stormproof::python::declare_column<std::uint64_t>(module, "UInt64Column");
  stormproof::python::declare_column<std::uint32_t>(module, "UInt32Column");
  stormproof::python::declare_column<std::uint16_t>(module, "UInt16Column");
  stormproof::python::declare_column<std::uint8_t>(module, "UInt8Column");
  stormproof::python::declare_scenarios(module);
  stormproof::python::declare_runs(module);
  module.def("run", run, py::arg("words"));
}
