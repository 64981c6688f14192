// `stormproof profile show FILE` and `stormproof profile lint FILE…`: what a profile, also in a DDS
// vendor's own XML, really says about discovery.
#pragma once

#include "checker/cli/command_line.hpp"

namespace stormproof::cli {

/// Exit code of show: established, or bad_input. Of lint: established if nothing is a warning or an
/// error, violated if something is, bad_input if a file cannot be read as a profile.
void declare_profile(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
