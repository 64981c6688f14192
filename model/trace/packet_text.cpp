// Ends, streams and contents of packets.
#include "model/trace/packet_text.hpp"

#include "model/cyclone/endpoints.hpp"
#include "model/engine/submessage.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/trace/json_text.hpp"

namespace stormproof::model::trace {

Ends packet_ends(const Packet& packet, const Topology& topology) {
  if (packet.multicast()) return {packet.pair, 0};
  const Pair& pair = topology.pair(packet.pair);
  if (packet.to_writer()) return {pair.destination, pair.source};
  return {pair.source, pair.destination};
}

bool is_spdp(const Packet& packet) {
  switch (packet.kind) {
    case PacketKind::spdp_multicast:
    case PacketKind::spdp_unicast:
    case PacketKind::registration:
    case PacketKind::registration_heartbeat:
    case PacketKind::registration_acknack:
      return true;
    case PacketKind::relayed:
    case PacketKind::relayed_acknack:
      return packet.use == TrafficClass::spdp;
    default:
      return false;
  }
}

bool is_control(const Packet& packet) {
  return packet.kind == PacketKind::user_heartbeat || packet.kind == PacketKind::user_acknack ||
         packet.kind == PacketKind::lookup;
}

void append_stream(std::string& out, const Packet& packet) {
  if (packet.kind == PacketKind::rtps_message) return;
  if (is_control(packet))
    append(out, R"(,"control_relation":)", packet.detail);
  else if (!is_spdp(packet))
    append(out, R"(,"stream":")", name_of(packet.stream), "\"");
}

namespace {

void append_submessage(std::string& out, const Submessage& m) {
  constexpr const char* kinds[] = {"spdp", "data", "heartbeat", "acknack", "gap"};
  append(out, R"({"kind":")", kinds[static_cast<std::size_t>(m.kind)], R"(","participant":)",
         m.participant);
  if (m.kind != Submessage::Kind::spdp) {
    append(out, R"(,"writer":")", cyclone::name_of_writer(m.writer), "\"");
  }
  if (m.kind == Submessage::Kind::data) append(out, R"(,"descriptor":)", m.sample);
  if (m.kind == Submessage::Kind::heartbeat) append(out, R"(,"announces":)", m.sample);
  if (m.first > 0) append(out, R"(,"gone":)", m.first);
  if (m.goodbye) out += R"(,"goodbye":true)";
  if (m.kind == Submessage::Kind::gap) {
    out += R"(,"descriptors":)";
    append_members(out, m.bitmap);
  }
  if (m.kind == Submessage::Kind::acknack) {
    append(out, R"(,"base":)", m.sample);
    if (!m.bitmap.empty()) {
      out += R"(,"descriptors":)";
      append_members(out, m.bitmap);
    }
  }
  if (m.count > 0) append(out, R"(,"count":)", m.count);
  if (m.directed) out += R"(,"directed":true)";
  if (m.initial) out += R"(,"initial":true)";
  out += '}';
}

void append_submessages(std::string& out, const std::vector<Submessage>& submessages) {
  out += R"(,"submessages":[)";
  const char* separator = "";
  for (const Submessage& m : submessages) {
    out += separator;
    append_submessage(out, m);
    separator = ",";
  }
  out += ']';
}

/// Of what asks for types: the samples of a message, or how many are announced or acknowledged.
void append_samples(std::string& out, const Packet& packet) {
  if (packet.samples() > 0) append(out, R"(,"samples":)", packet.samples());
  if (packet.last_sample() > 0) append(out, R"(,"last_sample":)", packet.last_sample());
}

void append_numbers(std::string& out, const std::vector<std::int64_t>& numbers) {
  const char* separator = "[";
  for (const std::int64_t number : numbers) {
    append(out, separator, number);
    separator = ",";
  }
  out += ']';
}

void append_relayed(std::string& out, const Packet& packet) {
  const Relayed& relayed = *packet.relayed;
  if (relayed.has_data) {
    append(out, R"(,"participant":)", relayed.participant);
    if (!relayed.is_announcement) append(out, R"(,"descriptor":)", relayed.descriptor);
    if (relayed.is_goodbye) out += R"(,"goodbye":true)";
    append(out, R"(,"number":)", relayed.number);
  }
  const bool asks = packet.kind == PacketKind::relayed_acknack;
  if (!relayed.numbers.empty()) {
    out += asks ? R"(,"requested":)" : R"(,"gap":)";
    append_numbers(out, relayed.numbers);
  }
  if (relayed.has_heartbeat) {
    append(out, R"(,"first":)", relayed.first, R"(,"last":)", relayed.last);
  }
  if (relayed.base > 0) append(out, R"(,"base":)", relayed.base);
}

}  // namespace

void append_packet(std::string& out, const Packet& packet, std::uint32_t from,
                   std::span<const std::uint32_t> destinations) {
  append(out, R"("kind":")", name_of(packet.kind), R"(","from":)", from, R"(,"to":)");
  if (packet.to_nobody) {
    out += "[]";
  } else if (packet.multicast() && destinations.empty()) {
    out += R"("multicast")";
  } else {
    const char* separator = "[";
    for (const std::uint32_t destination : destinations) {
      append(out, separator, destination);
      separator = ",";
    }
    out += ']';
  }
  append_stream(out, packet);
  append(out, R"(,"bytes":)", packet.payload_bytes);
  if (!packet.descriptors.empty()) {
    out += R"(,"descriptors":)";
    append_members(out, packet.descriptors);
  }
  const bool announces = packet.kind == PacketKind::heartbeat || packet.kind == PacketKind::data;
  if (announces && packet.detail > 0) append(out, R"(,"announces":)", packet.detail);
  if (packet.kind == PacketKind::acknack && packet.detail > 0) {
    append(out, R"(,"base":)", packet.detail);
  }
  if (is_control(packet)) append_samples(out, packet);
  if (packet.from_repair) out += R"(,"repair":true)";
  if (packet.heartbeats > 0) append(out, R"(,"heartbeats":)", packet.heartbeats);
  if (packet.initial_acknack) out += R"(,"initial":true)";
  if (packet.relayed != nullptr) append_relayed(out, packet);
  if (packet.submessages != nullptr) append_submessages(out, *packet.submessages);
}

}  // namespace stormproof::model::trace
