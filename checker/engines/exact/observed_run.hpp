// One run of a scenario under monitors.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "model/mutation.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"
#include "props/monitor.hpp"

namespace stormproof::exact {

struct RunPlan {
  const model::Scenario& scenario;       ///< runs
  const model::Scenario& specification;  ///< is what monitors hold it against
  const model::Mutation* mutation = nullptr;
  std::uint64_t max_events = 0;   ///< the run is interrupted after so many; 0: no limit
  std::function<bool()> goes_on;  ///< asked now and then; false interrupts the run
};

struct ObservedRun {
  model::RunResult result;
  model::Nanoseconds known_until;  ///< up to then it is known what happens
  std::vector<std::unique_ptr<props::Monitor>> monitors;
  model::Scenario scenario;  ///< what has run

  [[nodiscard]] const props::Monitor* monitor(std::string_view property) const;
};

/// Runs with the monitors of `properties`, as far as the scenario says.
[[nodiscard]] ObservedRun run_observed(std::span<const std::string_view> properties,
                                       const RunPlan& plan);

inline constexpr std::string_view quiescence = "live.quiescence";

/// Ids of the properties that an ordinary run can show: all of its implementation that have a
/// monitor, but for live.quiescence, which needs a much longer one.
[[nodiscard]] std::vector<std::string_view> ordinary_properties(const model::Scenario& scenario);

/// Runs with the monitor of live.quiescence beyond the completion of discovery, until the bound has
/// passed long ago. Ends early if discovery is not complete within the scenario's time limit.
[[nodiscard]] ObservedRun run_until_quiet(const RunPlan& plan);

}  // namespace stormproof::exact
