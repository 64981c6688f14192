// Counts and airtimes of a discovery in which everything is sent once.
#include "model/reference.hpp"

#include <vector>

#include "model/airtime.hpp"
#include "model/engine/profiles.hpp"
#include "model/engine/topology.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/implementations.hpp"
#include "model/packet_sizes.hpp"
#include "model/servers.hpp"

namespace stormproof::model {

namespace {

/// All `count` descriptors of one stream, grouped into packets without piggybacked HEARTBEATs.
std::int64_t data_ns(const RouteAirtime& route, const PacketSizes& sizes, Stream s,
                     std::uint32_t count) {
  const std::int64_t header = sizes.header + sizes.destination;
  std::int64_t sum = 0;
  std::int64_t payload = 0;
  for (std::uint32_t d = 0; d < count; ++d) {
    const std::int64_t added = sizes.descriptor(s, d);
    if (payload > 0 && sizes.is_full(payload, added)) {
      sum += route.packet_ns(payload, false);
      payload = 0;
    }
    payload += payload == 0 ? header + added : added;
  }
  return payload == 0 ? sum : sum + route.packet_ns(payload, false);
}

/// `sizes_of(i)`: those of what participant i sends.
template <class SizesOf>
std::int64_t everything_once_ns(const Topology& topology, const RouteAirtime& route,
                                const SizesOf& sizes_of) {
  std::int64_t sum = 0;
  for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
    const PacketSizes& sizes = sizes_of(i);
    const std::int64_t control =
        route.packet_ns(sizes.heartbeat, false) + route.packet_ns(sizes.acknack, false);
    const std::int64_t multicast = route.packet_ns(sizes.announcement, true);
    const std::int64_t unicast = route.packet_ns(sizes.announcement, false);
    const std::int64_t peers = topology.peer_count(i);
    sum += (1 + peers) * multicast + peers * (peers + 1) / 2 * unicast;
    for (const Stream s : streams) {
      sum += peers * (control + data_ns(route, sizes, s, topology.descriptor_count(i, s)));
    }
  }
  return sum;
}

/// SPDP of the failure-free reference: each of a participant's `recognitions` sends one
/// announcement more. Where same-host participants are recognised too, of the copies to all
/// known ones, on average the share of the cross-host peers crosses hosts.
void add_spdp(Counts& counts, SpdpResend resend, std::uint64_t recognitions, std::uint64_t peers) {
  switch (resend) {
    case SpdpResend::all_known:
      counts.spdp_multicast += 1 + recognitions;
      counts.spdp_unicast += peers * (recognitions + 1) / 2;
      break;
    case SpdpResend::new_and_multicast:
      counts.spdp_multicast += 1 + recognitions;
      counts.spdp_unicast += peers;
      break;
    case SpdpResend::new_only:
      counts.spdp_multicast += 1;
      counts.spdp_unicast += peers;
      break;
    case SpdpResend::none:
      counts.spdp_multicast += 1;
      break;
  }
}

/// With servers everything goes to each server of a participant once, and once from that to each
/// other client of it who needs it; a super client needs what all others have.
Counts reference_with_server(const Scenario& scenario) {
  const Topology topology = topology_of(scenario);
  const Deployment& deployment = scenario.deployment;
  const bool super = scenario.dds.discovery == Discovery::super_client;
  const auto descriptors = [&](std::uint32_t i) {
    return topology.descriptor_count(i, Stream::pub) + topology.descriptor_count(i, Stream::sub);
  };
  std::vector<std::vector<std::uint32_t>> clients(topology.server_count());
  for (std::uint32_t i = 0; i < deployment.size(); ++i) {
    for (const std::uint32_t server : servers_of(deployment, i)) {
      clients[server - topology.first_server()].push_back(i);
    }
  }
  Counts counts;
  const auto add = [&](std::uint32_t server, std::uint32_t j) {
    if (!topology.pair(topology.pair_between(j, server)).cross_host) return;
    const auto& all = clients[server - topology.first_server()];
    counts.initial_data += descriptors(j);
    counts.heartbeat += 4;  // two streams there, two back
    counts.acknack += 4;
    counts.pdp_data += 1 + all.size();  // its own; the server's, and those of all others
    counts.pdp_heartbeat += 2;
    counts.pdp_acknack += 2;
    for (const std::uint32_t i : all) {
      if (i == j) continue;
      counts.initial_data +=
          super ? descriptors(i) : topology.matching_descriptors(i, j, scenario.dds.descriptors);
    }
  };
  for (std::uint32_t j = 0; j < deployment.size(); ++j) {
    for (const std::uint32_t server : servers_of(deployment, j)) add(server, j);
  }
  return counts;
}

}  // namespace

Counts failure_free_reference(const Scenario& scenario) {
  if (traits_of(scenario.dds).has_server) return reference_with_server(scenario);
  const Topology topology{scenario.deployment, scenario.dds.descriptors};
  Counts counts;
  counts.initial_data = topology.required_deliveries();
  counts.heartbeat = topology.relation_count();
  counts.acknack = topology.relation_count();
  const bool same_host = traits_of(scenario.dds).discovers_same_host;
  // Cyclone DDS answers the one who has announced itself, and does not announce itself to all.
  const bool answers = traits_of(scenario.dds).answers_newcomers;
  const std::uint64_t other_hosts = scenario.deployment.host_count() - 1;
  for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
    const DdsProfile& dds = dds_of(scenario, i);
    const std::uint64_t peers = topology.peer_count(i);
    Counts own;
    add_spdp(own, answers ? SpdpResend::new_only : dds.spdp.resend,
             same_host ? topology.participant_count() - 1 : peers, peers);
    if (dds.discovery == Discovery::static_peers) {  // to each port instead of the group
      own.spdp_unicast += own.spdp_multicast * other_hosts * dds.peer_ports;
      own.spdp_multicast = 0;
    }
    counts.spdp_multicast += own.spdp_multicast;
    counts.spdp_unicast += own.spdp_unicast;
  }
  return counts;
}

std::optional<Nanoseconds> open_loop_airtime(const Scenario& scenario) {
  if (scenario.wireless.kind == ServiceKind::constant_delay) return std::nullopt;
  if (!traits_of(scenario.dds).has_open_loop) return std::nullopt;
  const Topology topology{scenario.deployment, scenario.dds.descriptors};
  const RouteAirtime route{scenario.wireless};
  const Profiles profiles{scenario};
  std::vector<PacketSizes> sizes;
  for (const DdsProfile& dds : profiles.different()) {
    sizes.push_back(packet_sizes(fastdds::deployed_profile(scenario, dds)));
  }
  const auto sizes_of = [&](std::uint32_t i) -> const PacketSizes& {
    return sizes[profiles.number_of(i)];
  };
  return Nanoseconds{everything_once_ns(topology, route, sizes_of)};
}

}  // namespace stormproof::model
