// `stormproof sweep GRID -o FILE`: runs all scenarios of a grid, on all cores or under mpirun, and
// keeps the results in SQLite.
#pragma once

#include "checker/cli/command_line.hpp"

namespace stormproof::cli {

/// Exit code: established if all jobs complete discovery, inconclusive if some do not or the sweep
/// was interrupted, bad_input.
void declare_sweep(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
