// Runs a scenario with all monitors and says what they found.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "model/simulator.hpp"
#include "props/monitor.hpp"

namespace stormproof::props {

struct MonitoredRun {
  model::RunResult result;
  std::vector<std::unique_ptr<Monitor>> monitors;

  /// The violation of the property, or null.
  [[nodiscard]] const Violation* violation(std::string_view property) const;
  /// Ids of the violated properties, separated by spaces.
  [[nodiscard]] std::string violated() const;
  /// All remarks of the property's monitor, one a line.
  [[nodiscard]] std::string remarks(std::string_view property) const;
};

/// Runs `scenario` under the monitors of `specification`.
[[nodiscard]] MonitoredRun run_monitored(const model::Scenario& scenario,
                                         const model::Scenario& specification,
                                         model::RunOptions options = {});
[[nodiscard]] inline MonitoredRun run_monitored(const model::Scenario& scenario) {
  return run_monitored(scenario, scenario);
}

/// A scenario of specs/scenarios with overrides as `--set` takes them; aborts the test program if
/// there is an error.
[[nodiscard]] model::Scenario shipped(const std::string& name,
                                      const std::vector<std::string>& overrides = {});

}  // namespace stormproof::props
