// `stormproof reproduce paper`: the paper's evaluation, beside its published figures.
#pragma once

#include "checker/cli/command_line.hpp"

namespace stormproof::cli {

/// Adds the command with its options to `app`. It sets `chosen`.
void declare_reproduce(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
