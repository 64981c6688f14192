// Comparison of a run with its capture as a whole: counts, deployment, required keys.
#include "tests/checker/evidence/capture/write_comparison.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/write/capture_probe.hpp"
#include "checker/evidence/capture/write/identities.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/fastdds/matching.hpp"
#include "tests/checker/evidence/capture/written_scenario.hpp"

namespace stormproof::capture::testing {

namespace {

using model::Stream;

std::string text(const model::Counts& counts) {
  std::ostringstream out;
  out << counts.initial_data << ' ' << counts.repair_data << ' ' << counts.heartbeat << ' '
      << counts.acknack << ' ' << counts.spdp_multicast << '+' << counts.spdp_unicast << ' '
      << counts.pdp_data << ' ' << counts.pdp_heartbeat << ' ' << counts.pdp_acknack << ' '
      << counts.gap;
  return out.str();
}

std::string control_difference(const model::RunResult& run, const Counting& counting) {
  std::uint64_t control = 0;
  for (const Traffic traffic :
       {Traffic::liveliness, Traffic::type_lookup, Traffic::other_builtin, Traffic::user}) {
    const TrafficFigures& figures = counting.traffic[static_cast<std::size_t>(traffic)];
    if (figures.data > 0 || figures.gap > 0) return "DATA of user endpoints";
    control += figures.heartbeat + figures.acknack;
  }
  return control == run.user_control ? "" : "control traffic " + std::to_string(control);
}

std::string topology_difference(const model::Scenario& scenario, const model::RunResult& run,
                                const Topology& topology) {
  const auto names = identities(scenario);
  std::map<std::size_t, std::uint32_t> host;  // of the capture, in the deployment
  std::set<std::uint32_t> hosts;
  const bool has_others = std::ranges::any_of(scenario.deployment.participants,
                                              [](const auto& one) { return one.host.value != 0; });
  for (std::uint32_t i = 0; i < names.size(); ++i) {
    const Participant* found = topology.find(names[i].prefix);
    if (i == scenario.deployment.size()) {
      if (run.completed() && (found == nullptr || found != topology.server())) return "no server";
      if (found != nullptr) hosts.insert(0);
      continue;
    }
    const model::Participant& participant = scenario.deployment.participants[i];
    const bool is_local = has_server(scenario) && participant.host.value == 0;
    // The server tells others of it, if there are any.
    if (found == nullptr && is_local && !(run.completed() && has_others)) continue;
    if (found == nullptr) {
      if (run.completed() || participant.start < run.end_time) return names[i].name + " is missing";
      continue;
    }
    const auto [entry, is_new] = host.emplace(found->host, participant.host.value);
    hosts.insert(participant.host.value);
    if (entry->second != participant.host.value) return names[i].name + ": wrong host";
    const bool is_untold = is_local && found->name.empty() && !run.completed();
    if (found->name != names[i].name && !is_untold)
      return names[i].name + ": wrong name " + found->name;
    for (const Stream stream : model::streams) {
      const std::size_t announced = found->announced(
          stream == Stream::pub ? entity::publications_writer : entity::subscriptions_writer);
      const std::uint32_t all = descriptors_of(scenario, i, stream);
      // Of a client on the server's host only what somebody else needs is told.
      const bool fits = run.completed() && !is_local ? announced == all : announced <= all;
      if (!fits) return names[i].name + ": " + std::to_string(announced) + " endpoints";
    }
  }
  return hosts.size() == topology.hosts ? "" : std::to_string(topology.hosts) + " hosts";
}

/// How many descriptors somebody needs whose way is over the link: from clients to the server, and
/// from the server to each client that needs them.
std::uint64_t required_over_link(const model::Scenario& scenario) {
  const model::Topology topology = model::topology_of(scenario);
  const auto& participants = scenario.deployment.participants;
  std::uint64_t required = 0;
  for (std::uint32_t i = 0; i < participants.size(); ++i) {
    for (const Stream stream : model::streams) {
      for (std::uint32_t d = 0; d < descriptors_of(scenario, i, stream); ++d) {
        bool needed = false;
        for (std::uint32_t j = 0; j < participants.size(); ++j) {
          if (j == i || !model::fastdds::has_other_side(topology, j, stream, d)) continue;
          needed = true;
          if (participants[j].host.value != 0) ++required;
        }
        if (needed && participants[i].host.value != 0) ++required;
      }
    }
  }
  return required;
}

}  // namespace

RecordedCapture recorded(const model::Scenario& scenario) {
  EmissionRecorder recorder;
  model::RunOptions options;
  options.probe = &recorder;
  SimulatedCapture capture = simulated_capture(scenario, options);
  return {std::move(capture), recorder.emissions()};
}

Conversation conversation_in(const SimulatedCapture& capture) {
  constexpr std::size_t unpack_limit = std::size_t{1} << 30U;
  const std::vector<MemoryCapture> files{{"simulated.pcap", capture.pcap, unpack_limit}};
  auto conversation = read_conversation(files);
  if (!conversation) {
    ADD_FAILURE() << to_string(conversation.error());
    return {};
  }
  return std::move(*conversation);
}

std::string difference(const model::Scenario& scenario, const model::RunResult& run,
                       const Conversation& conversation) {
  const Counting counting = count(conversation, std::numeric_limits<std::int64_t>::max());
  if (counting.counts != run.counts) {
    return "counts " + text(counting.counts) + " instead of " + text(run.counts);
  }
  if (counting.same_host.total() > 0) return "same-host messages";
  // With static peers announcements go to ports that nobody has, too.
  const bool is_static = scenario.dds.discovery == model::Discovery::static_peers;
  if (counting.unknown_destination > 0 && !is_static) return "unknown destinations";
  if (!conversation.remarks.empty()) return conversation.remarks.front().what;
  const std::uint64_t required =
      has_server(scenario) ? required_over_link(scenario) : counting.counts.initial_data;
  if (run.completed() &&
      (counting.missing_count > 0 || counting.required == 0 || counting.required != required)) {
    return "required keys: " + std::to_string(counting.required) + " instead of " +
           std::to_string(required) + ", missing " + std::to_string(counting.missing_count);
  }
  if (std::string what = control_difference(run, counting); !what.empty()) return what;
  return topology_difference(scenario, run, conversation.topology);
}

}  // namespace stormproof::capture::testing
