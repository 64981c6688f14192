// `stormproof simulate --samples N`: distributions over sampled schedules.
#pragma once

#include "checker/cli/simulate_command.hpp"
#include "model/scenario.hpp"

namespace stormproof::cli {

/// Runs `scenario` under sampled schedules, and under the profiles to compare with. Exit code as
/// `simulate`.
[[nodiscard]] int sample(const SimulateArguments& arguments, const model::Scenario& scenario);

}  // namespace stormproof::cli
