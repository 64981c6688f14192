// Reads scenarios by the way that every verb takes, so that errors are the same.
#include "checker/python/scenarios.hpp"

#include <exception>
#include <utility>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "model/config/knobs/effective.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::python {

namespace {

namespace py = pybind11;

using model::config::SpecPath;
using Words = std::vector<std::string>;

model::Scenario accepted(model::config::Result<model::Scenario> read) {
  if (!read) throw Refused{read.error()};
  return *std::move(read);
}

Scenario read(const std::string& reference, const Words& overrides) {
  return {accepted(model::config::read_scenario(reference, overrides, SpecPath::standard())),
          reference, "", overrides};
}

Scenario parse(const std::string& text, const std::string& source, const Words& overrides) {
  return {accepted(model::config::parse_scenario(text, source, overrides, SpecPath::standard())),
          source, text, overrides};
}

std::string shown(const Scenario& scenario) {
  const model::Deployment& deployment = scenario.value.deployment;
  std::string words = scenario.reference;
  for (const std::string& override : scenario.overrides) words += ", " + override;
  return fmt::format("<stormproof.Scenario {}: {} participants>", words, deployment.size());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Refused& refused) {
    const py::object type = py::module_::import("stormproof._errors").attr("InputError");
    const py::object error = type(refused.error.where, refused.error.message);
    PyErr_SetObject(type.ptr(), error.ptr());
  }
}

}  // namespace

void declare_scenarios(py::module_& module) {
  py::register_exception_translator(translate);
  py::class_<Scenario>(module, "Scenario")
      .def_static("read", read, py::arg("reference"), py::arg("overrides") = Words{})
      .def_static("parse", parse, py::arg("text"), py::arg("source") = "<text>",
                  py::arg("overrides") = Words{})
      .def_readonly("reference", &Scenario::reference)
      .def_readonly("text", &Scenario::text)
      .def_readonly("overrides", &Scenario::overrides)
      .def_property_readonly("participants",
                             [](const Scenario& self) { return self.value.deployment.size(); })
      .def_property_readonly("is_drawn",
                             [](const Scenario& self) { return model::is_drawn(self.value); })
      .def_property_readonly("seed",
                             [](const Scenario& self) { return model::own_seed(self.value); })
      .def_property_readonly(
          "yaml", [](const Scenario& self) { return model::config::effective_yaml(self.value); })
      .def(
          "__eq__",
          [](const Scenario& self, const Scenario& other) { return self.value == other.value; },
          py::is_operator())
      .def("__repr__", shown);
}

}  // namespace stormproof::python
