// `stormproof capture summarize FILE…`: what a capture of real discovery holds, counted as the
// paper counts.
#pragma once

#include <CLI/CLI.hpp>

#include "checker/cli/command_line.hpp"

namespace stormproof::cli {

/// Adds the command with its options. Exit code: established if every required descriptor key is
/// in the capture, inconclusive if some are missing or it was interrupted, bad_input.
void declare_capture(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
