// The tables of the deployment, in its two forms, and of the scenario that joins everything. See
// knobs.hpp for what visits them.
#pragma once

#include <algorithm>

#include <fmt/core.h>

#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/knobs/host_knobs.hpp"
#include "model/config/knobs/knobs.hpp"
#include "model/config/knobs/largest_packet.hpp"
#include "model/config/knobs/life_knobs.hpp"
#include "model/config/knobs/mixed_profiles.hpp"
#include "model/config/knobs/type_knobs.hpp"
#include "model/config/knobs/value_types.hpp"
#include "model/config/knobs/wireless_knobs.hpp"
#include "model/scenario.hpp"
#include "model/servers.hpp"

namespace stormproof::model::config {

/// The short form of a deployment: equal hosts with equal participants, which all start at 0 unless
/// there is a schedule.
struct HomogeneousForm {
  std::uint32_t hosts = 2;
  std::uint32_t participants_per_host = 1;
  std::uint32_t endpoints_per_participant = 2;
  std::uint32_t nodes_per_participant = 1;
};

/// One node, or several that are alike.
struct NodeEntry {
  std::string name;  ///< for people; nothing depends on it
  std::uint32_t publications = 0;
  std::uint32_t subscriptions = 0;
  std::uint32_t count = 1;
};

/// A deployment by its nodes: equal hosts with all of them each, which all start at 0 unless there
/// is a schedule.
struct NodesForm {
  std::uint32_t hosts = 2;
  std::vector<NodeEntry> nodes;
  std::uint32_t nodes_per_participant = 1;
};

/// Keys that the reader treats in a way of their own.
inline constexpr std::string_view nodes_key = "nodes";
inline constexpr std::string_view participants_key = "participants";
inline constexpr std::string_view schedule_key = "schedule";
inline constexpr std::string_view start_key = "start";
inline constexpr std::string_view endpoints_done_key = "endpoints_done";
inline constexpr std::string_view open_key = "open";
inline constexpr std::string_view ready_key = "ready";
inline constexpr std::string_view open_before_key = "open_before";
inline constexpr std::string_view servers_key = "servers";

inline constexpr NumberType participant_count = count_range(1, Deployment::max_participants);

void visit_knobs(auto& visit, Is<HomogeneousForm> auto& form) {
  visit.knob(hosts_key, form.hosts, participant_count, "number of hosts (N_H), or a list of them");
  visit.knob("participants_per_host", form.participants_per_host, participant_count,
             "participants on each host (N_P)");
  visit.knob("endpoints_per_participant", form.endpoints_per_participant, endpoint_count,
             "user endpoints of each participant, half of them publications, rounded up (N_E)");
  visit.knob("nodes_per_participant", form.nodes_per_participant, participant_count,
             "so many of these participants become nodes of one, as in a component container: its "
             "endpoints are those of all, and what each further node brings; 1 if absent",
             Presence::optional);
  const std::uint64_t nodes = std::min(form.nodes_per_participant, form.participants_per_host);
  visit.rule(
      nodes * (form.endpoints_per_participant + std::uint64_t{Deployment::endpoints_of_a_node}) <=
              Deployment::max_endpoints ||
          nodes == 1,
      "nodes_per_participant",
      fmt::format("at most {} endpoints of one participant", Deployment::max_endpoints));
  visit.rule(std::uint64_t{form.hosts} * form.participants_per_host <= Deployment::max_participants,
             "participants_per_host",
             fmt::format("at most {} participants in all (hosts × participants_per_host)",
                         Deployment::max_participants));
}

void visit_knobs(auto& visit, Is<NodeEntry> auto& node) {
  visit.knob("name", node.name, TextType{}, "of the node; nothing depends on it",
             Presence::optional);
  visit.knob("publications", node.publications, endpoint_count, "user publications");
  visit.knob("subscriptions", node.subscriptions, endpoint_count, "user subscriptions");
  visit.knob("count", node.count, participant_count, "so many nodes are like this; 1 if absent",
             Presence::optional);
}

void visit_knobs(auto& visit, Is<NodesForm> auto& form) {
  visit.knob("hosts", form.hosts, participant_count, "number of hosts, each with all nodes (N_H)");
  visit.list(nodes_key, form.nodes, ListSize{1, Deployment::max_participants},
             "the nodes of each host, in the order in which they share participants");
  visit.knob("nodes_per_participant", form.nodes_per_participant, participant_count,
             "so many nodes of a host are in one participant, as in a component container; 1 if "
             "absent",
             Presence::optional);
  std::uint64_t nodes = 0;
  std::uint64_t endpoints = 0;
  for (const NodeEntry& node : form.nodes) {
    nodes += node.count;
    endpoints += node.count * (std::uint64_t{Deployment::endpoints_of_a_node} + node.publications +
                               node.subscriptions);
  }
  visit.rule(nodes * form.hosts <= Deployment::max_participants, nodes_key,
             fmt::format("at most {} nodes in all (hosts × nodes)", Deployment::max_participants));
  visit.rule(endpoints <= Deployment::max_endpoints || form.nodes_per_participant == 1, nodes_key,
             fmt::format("at most {} endpoints of the nodes of a host that share participants",
                         Deployment::max_endpoints));
}

void visit_knobs(auto& visit, Is<Participant> auto& participant) {
  visit.knob("host", participant.host.value, count_range(0, Deployment::max_participants - 1),
             "number of its host");
  visit.knob("publications", participant.publications, endpoint_count, "user publications");
  visit.knob("subscriptions", participant.subscriptions, endpoint_count, "user subscriptions");
  visit.knob(start_key, participant.start, delay_range, "when it starts; 0 if absent",
             Presence::optional);
  visit.knob(endpoints_done_key, participant.endpoints_done, delay_range,
             "when it has created all its endpoints, not before its start, which it is if absent; "
             "used by implementation: fastdds and cyclone",
             Presence::optional);
  visit.knob(open_key, participant.open, delay_range,
             "what reaches it before is lost; not after its start, which it is if absent; used by "
             "implementation: cyclone",
             Presence::optional);
  visit.knob(ready_key, participant.ready, delay_range,
             "what reaches it before is received then, in a life under Fast DDS lost; not before "
             "its start, which it is if absent; used by implementation: cyclone, and in lives",
             Presence::optional);
  visit.section(own_profile_key, participant.dds,
                "its DDS profile, of the implementation of the scenario's; that of its host or of "
                "the scenario if absent",
                Presence::optional);
  visit.knob(servers_key, participant.servers,
             SomeNumbersType{{count_range(0, Deployment::max_participants - 1)}},
             "numbers of the deployment's servers that it is a client of, as the places of "
             "ROS_DISCOVERY_SERVER; of all if absent",
             Presence::optional);
}

void visit_knobs(auto& visit, Is<DiscoveryServer> auto& server) {
  visit.knob("host", server.host.value, count_range(0, Deployment::max_participants - 1),
             "number of its host");
  visit.knob(
      servers_key, server.servers,
      SomeNumbersType{{count_range(0, Deployment::max_participants - 1)}},
      "numbers of other servers that it looks for, to share with them what it knows; none if "
      "absent",
      Presence::optional);
}

void visit_knobs(auto& visit, Is<Schedule> auto& schedule) {
  visit.knob(start_key, RangeParts{schedule.start_min, schedule.start_max},
             DurationRangeType{delay_range},
             "range of the participants' starts; all start at 0 if absent", Presence::optional);
  visit.knob(
      endpoints_done_key, RangeParts{schedule.endpoints_done_min, schedule.endpoints_done_max},
      DurationRangeType{delay_range},
      "range of the participants' endpoints_done; that of start if absent", Presence::optional);
  visit.knob(open_before_key, schedule.open_before, delay_range,
             "how long before its start a participant hears; what reaches it before is lost; used "
             "by implementation: cyclone",
             Presence::optional);
  visit.knob("seed", schedule.seed, SeedType{}, "of the draw; 0 if absent", Presence::optional);
}

/// What both forms of a deployment have.
void visit_common_knobs(auto& visit, Is<Deployment> auto& deployment) {
  visit.knob(
      "loopback_delay", deployment.loopback_delay, delay_range,
      "delay of packets to the same host; 2ms if absent; used by implementation: fastdds and "
      "cyclone",
      Presence::optional);
  visit.knob(
      "send_time", deployment.send_time, delay_range,
      "between two packets of a participant; 50us if absent; used by implementation: cyclone",
      Presence::optional);
  visit.knob("send_cost", deployment.send_cost, delay_range,
             "between two datagrams of a Discovery Server; 50us if absent; used by discovery: "
             "server and super_client",
             Presence::optional);
  visit.list(servers_key, deployment.servers, ListSize{0, Deployment::max_participants},
             "Discovery Servers, numbered from 0 in this order, after all participants where those "
             "are numbered; one on host 0 if absent; used by discovery: server and super_client",
             Presence::optional);
  visit.section("types", deployment.types,
                "endpoints say which type their topic has, and participants ask for those that "
                "they do not know; with implementation: fastdds and no Discovery Server",
                Presence::optional);
  visit_fleet_knobs(visit, deployment);
  visit.section("life", deployment.life,
                "what happened before the run, and what happens to participants in it; with "
                "dds.amendments or implementation: fastdds",
                Presence::optional);
  visit.section(schedule_key, deployment.schedule,
                "ranges that all start and endpoints_done are drawn from, uniformly; a time that a "
                "participant gives beside it has to be the drawn one",
                Presence::optional);
}

/// The hosts one by one. In the short form the same key may be their number.
void visit_hosts(auto& visit, Is<Deployment> auto& deployment) {
  visit.list(hosts_key, deployment.hosts, ListSize{1, Deployment::max_participants},
             "the hosts, numbered from 0 in this order; stations of one access point if absent",
             Presence::optional);
}

void visit_knobs(auto& visit, Is<Deployment> auto& deployment) {
  visit.list(participants_key, deployment.participants, ListSize{1, Deployment::max_participants},
             "the participants, numbered from 0 in this order");
  visit_hosts(visit, deployment);
  visit_common_knobs(visit, deployment);
}

template <>
inline constexpr std::array<std::string_view, 3> enum_names<RunUntil>{"completion", "time_limit",
                                                                      "quiescence"};

/// Most descriptors to be delivered, over all ordered pairs of participants. A run keeps five bits
/// for each, in words of 64: 6.25 GB at this limit.
inline constexpr std::uint64_t max_descriptor_deliveries = 10'000'000'000;

/// How many deliveries there are if each participant has to learn every descriptor of every other
/// one.
[[nodiscard]] inline std::uint64_t descriptor_deliveries(const Scenario& scenario) {
  const DescriptorProfile& defaults = scenario.dds.descriptors;
  std::uint64_t descriptors = 0;
  for (const Participant& participant : scenario.deployment.participants) {
    descriptors += std::uint64_t{defaults.default_publications} + defaults.default_subscriptions +
                   participant.publications + participant.subscriptions;
  }
  for (const LateEndpoints& late : scenario.deployment.life.value_or(Life{}).endpoints) {
    descriptors += 2 * (std::uint64_t{late.publications} + late.subscriptions);
  }
  return descriptors * (scenario.deployment.participants.size() - 1);
}

/// Amplifications of real storms are around 10; the limit keeps products within 64 bits.
inline constexpr std::int64_t max_amplification = 1'000'000;

void visit_knobs(auto& visit, Is<Limits> auto& limits) {
  visit.knob("completion", limits.completion, period_range,
             "discovery is complete at this time, at the latest", Presence::optional);
  visit.knob("messages", limits.messages, count_range(0, 1'000'000'000'000),
             "messages of all classes, at most", Presence::optional);
  visit.knob("amplification", limits.amplification, RatioType{max_amplification},
             "messages over those of the failure-free reference, at most", Presence::optional);
  visit.knob("backlog", limits.backlog, count_range(0, 1'000'000'000'000),
             "packets that wait for the source queue of one participant, at most",
             Presence::optional);
  visit.knob("needless", limits.needless, RatioType{max_amplification},
             "airtime of needless repeats and of the control traffic that they cause, over that of "
             "everything sent once: more of it is a storm if discovery is late, too; 1 if absent",
             Presence::optional);
  visit.knob("late", limits.late, period_range,
             "discovery that takes longer from the last start on is late; 1s if absent",
             Presence::optional);
}

void visit_knobs(auto& visit, Is<Variation> auto& vary) {
  visit.knob("start_jitter", vary.start_jitter, delay_range,
             "each participant starts up to this much later", Presence::optional);
  visit.knob("loss", vary.loss, RatioType{1}, "probability that a packet is lost",
             Presence::optional);
  visit.knob("sizes", vary.sizes, RatioType{1}, "relative range of packet sizes",
             Presence::optional);
  visit.knob("delays", vary.delays, RatioType{1},
             "relative range of airtime overheads, rates and constant delays", Presence::optional);
  visit.knob("timers", vary.timers, RatioType{1},
             "relative range of the periods and delays of the DDS profile", Presence::optional);
  constexpr NumberType some = count_range(0, Deployment::max_participants);
  visit.knob("outages", vary.outages, some,
             "at most so many outages, each of one direction between two participants; with "
             "dds.amendments or implementation: fastdds",
             Presence::optional);
  visit.knob("restarts", vary.restarts, some,
             "at most so many participants stop, and come back under their name; with "
             "dds.amendments or implementation: fastdds",
             Presence::optional);
  visit.knob("late_joiners", vary.late_joiners, some, "at most so many participants start later",
             Presence::optional);
  visit.knob("new_endpoints", vary.new_endpoints, some,
             "at most so many times a participant creates a publication and a subscription in the "
             "run, and may delete them again; with dds.amendments",
             Presence::optional);
  visit.knob("failures_within", vary.failures_within, period_range,
             "outages, restarts, late starts and new endpoints are over by then; 10s if absent",
             Presence::optional);
}

/// Who is more on a host than find a port or an index is not there. Of different profiles the one
/// counts that lets the fewest start.
void visit_crowd(auto& visit, Is<Scenario> auto& scenario) {
  const DdsProfile* dds = &scenario.dds;
  const auto least = [](const DdsProfile& one) { return participants_of_a_host(one) - 1; };
  for (const Participant& one : scenario.deployment.participants) {
    if (one.dds && least(*one.dds) < least(*dds)) dds = &*one.dds;
  }
  const std::uint32_t most = participants_of_a_host(*dds);
  const std::uint32_t crowd = most == 0 ? 0 : scenario.deployment.most_on_a_host();
  const bool is_said = dds->max_participants_per_host != 0;
  visit.rule(
      crowd <= most, "deployment",
      fmt::format("at most {} participants on a host, where {} are: with {} the next process "
                  "does not start, as it finds no {} (dds.max_participants_per_host{})",
                  most, crowd, traits_of(scenario.dds).whose,
                  traits_of(scenario.dds).has_own_timers ? "participant index" : "free port",
                  is_said ? "" : ", or what its own file says of it"));
}

/// Servers are there where participants discover through them, on hosts that there are.
void visit_servers(auto& visit, Is<Scenario> auto& scenario) {
  const Deployment& deployment = scenario.deployment;
  const bool has_server = traits_of(scenario.dds).has_server;
  visit.rule(has_server || deployment.servers.empty(), "deployment.servers",
             "none, or a DDS profile with discovery: server or super_client");
  const std::size_t hosts = deployment.hosts.size();
  for (std::size_t k = 0; k < deployment.servers.size(); ++k) {
    if (hosts == 0 || deployment.servers[k].host.value < hosts) continue;
    return visit.rule(false, fmt::format("deployment.servers.{}.host", k),
                      fmt::format("one of the {} hosts of the deployment", hosts));
  }
  for (std::size_t k = 0; k < deployment.servers.size(); ++k) {
    const auto& sought = deployment.servers[k].servers;
    const auto is_other = [&](std::uint64_t other) {
      return other < deployment.servers.size() && other != k;
    };
    if (std::ranges::all_of(sought, is_other)) continue;
    return visit.rule(false, fmt::format("deployment.servers.{}.servers", k),
                      fmt::format("numbers of other servers of the deployment, which has {}",
                                  deployment.servers.size()));
  }
  const bool is_linked = std::ranges::any_of(
      deployment.servers, [](const DiscoveryServer& one) { return !one.servers.empty(); });
  visit.rule(!is_linked || scenario.dds.server.known == ServerKnown::guid, "deployment.servers",
             "no servers that look for others, or dds.server_known: guid; since Fast DDS 3.0 all "
             "that can reach each other become one mesh, which is not modelled");
  const std::uint32_t count = has_server ? server_count(deployment) : 0;
  for (std::size_t i = 0; i < deployment.participants.size(); ++i) {
    const auto is_there = [&](std::uint64_t k) { return k < count; };
    if (std::ranges::all_of(deployment.participants[i].servers, is_there)) continue;
    return visit.rule(
        false, fmt::format("deployment.participants.{}.servers", i),
        count == 0 ? std::string{"none, or a DDS profile with discovery: server or super_client"}
                   : fmt::format("numbers of servers of the deployment, which has {}", count));
  }
}

/// The keys whose values may be the name of a file.
inline constexpr std::string_view dds_key = "dds";
inline constexpr std::string_view wireless_key = "wireless";

void visit_knobs(auto& visit, Is<Scenario> auto& scenario) {
  visit.section("deployment", scenario.deployment, "who takes part, and where");
  visit.section(dds_key, scenario.dds, "DDS profile");
  visit.section(wireless_key, scenario.wireless, "wireless profile");
  visit.section(hosts_key, scenario.hosts,
                "how fast participants handle what they receive, send and have to do; they take "
                "no time if absent",
                Presence::optional);
  visit.knob("time_limit", scenario.time_limit, period_range,
             "events after this time are not processed");
  visit.knob("run_until", scenario.run_until, UsualChoiceType<RunUntil>{{}, RunUntil::completion},
             "whether the run ends when discovery is complete, as it does if absent, when nothing "
             "but announcements is left to do, or at the time limit",
             Presence::optional);
  visit.section("limits", scenario.limits, "what a run may cost, for stormproof fuzz",
                Presence::optional);
  visit.section("vary", scenario.vary, "ranges around the scenario, for stormproof fuzz",
                Presence::optional);

  visit_mixed(visit, scenario);
  visit_servers(visit, scenario);
  visit_life(visit, scenario);
  visit_types(visit, scenario);
  const DescriptorProfile& defaults = scenario.dds.descriptors;
  const auto has_descriptors = [&defaults](const Participant& participant) {
    return defaults.default_publications + defaults.default_subscriptions +
               participant.publications + participant.subscriptions >
           0;
  };
  visit.rule(scenario.deployment.has_cross_host_pair(), "deployment",
             "participants on at least two hosts; on a single one nothing crosses the network, and "
             "there is nothing to discover");
  visit_crowd(visit, scenario);
  visit.rule(std::ranges::any_of(scenario.deployment.participants, has_descriptors), "deployment",
             "at least one endpoint, user or default; otherwise there is nothing to discover");
  visit.rule(descriptor_deliveries(scenario) <= max_descriptor_deliveries, "deployment",
             fmt::format("at most {} descriptors over all pairs of participants; each keeps state",
                         max_descriptor_deliveries));

  visit.rule(!scenario.limits || !scenario.limits->completion ||
                 *scenario.limits->completion <= scenario.time_limit,
             "limits.completion",
             fmt::format("at most the time_limit of {}, as the run ends there",
                         print_duration(scenario.time_limit)));

  const bool receives_separately = traits_of(scenario.dds).receives_separately;
  const auto needs_receptions = [&](bool usual, std::string_view key, std::string_view word) {
    visit.rule(usual || receives_separately, key,
               fmt::format("{}, or a DDS profile with implementation: fastdds or cyclone", word));
  };
  needs_receptions(scenario.wireless.service == ServedBy::frame, "wireless.service", "frame");
  needs_receptions(scenario.wireless.sender == Sender::backlog, "wireless.sender", "backlog");
  needs_receptions(scenario.wireless.count_at == CountAt::generation, "wireless.count_at",
                   "generation");

  needs_receptions(scenario.deployment.hosts.empty(), "deployment.hosts", "a number of hosts");
  needs_receptions(!scenario.wireless.loss, "wireless.loss", "no such key");
  visit.rule(scenario.deployment.hosts.empty() || goes_over_access_point(scenario.wireless),
             "deployment.hosts",
             "a number of hosts, or a shared_channel of two stages, to the access point and from "
             "it");
  needs_receptions(!scenario.hosts, hosts_key, "no such key");

  const LargestPacket packet = largest_packet(scenario);
  visit.rule(scenario.wireless.kind == ServiceKind::constant_delay ||
                 Fragmentation{scenario.wireless}.count(packet.payload.count()) <= max_fragments,
             "wireless.mtu_payload_bytes",
             fmt::format("at most {} fragments a packet; the largest has {} bytes of payload ({})",
                         max_fragments, packet.payload.count(), packet.origin));
}

}  // namespace stormproof::model::config
