// `stormproof coverage OBSERVATIONS.jsonl`: predicts every measured configuration and says how well
// the prediction fits.
#pragma once

#include "checker/cli/command_line.hpp"

namespace stormproof::cli {

/// Exit code: established if everything was predicted, inconclusive if interrupted, bad_input.
void declare_coverage(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
