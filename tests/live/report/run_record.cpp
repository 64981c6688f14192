// The files of a run, as one record.
#include "tests/live/report/run_record.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace stormproof::live {

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::int64_t default_endpoints = 17;

/// Applies `use` to the JSON of a file; whatever is wrong with it is said with the file's name.
template <typename Use>
void with_json(const fs::path& path, Use&& use) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  try {
    use(Json::parse(file));
  } catch (const Json::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

std::int64_t integer(const Json& json, const char* key) { return json.at(key).get<std::int64_t>(); }

CaptureReport capture_of(const Json& json) {
  return {.packets = integer(json, "packets"),
          .dropped = integer(json, "dropped"),
          .interface_dropped = integer(json, "interface_dropped"),
          .socket_dropped = integer(json, "socket_dropped")};
}

void read_setting(const Json& json, RunRecord& run) {
  run.link = json.at("link").get<std::string>();
  run.discovery = json.value("discovery", run.discovery);
  run.sedp_multicast = json.value("sedp_multicast", false);
  run.participants_per_host = integer(json, "participants_per_host");
  run.endpoints_per_participant = integer(json, "endpoints_per_participant");
  run.start_ns = integer(json, "start_ns");
  run.limit_ns = integer(json, "limit_ns");
  run.waited_ns = integer(json, "waited_ns");
  for (const Json& capture : json.at("captures")) run.captures.push_back(capture_of(capture));
  run.hosts = static_cast<std::int64_t>(run.captures.size());
}

ParticipantReport participant_of(const Json& json) {
  return {.created_ns = integer(json, "created_ns"),
          .endpoints_done_ns = integer(json, "endpoints_done_ns"),
          .app_ns = integer(json, "app_ns"),
          .strict_ns = integer(json, "strict_ns"),
          .matches = integer(json, "matches"),
          .matches_expected = integer(json, "matches_expected"),
          .discovered = integer(json, "discovered"),
          .discovered_expected = integer(json, "discovered_expected")};
}

void read_summary(const Json& json, RunRecord& run) {
  const Json& counts = json.at("counts");
  // With a server its announcements are counted apart.
  const std::int64_t of_server = counts.contains("pdp_data") ? integer(counts, "pdp_data") : 0;
  run.counts = {
      .spdp = integer(counts, "spdp_multicast") + integer(counts, "spdp_unicast") + of_server,
      .initial_data = integer(counts, "initial_data"),
      .repair_data = integer(counts, "repair_data"),
      .heartbeat = integer(counts, "heartbeat"),
      .acknack = integer(counts, "acknack"),
      .total = integer(counts, "total")};
  run.required_keys = integer(json.at("missing"), "required");
  run.missing_keys = integer(json.at("missing"), "count");
  for (const Json& participant : json.at("topology").at("participants")) {
    run.captured.push_back({.publications = integer(participant, "publications"),
                            .subscriptions = integer(participant, "subscriptions")});
  }
}

/// Participants go on for a moment after the limit.
void forget_what_came_too_late(RunRecord& run) {
  const std::int64_t limit = run.start_ns + run.limit_ns;
  for (ParticipantReport& participant : run.participants) {
    if (participant.app_ns > limit) participant.app_ns = 0;
    if (participant.strict_ns > limit) participant.strict_ns = 0;
  }
}

std::int64_t latest(const RunRecord& run, std::int64_t ParticipantReport::*instant) {
  std::int64_t last = run.start_ns;
  for (const ParticipantReport& participant : run.participants) {
    last = std::max(last, participant.*instant);
  }
  return last - run.start_ns;
}

}  // namespace

std::int64_t RunRecord::expected_initial() const {
  const std::int64_t endpoints = default_endpoints + endpoints_per_participant;
  const std::int64_t elsewhere = (hosts - 1) * participants_per_host;
  if (!has_server()) return hosts * participants_per_host * elsewhere * endpoints;
  // On topics with both sides: ros_discovery_info, parameter_events, and the user's.
  const std::int64_t matching = 4 + endpoints_per_participant / 2 * 2;
  const std::int64_t told = discovery == "super_client" ? endpoints : matching;
  return elsewhere * (endpoints + (hosts * participants_per_host - 1) * told);
}

bool RunRecord::is_complete() const {
  return participants.size() == static_cast<std::size_t>(hosts * participants_per_host) &&
         std::all_of(participants.begin(), participants.end(),
                     [](const ParticipantReport& report) { return report.is_complete(); });
}

std::int64_t RunRecord::app_duration_ns() const {
  return latest(*this, &ParticipantReport::app_ns);
}

std::int64_t RunRecord::strict_duration_ns() const {
  return latest(*this, &ParticipantReport::strict_ns);
}

RunRecord read_run(const fs::path& folder) {
  RunRecord run;
  run.name = folder.filename().string();
  with_json(folder / "run.json", [&run](const Json& json) { read_setting(json, run); });
  with_json(folder / "summary.json", [&run](const Json& json) { read_summary(json, run); });
  // Not there if the run is held against no profile, or the check did not come to an end.
  if (fs::exists(folder / "conformance.json")) {
    with_json(folder / "conformance.json", [&run](const Json& json) {
      run.conformance = json.at("verdict").get<std::string>();
    });
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "participants")) {
    if (entry.path().extension() != ".json") continue;
    with_json(entry.path(),
              [&run](const Json& json) { run.participants.push_back(participant_of(json)); });
  }
  forget_what_came_too_late(run);
  return run;
}

}  // namespace stormproof::live
