// The monitors, one function each; every one is defined in a file of its own that says what it
// observes. `make_monitor` (props/monitor.hpp) picks by property.
#pragma once

#include <memory>
#include <optional>

#include "props/monitor.hpp"

namespace stormproof::props {

using MonitorPtr = std::unique_ptr<Monitor>;

[[nodiscard]] MonitorPtr watch_event_order(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_acknowledgments(const model::Scenario&);
// Of Cyclone DDS's writer, which samples are numbered for.
[[nodiscard]] MonitorPtr watch_acknowledged_samples();
[[nodiscard]] MonitorPtr watch_acknack_samples();
[[nodiscard]] MonitorPtr watch_repeated_samples();
[[nodiscard]] MonitorPtr watch_directed_heartbeats();
[[nodiscard]] MonitorPtr watch_stalls_of_cyclone(const model::Scenario&);
/// How long a sample may be missing, > 0, once both sides know each other and no packet is lost or
/// takes longer than `one_way`: three times an exchange in which every timer takes its longest
/// time.
[[nodiscard]] model::Nanoseconds patience_with_cyclone(const model::Scenario&);
/// Whether the scenario has it.
[[nodiscard]] bool has_samples(const model::Scenario& scenario);

[[nodiscard]] MonitorPtr watch_repair_requests(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_snapshots(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_conservation(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_heartbeat_timers(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_suppression(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_stalls(const model::Scenario&);
/// `bound` is the longest time that a relation may take from its opening to its last descriptor;
/// without one the monitor only measures.
[[nodiscard]] MonitorPtr watch_completion(const model::Scenario&,
                                          std::optional<model::Nanoseconds> bound = {});
[[nodiscard]] MonitorPtr watch_quiescence(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_single_copies(const model::Scenario&);
/// Of storm.free-threshold or storm.cannot-start.
[[nodiscard]] MonitorPtr watch_needless_repairs(const model::Scenario&, std::string_view property);
[[nodiscard]] MonitorPtr watch_composition(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_stable_acknowledgments(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_progress(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_joins(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_piggybacks(const model::Scenario&);
[[nodiscard]] MonitorPtr watch_feedback(const model::Scenario&);
/// `bound` is the longest time from the last failure to completion; without one it follows from the
/// profile (recovery_bound.hpp).
[[nodiscard]] MonitorPtr watch_recovery(const model::Scenario&,
                                        std::optional<model::Nanoseconds> bound = {});
[[nodiscard]] MonitorPtr watch_isolation(const model::Scenario&);
/// Of a limit of the scenario, by its id (props/limits.hpp); null if it is not set.
[[nodiscard]] MonitorPtr watch_limit(std::string_view id, const model::Scenario&);

}  // namespace stormproof::props
