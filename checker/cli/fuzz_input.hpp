// What the user asked `stormproof fuzz` for, and the scenario and ids that follow from it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/config/tree/result.hpp"
#include "model/scenario.hpp"

namespace stormproof::cli {

struct FuzzArguments {
  std::string scenario;                 ///< file, or name of a shipped scenario
  std::vector<std::string> overrides;   ///< key.path=value
  std::vector<std::string> properties;  ///< ids to judge by; empty: all
  std::vector<std::string> limits;      ///< NAME=VALUE
  /// Ranges, as written: empty if not given, "0" for none.
  std::string start_jitter, loss, sizes, delays, timers;
  std::vector<std::string> vary;    ///< KEY=LOW..HIGH
  std::optional<std::size_t> runs;  ///< not given: 200, or as many as `seconds` allows
  std::optional<double> seconds;    ///< no run starts later
  std::uint64_t seed = 0;
  std::uint64_t first = 0;       ///< number of the first variant
  std::size_t jobs = 0;          ///< threads; 0: one for each core
  std::string output_directory;  ///< empty: the usual one
};

/// The scenario with the limits and ranges of the options.
[[nodiscard]] model::config::Result<model::Scenario> read_scenario(const FuzzArguments& arguments);

/// The properties and limits to judge by; none: all. Errors: one is unknown, or cannot be judged in
/// runs of the scenario.
[[nodiscard]] model::config::Result<std::vector<std::string>> ids_to_judge(
    const FuzzArguments& arguments, const model::Scenario& scenario);

}  // namespace stormproof::cli
