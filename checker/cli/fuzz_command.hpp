// `stormproof fuzz SCENARIO`: runs many variants of a scenario, drawn within ranges, and looks for
// one that breaks a property or a limit.
#pragma once

#include "checker/cli/command_line.hpp"

namespace stormproof::cli {

/// Exit code: established if no run of the sample breaks anything, violated if one does,
/// inconclusive if the sample was interrupted or no run finished, bad_input.
void declare_fuzz(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
