// `stormproof tune SCENARIO`: the settings of the user's DDS library that make discovery short.
#pragma once

#include "checker/cli/command_line.hpp"

namespace stormproof::cli {

/// Adds the command with its options to `app`. It sets `chosen`.
void declare_tune(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
