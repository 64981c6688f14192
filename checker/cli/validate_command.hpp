// `stormproof validate CAPTURE…`: predicts what a capture shows, and puts both side by side.
#pragma once

#include "checker/cli/command_line.hpp"

namespace stormproof::cli {

/// Exit code: established if the comparison was made (and is within --within), violated if it is
/// beyond, inconclusive if the observation is incomplete or the runs were interrupted, bad_input.
void declare_validate(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
