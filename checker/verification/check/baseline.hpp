// What is known to fail and accepted, as a file beside the scenarios under version control: a check
// with it fails on anything new. One file serves many scenarios.
//
//   accepted:
//     wifi-5x20:
//       - storm.single-copy in this deployment
#pragma once

#include <map>
#include <string>
#include <vector>

#include "checker/verification/check/gate.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::checker {

/// By scenario, as the command line names it.
using Baseline = std::map<std::string, std::vector<Failure>, std::less<>>;

/// Reads a baseline. Errors have the place in the file and what was expected there: unknown keys,
/// properties and questions.
[[nodiscard]] model::config::Result<Baseline> read_baseline(const std::string& path);

/// The file as text, scenarios and failures in a fixed order.
[[nodiscard]] std::string baseline_text(const Baseline& baseline);

}  // namespace stormproof::checker
