// `stormproof diff BASE CANDIDATE`: what a change of a DDS profile does to discovery.
#pragma once

#include "checker/cli/command_line.hpp"

namespace stormproof::cli {

/// Adds the command with its options to `app`. It sets `chosen`.
void declare_diff(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
