// `stormproof sensitivity SCENARIO`: which number of a scenario matters.
#pragma once

#include "checker/cli/command_line.hpp"

namespace stormproof::cli {

/// Adds the command with its options to `app`. It sets `chosen`.
void declare_sensitivity(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
