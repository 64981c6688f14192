// Which monitor decides which property. Limits of a scenario have monitors, too, but are not in the
// list of monitored properties: they exist only if the scenario sets them.
#include "props/applicability.hpp"
#include "props/monitors/monitors.hpp"

namespace stormproof::props {

namespace {

struct Entry {
  std::string_view property;
  MonitorPtr (*make)(const model::Scenario&);
};

constexpr Entry makers[] = {
    {"order.reception-first", watch_event_order},
    {"safety.ack-implies-received", watch_acknowledgments},
    {"safety.repair-only-if-asked", watch_repair_requests},
    {"safety.snapshot", watch_snapshots},
    {"safety.conservation", watch_conservation},
    {"safety.ack-stable", watch_stable_acknowledgments},
    {"timer.progress", watch_progress},
    {"timer.single-heartbeat", watch_heartbeat_timers},
    {"timer.suppression-honoured", watch_suppression},
    {"live.no-stall", watch_stalls},
    {"live.completion", [](const model::Scenario& s) { return watch_completion(s); }},
    {"live.quiescence", watch_quiescence},
    {"live.recovery", [](const model::Scenario& s) { return watch_recovery(s); }},
    {"live.isolation", watch_isolation},
    {"storm.join-cost", watch_joins},
    {"storm.piggyback-rate", watch_piggybacks},
    {"storm.feedback-gain", watch_feedback},
    {"storm.single-copy", watch_single_copies},
    {"storm.free-threshold",
     [](const model::Scenario& s) { return watch_needless_repairs(s, "storm.free-threshold"); }},
    {"storm.cannot-start",
     [](const model::Scenario& s) { return watch_needless_repairs(s, "storm.cannot-start"); }},
    {"composition.followed", watch_composition},
};

}  // namespace

std::unique_ptr<Monitor> make_monitor(std::string_view property, const model::Scenario& scenario) {
  for (const Entry& entry : makers) {
    if (entry.property == property) return entry.make(scenario);
  }
  return watch_limit(property, scenario);
}

std::vector<std::string_view> monitored_properties() {
  std::vector<std::string_view> properties;
  for (const Entry& entry : makers) properties.push_back(entry.property);
  return properties;
}

std::vector<std::string_view> monitored_properties(const model::Scenario& scenario) {
  std::vector<std::string_view> properties = monitored_properties();
  std::erase_if(properties, [&](std::string_view property) {
    return !applicability_of(property, scenario).is_decided_by(Engine::exact_run);
  });
  return properties;
}

}  // namespace stormproof::props
