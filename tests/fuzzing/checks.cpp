// The laws of accepted scenarios.
#include "tests/fuzzing/checks.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "model/config/knobs/largest_packet.hpp"
#include "model/config/scenario_file.hpp"
#include "model/simulator.hpp"

namespace stormproof::fuzzing {

namespace {

using model::Scenario;
namespace config = model::config;

void check_reads_back(const Scenario& scenario, const std::string& text) {
  const auto again = config::parse_scenario(text, "effective", {}, specs());
  if (!again) std::fprintf(stderr, "%s\n%s\n", to_string(again.error()).c_str(), text.c_str());
  require(static_cast<bool>(again), "an effective scenario is accepted");
  require(*again == scenario, "an effective scenario reads back as an equal one");
}

}  // namespace

void require(bool holds, std::string_view law) {
  if (holds) return;
  std::fprintf(stderr, "broken: %.*s\n", static_cast<int>(law.size()), law.data());
  std::abort();
}

const config::SpecPath& specs() {
  static const config::SpecPath path{{STORMPROOF_SPECS_DIR}};
  return path;
}

bool names_a_device(std::string_view input) {
  for (const std::string_view folder : {"/dev", "/proc", "/sys"}) {
    if (input.find(folder) != std::string_view::npos) return true;
  }
  return false;
}

bool is_small(const Scenario& scenario) {
  constexpr std::uint64_t most_descriptors = 2'000;
  constexpr std::int64_t most_fragments = 100;
  const auto& participants = scenario.deployment.participants;
  const auto& defaults = scenario.dds.descriptors;
  std::uint64_t descriptors = 0;
  for (const model::Participant& participant : participants) {
    descriptors += std::uint64_t{defaults.default_publications} + defaults.default_subscriptions +
                   participant.publications + participant.subscriptions;
  }
  if (participants.size() > 16 || descriptors > most_descriptors) return false;
  const model::Bytes largest = config::largest_packet(scenario).payload;
  return scenario.wireless.kind == model::ServiceKind::constant_delay ||
         model::Fragmentation{scenario.wireless}.count(largest.count()) <= most_fragments;
}

void check_scenario(const Scenario& scenario) {
  constexpr std::size_t most_participants = 200;  // of two hosts with many; written out, one a line
  if (scenario.deployment.participants.size() <= most_participants) {
    check_reads_back(scenario, config::effective_json(scenario).dump());
    check_reads_back(scenario, config::effective_yaml(scenario));
  }
  if (!is_small(scenario)) return;
  model::RunOptions options;
  options.max_events = 300;
  const model::RunResult result = simulate(scenario, options);
  require(result.events <= options.max_events, "max_events ends a run");
  require(result.end_time <= scenario.time_limit, "no event is processed after the time limit");
}

}  // namespace stormproof::fuzzing
