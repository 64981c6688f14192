// The state that the rules are about, the way from events and packets to rules, and what goes out
// on the wire.
#include "model/fastdds/protocol.hpp"

#include <algorithm>

#include "model/engine/endpoint_creations.hpp"
#include "model/fastdds/peer_ports.hpp"
#include "model/implementations.hpp"

namespace stormproof::model::fastdds {

Protocol::Protocol(RunState& run, Network& network)
    : Stored{run, network},
      ControlSteps{run},
      first_lookup_writer_{2 * run.topology.participant_count()},
      participants_(run.topology.participant_count()),
      writers_((2 + control_writers) * std::size_t{run.topology.participant_count()}),
      sends_records_{network.takes_records() && !run.scenario.deployment.life},
      generated_{counts_at_admission(run) ? of_no_interest_ : run.counts} {
  for (const DdsProfile& dds : run.profiles.different()) own_.emplace_back(run.scenario, dds);
  for (std::uint32_t w = 0; w < writers_.size(); ++w) refill(w);
}

std::optional<std::uint32_t> Protocol::sender_of(const Event& event) const {
  if (event.kind == EventKind::endpoint_creation) return event.subject;
  return actor_of_timer(*this, event);
}

void Protocol::count(const Packet& packet) {
  Counts& counts = run_.counts;
  switch (packet.kind) {
    case PacketKind::spdp_multicast:
      ++counts.spdp_multicast;
      break;
    case PacketKind::spdp_unicast:
      ++counts.spdp_unicast;
      break;
    case PacketKind::data:
      counts.initial_data += packet.initial_data;
      counts.repair_data += packet.repair_data;
      counts.heartbeat += packet.heartbeats;
      break;
    case PacketKind::heartbeat:
      counts.heartbeat += std::max<std::uint64_t>(packet.heartbeats, 1);
      break;
    case PacketKind::acknack:
      ++counts.acknack;
      break;
    case PacketKind::user_heartbeat:
    case PacketKind::user_acknack:
      ++run_.user_control;
      break;
    case PacketKind::lookup:
      counts.lookup += packet.samples();
      run_.user_control += packet.heartbeats;
      break;
    default:
      break;  // sent by others only
  }
}

void Protocol::start() {
  for (std::uint32_t i = 0; i < run_.scenario.deployment.size(); ++i) {
    begin_announcing(i);
    schedule_creations(run_, i, run_.scenario.deployment.participants[i].start);
  }
}

void Protocol::handle(const Event& event) {
  if (event.kind == EventKind::endpoint_creation) {
    create(*this, event);
  } else {
    run_due(*this, event);
  }
}

Endpoint Protocol::created_by(const Event& event) {
  // A creation that was held can meet the next one; the application creates them in their order.
  const std::uint32_t k =
      network_.sender_stalls() ? participants_[event.subject].endpoints++ : event.detail;
  return creation_of(run_.topology, event.subject, k);
}

std::vector<std::uint32_t> Protocol::receivers(const Packet& packet) const {
  std::vector<std::uint32_t> receivers;
  if (packet.to_nobody) return receivers;
  if (packet.multicast()) {
    for (std::uint32_t pair = run_.topology.first_pair(packet.pair);
         pair < run_.topology.first_pair(packet.pair + 1); ++pair) {
      const Pair& p = run_.topology.pair(pair);
      if (p.cross_host) receivers.push_back(p.destination);
    }
    return receivers;
  }
  const Pair& p = run_.topology.pair(packet.pair);
  receivers.push_back(packet.to_writer() ? p.source : p.destination);
  return receivers;
}

void Protocol::received(const Packet& packet, std::uint32_t receiver) {
  take_in(*this, packet, receiver);
}

std::vector<std::uint32_t> Protocol::open_relations(std::uint32_t w) const {
  std::vector<std::uint32_t> relations = writers_[w].readers;
  std::ranges::sort(relations);
  return relations;
}

void Protocol::enqueue(std::uint32_t w, const DescriptorSet& requested) {
  requested.for_each([&](std::uint32_t d) {
    if (has(rules::Enqueued{}, w, d)) return;
    assign(rules::Enqueued{}, w, d, true);
    participants_[w / 2].queue.push_back({stream_of(w), d});
  });
}

void Protocol::send_spdp_to_known(std::uint32_t i) {
  for (std::uint32_t pair = run_.topology.first_pair(i); pair < run_.topology.first_pair(i + 1);
       ++pair) {
    if (at<comp::Recognised>(run_.topology.pair(pair).reverse)) send_spdp_copy(pair);
  }
}

/// With static peers there is no group: a copy goes to each of the first ports of every host,
/// whether somebody is there or not. On one's own host nobody hears of the latter.
void Protocol::send_spdp_to_ports(std::uint32_t i) {
  const HostId own = run_.scenario.deployment.participants[i].host;
  const std::int64_t bytes = own_of(i).sizes.announcement;
  for (const auto& [host, there] : participants_at_ports(run_.scenario.deployment)) {
    for (std::uint32_t port = 0; port < own_of(i).dds.peer_ports; ++port) {
      if (port < there.size()) {
        if (there[port] != i) send_spdp_copy(run_.topology.pair_between(i, there[port]));
      } else if (host != own) {
        ++generated_.spdp_unicast;
        const std::uint32_t somebody_there = run_.topology.pair_between(i, there.front());
        Packet packet = packet_of(PacketKind::spdp_unicast, somebody_there, bytes);
        packet.to_nobody = true;
        send_across(i, std::move(packet));
      }
    }
  }
}

void Protocol::send_spdp_multicast(std::uint32_t i) {
  if (run_.scenario.dds.discovery == Discovery::static_peers) return send_spdp_to_ports(i);
  ++generated_.spdp_multicast;
  const std::int64_t bytes = own_of(i).sizes.announcement;
  for (std::uint32_t pair = run_.topology.first_pair(i); pair < run_.topology.first_pair(i + 1);
       ++pair) {
    const Pair& p = run_.topology.pair(pair);
    if (p.cross_host) continue;
    send_on_host(i, packet_of(PacketKind::spdp_multicast, i, bytes), p.destination);
  }
  send_across(i, packet_of(PacketKind::spdp_multicast, i, bytes));
}

void Protocol::send_spdp_copy(std::uint32_t pair) {
  const Pair& p = run_.topology.pair(pair);
  if (p.cross_host) ++generated_.spdp_unicast;
  send(packet_of(PacketKind::spdp_unicast, pair, own_of(p.source).sizes.announcement));
}

void Protocol::send_heartbeat(std::uint32_t relation, std::uint32_t announced, std::int64_t bytes) {
  if (crosses(relation)) ++generated_.heartbeat;
  Packet packet = packet_on(PacketKind::heartbeat, relation, bytes);
  packet.detail = announced;
  send(std::move(packet));
}

void Protocol::send_heartbeat_to_all(std::uint32_t w) {
  const Writer& writer = writers_[w];
  PacketNumbers heartbeat;
  heartbeat.stream = stream_of(w);
  heartbeat.payload_bytes = static_cast<std::uint32_t>(
      writer.readers.size() == 1 ? heartbeat_to_one_bytes : heartbeat_to_many_bytes);
  heartbeat.detail = first<rules::Exists>(w);
  generated_.heartbeat += count_crossing(writer.readers);
  send_to_readers(heartbeat, writer.readers);
}

/// A HEARTBEAT of a writer to these, the first ones that it has matched, in their order. Those on
/// other hosts are one record, in the place of the first of them.
void Protocol::send_to_readers(PacketNumbers heartbeat, const std::vector<std::uint32_t>& readers) {
  heartbeat.kind = PacketKind::heartbeat;
  bool is_recorded = false;
  for (const std::uint32_t relation : readers) {
    const Pair& to = ends(relation);
    heartbeat.pair = relation / 2;
    if (!to.cross_host) {
      send_on_host(to.source, heartbeat, to.destination);
    } else if (!is_recorded) {
      Packet packet;
      packet.become(heartbeat);
      if (sends_records_) packet.copies = count_crossing(readers);
      is_recorded = sends_records_;
      send_across(to.source, std::move(packet));
    }
  }
}

std::uint32_t Protocol::next_recipient(const Packet& heartbeat, std::uint32_t pair) const {
  const std::uint32_t relation = 2 * pair + static_cast<std::uint32_t>(heartbeat.stream);
  const std::vector<std::uint32_t>& readers = writers_[writer_of(relation)].readers;
  std::uint32_t rank = at<Rank>(relation) + 1;
  while (!crosses(readers[rank])) ++rank;
  return readers[rank] / 2;
}

void Protocol::send_acknack(Packet&& packet) {
  complete_acknack(packet);
  if (crosses(packet.relation())) ++generated_.acknack;
  if (!packet.descriptors.empty()) {
    packet.payload_bytes += static_cast<std::uint32_t>(acknack_bitmap_bytes);
  }
  send(std::move(packet));
}

void Protocol::renew_bitmap(Packet& acknack) {
  if (acknack.initial_acknack) return;
  RunningWorld<Protocol, comp::owner::relation> w{*this, acknack.relation()};
  fill(acknack, w, rules::Implementation::bitmap());
}

void Protocol::send(Packet&& packet) {
  const Pair& p = run_.topology.pair(packet.pair);
  const std::uint32_t from = packet.to_writer() ? p.destination : p.source;
  const std::uint32_t to = packet.to_writer() ? p.source : p.destination;
  if (p.cross_host)
    send_across(from, std::move(packet));
  else
    send_on_host(from, std::move(packet), to);
}

/// Where endpoints have types also what has arrived, and waits for its type.
std::vector<MissingDescriptor> Protocol::missing(std::size_t limit) {
  if (!has_types_) return changes().list_missing(limit);
  std::vector<MissingDescriptor> missing;
  for (std::uint32_t relation = 0; relation < run_.topology.relation_count(); ++relation) {
    const Pair& p = ends(relation);
    if (!p.cross_host) continue;
    for (std::uint32_t d = 0; d < run_.topology.descriptor_count(relation); ++d) {
      if (is_notified(relation / 2, stream_of(relation), d)) continue;
      if (missing.size() == limit) return missing;
      missing.push_back({ParticipantId{p.source}, ParticipantId{p.destination}, stream_of(relation),
                         DescriptorId{d}});
    }
  }
  return missing;
}

bool Protocol::is_notified(std::uint32_t pair, Stream s, std::uint32_t d) const {
  const auto relation = static_cast<std::uint32_t>(2 * pair + index_of(s));
  return d < first<rules::HandedOver>(relation) && !(has_types_ && lookups_.waits(relation, d));
}

void Protocol::take_descriptors(std::uint32_t relation, const DescriptorSet& received) {
  const bool crosses_hosts = crosses(relation);
  const std::uint32_t before = at<Lacking>(relation);
  take(planes(), relation, received, crosses_hosts && !has_types_);
  if (crosses_hosts && has_types_) run_.useful_deliveries += before - at<Lacking>(relation);
}

/// The application of the relation's reader knows the descriptor. Where endpoints have types that
/// is what discovery waits for.
void Protocol::note_notified(std::uint32_t relation, std::uint32_t d) {
  if (!has_types_ || !crosses(relation)) return;
  if (--run_.missing == 0) note_last_delivery(relation, d);
}

}  // namespace stormproof::model::fastdds
