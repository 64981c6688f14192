// The table from properties to knobs. Which rule a property is about stands in the catalogue
// (`Property::source`); these are the knobs of that rule.
#include "checker/verification/check/origins.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "model/config/shown_path.hpp"
#include "model/config/spec_path.hpp"

namespace stormproof::checker {

namespace {

namespace fs = std::filesystem;
using model::config::Place;
using model::config::Places;

struct PropertyKnobs {
  std::string_view property;
  std::vector<std::string_view> keys;
};

const std::vector<PropertyKnobs>& property_knobs() {
  static const std::vector<PropertyKnobs> table{
      {"order.reception-first", {"wireless.kind", "wireless.one_way"}},
      {"safety.ack-implies-received", {"dds.sedp.acknowledge", "dds.sedp.initial_acknack"}},
      {"safety.repair-only-if-asked", {"dds.sedp.initial_data", "dds.sedp.initial_acknack"}},
      {"safety.snapshot", {"dds.sedp.heartbeat_response_delay"}},
      {"safety.conservation", {"wireless.source_queue_bytes", "wireless.order"}},
      {"timer.single-heartbeat", {"dds.sedp.heartbeat_timer", "dds.sedp.heartbeat_period"}},
      {"timer.suppression-honoured",
       {"dds.sedp.nack_suppression_duration", "dds.sedp.nack_response_delay"}},
      {"live.no-stall",
       {"dds.sedp.heartbeat_recipients", "dds.sedp.heartbeat_timer", "dds.sedp.heartbeat_period",
        "dds.sedp.unmatched", "dds.sedp.initial_acknack_delay"}},
      {"live.completion",
       {"dds.sedp.heartbeat_period", "dds.sedp.heartbeat_response_delay",
        "dds.sedp.nack_response_delay", "dds.sedp.nack_suppression_duration",
        "wireless.lost_packets", "time_limit"}},
      {"live.quiescence",
       {"dds.sedp.heartbeat_recipients", "dds.sedp.heartbeat_period", "dds.sedp.heartbeat_policy"}},
      {"storm.single-copy",
       {"dds.sedp.nack_response_delay", "dds.sedp.nack_suppression_duration",
        "dds.sedp.piggyback_threshold_bytes", "dds.sedp.heartbeat_response_delay",
        "dds.sedp.heartbeat_period", "dds.sedp.initial_acknack_delay"}},
      {"storm.free-threshold",
       {"dds.sedp.nack_response_delay", "dds.sedp.heartbeat_response_delay",
        "dds.sedp.initial_acknack_delay", "dds.sedp.heartbeat_period",
        "dds.sedp.piggyback_threshold_bytes"}},
      {"storm.cannot-start",
       {"dds.sedp.heartbeat_response_delay", "dds.sedp.initial_acknack_delay",
        "dds.sedp.nack_suppression_duration", "dds.sedp.nack_response_delay",
        "wireless.rate_unicast", "wireless.overhead_unicast"}},
      {"limit.time", {"time_limit"}},
      {"limit.completion", {"limits.completion"}},
      {"limit.messages", {"limits.messages"}},
      {"limit.amplification", {"limits.amplification"}},
      {"limit.backlog", {"limits.backlog"}}};
  return table;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  const fs::path inside = path.lexically_relative(folder);
  return !inside.empty() && *inside.begin() != "..";
}

bool in_file(const Place& place) { return place.source != nullptr && place.line > 0; }

}  // namespace

std::vector<std::string_view> knobs_of(std::string_view property) {
  const auto& table = property_knobs();
  const auto found = std::ranges::find(table, property, &PropertyKnobs::property);
  return found == table.end() ? std::vector<std::string_view>{} : found->keys;
}

bool by_user(const Place& place, const std::string& own_file) {
  if (place.source == nullptr) return false;
  if (place.line == 0 || *place.source == own_file) return true;
  std::error_code failed;
  const fs::path file = fs::weakly_canonical(*place.source, failed);
  return std::ranges::none_of(model::config::SpecPath::standard().directories,
                              [&](const std::string& folder) {
                                return is_below(file, fs::weakly_canonical(folder, failed));
                              });
}

std::string scenario_file(const Places& places, const std::string& reference) {
  for (const char* key : {"deployment", "time_limit"}) {
    const auto found = places.find(key);
    if (found != places.end() && in_file(found->second)) return *found->second.source;
  }
  return reference;
}

report::Location location_of(std::string_view property, const Places& places,
                             const std::string& reference) {
  const std::string file = scenario_file(places, reference);
  for (const std::string_view key : knobs_of(property)) {
    const auto found = places.find(key);
    if (found == places.end() || !in_file(found->second)) continue;
    if (by_user(found->second, file)) {
      return report::Location{found->second, std::string{key}};
    }
  }
  const auto profile = places.find("dds");
  if (profile != places.end() && in_file(profile->second)) {
    return report::Location{profile->second, "the DDS profile"};
  }
  report::Location whole;
  whole.file = file;
  whole.line = 1;
  whole.message = "the scenario";
  return whole;
}

std::string origin_text(const Place& place) {
  if (place.source == nullptr) return "–";
  const std::string source = model::config::shown_path(*place.source);
  return place.line == 0 ? source : fmt::format("{}:{}", source, place.line);
}

}  // namespace stormproof::checker
