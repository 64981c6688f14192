// A scenario as Python has it: the value that runs take, and the words by which a verb reads the
// same.
#pragma once

#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "model/config/tree/result.hpp"
#include "model/scenario.hpp"

namespace stormproof::python {

/// Becomes stormproof.InputError, which takes the place apart.
struct Refused {
  model::config::InputError error;
};

struct Scenario {
  model::Scenario value;
  std::string reference;               ///< name or path; of a text, what it is called
  std::string text;                    ///< empty: `reference` can be read
  std::vector<std::string> overrides;  ///< "key.path=value"
};

/// The class Scenario, and the exception for whatever a user got wrong.
void declare_scenarios(pybind11::module_& module);

}  // namespace stormproof::python
