// Runs of a scenario: many of them as columns, or one with everything that happens in it.
#pragma once

#include <pybind11/pybind11.h>

namespace stormproof::python {

void declare_runs(pybind11::module_& module);

}  // namespace stormproof::python
