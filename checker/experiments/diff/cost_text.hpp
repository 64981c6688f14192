// The costs of a comparison as text: one row for each configuration, details where it matters.
#pragma once

#include <string>

#include "checker/experiments/diff/diff.hpp"

namespace stormproof::diff {

/// Empty if nothing was run. `verbose`: all measures of all configurations.
[[nodiscard]] std::string costs_text(const DiffReport& report, bool verbose);

}  // namespace stormproof::diff
