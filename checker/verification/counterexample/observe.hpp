// Running a scenario under the monitor of one property. Whether a counterexample is one is decided
// in exactly one way, here and in `replay`: the scenario runs through the MSM machines, and the
// property's monitor objects.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "model/simulator.hpp"
#include "model/trace/replay.hpp"
#include "props/monitor.hpp"
#include "props/verdict.hpp"

namespace stormproof::counterexample {

/// Runs the scenario until the monitor objects or the run ends by itself, or after `most_events`
/// (0: no limit). `also` hears of the same run, perhaps a little beyond the objection; null:
/// nobody.
std::optional<props::Violation> observe(const model::Scenario& scenario, props::Monitor& monitor,
                                        model::Probe* also = nullptr,
                                        std::uint64_t most_events = 0);

/// What `model::trace::replay` needs to know of properties: the monitors of the catalogue.
[[nodiscard]] model::trace::WatchMaker catalogue_watches();

/// A monitor as a watch of a replay.
[[nodiscard]] std::unique_ptr<model::trace::ViolationWatch> watch_with(
    std::unique_ptr<props::Monitor> monitor);

}  // namespace stormproof::counterexample
