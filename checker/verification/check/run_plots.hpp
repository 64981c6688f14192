// How discovery of a scenario goes on over time, as plots: what is still missing, what waits, and
// what has been sent. A storm is seen at once: repairs and HEARTBEATs climb while nothing arrives.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::report {

struct RunPlots {
  std::vector<std::string> drawings;  ///< SVG documents
  std::string note;                   ///< plain: which run this is, and how it ended
};

/// Plots of the run of `scenario`, of its first `max_events` events. If start times are drawn, it
/// is the run with the drawn times that the scenario holds.
[[nodiscard]] RunPlots run_plots(const model::Scenario& scenario,
                                 std::uint64_t max_events = 2'000'000);

}  // namespace stormproof::report
