// Words of the protocol instead of names of the program.
#include "model/trace/perfetto_labels.hpp"

#include "model/engine/submessage.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/trace/json_text.hpp"
#include "model/trace/packet_text.hpp"

namespace stormproof::model::trace {

namespace {

/// ", 12 descriptors"; nothing for a packet without any.
void append_members_count(std::string& text, const Packet& packet) {
  std::uint32_t members = 0;
  if (packet.submessages != nullptr && packet.submessages->size() > 1) {
    append(text, ", ", packet.submessages->size(), " submessages");
  }
  packet.descriptors.for_each([&](std::uint32_t) { ++members; });
  if (members == 0) return;
  const bool bitmap = packet.kind == PacketKind::acknack;
  append(text, ", ", members, bitmap ? " missing" : members == 1 ? " descriptor" : " descriptors");
}

}  // namespace

const char* packet_label(const Packet& packet) {
  switch (packet.kind) {
    case PacketKind::spdp_multicast:
    case PacketKind::spdp_unicast:
      return "SPDP";
    case PacketKind::data:
      if (packet.carries_heartbeat) {
        return packet.carries_initial ? "DATA+HEARTBEAT" : "repair DATA+HEARTBEAT";
      }
      return packet.carries_initial ? "DATA" : "repair DATA";
    case PacketKind::heartbeat:
      return "HEARTBEAT";
    case PacketKind::acknack:
      return packet.initial_acknack ? "initial ACKNACK" : "ACKNACK";
    case PacketKind::user_heartbeat:
      return "user HEARTBEAT";
    case PacketKind::user_acknack:
      return packet.initial_acknack ? "initial user ACKNACK" : "user ACKNACK";
    case PacketKind::lookup:
      return packet.heartbeats > 0 ? "type lookup+HEARTBEAT" : "type lookup";
    case PacketKind::registration:
      return "DATA(p)";
    case PacketKind::registration_heartbeat:
      return "HEARTBEAT(p)";
    case PacketKind::registration_acknack:
      return packet.initial_acknack ? "initial ACKNACK(p)" : "ACKNACK(p)";
    case PacketKind::relayed_acknack:
      return packet.initial_acknack ? "initial ACKNACK" : "ACKNACK";
    case PacketKind::relayed:
      if (!packet.relayed->numbers.empty()) return "GAP";
      if (packet.relayed->is_announcement) return "DATA(p)+HEARTBEAT";
      if (!packet.relayed->has_data) return "HEARTBEAT";
      return packet.carries_initial ? "DATA+HEARTBEAT" : "repair DATA+HEARTBEAT";
    case PacketKind::rtps_message:
      break;
  }
  switch (packet.use) {
    case TrafficClass::spdp:
      return "SPDP";
    case TrafficClass::initial_data:
      return "DATA";
    case TrafficClass::repair_data:
      return "repair DATA";
    case TrafficClass::heartbeat:
      return "HEARTBEAT";
    case TrafficClass::acknack:
      return "ACKNACK";
    case TrafficClass::user_control:
      return "user message";
    case TrafficClass::lookup:
      return "type lookup";
  }
  return "";
}

std::string service_label(const Packet& packet, const Topology& topology) {
  const auto [from, to] = packet_ends(packet, topology);
  std::string text;
  append(text, packet_label(packet), " ", from, "→");
  if (packet.multicast())
    text += "all";
  else
    append_part(text, to);
  const bool of_stream =
      !is_spdp(packet) && !is_control(packet) && packet.kind != PacketKind::rtps_message;
  if (of_stream) append(text, " ", name_of(packet.stream));
  return text;
}

std::string emission_label(const Packet& packet, std::span<const std::uint32_t> destinations) {
  std::string text;
  append(text, packet_label(packet), " to ");
  if (packet.multicast())
    text += "all";
  else if (destinations.size() == 1)
    append_part(text, destinations[0]);
  else
    append(text, destinations.size(), " participants");
  append_members_count(text, packet);
  return text;
}

std::string arrival_label(const Packet& packet, std::uint32_t from) {
  std::string text;
  append(text, packet_label(packet), " from ", from);
  append_members_count(text, packet);
  return text;
}

const char* timer_label(EventKind kind) {
  switch (kind) {
    case EventKind::announcement_due:
      return "announcement";
    case EventKind::heartbeat_expiry:
      return "HEARTBEAT expiry";
    case EventKind::acknack_generation:
      return "ACKNACK generation";
    case EventKind::initial_acknack_due:
      return "initial ACKNACK due";
    case EventKind::repair_generation:
      return "repair DATA generation";
    case EventKind::suppression_end:
      return "suppression end";
    case EventKind::cycle_start:
      return "HEARTBEAT cycle start";
    case EventKind::cycle_end:
      return "HEARTBEAT cycle end";
    case EventKind::batch_due:
      return "HEARTBEAT batch";
    case EventKind::endpoint_creation:
      return "endpoint created";
    case EventKind::nack_response:
      return "NACK response";
    case EventKind::async_run:
      return "asynchronous send";
    case EventKind::lookup_expiry:
      return "HEARTBEAT expiry of lookups";
    case EventKind::participant_start:
      return "participant starts";
    case EventKind::spdp_time:
      return "announcement timer";
    case EventKind::reply_time:
      return "announcement to one";
    case EventKind::lease_check:
      return "lease check";
    case EventKind::heartbeat_time:
      return "HEARTBEAT timer";
    case EventKind::ack_time:
      return "ACK timer";
    case EventKind::liveliness_time:
      return "liveliness timer";
    case EventKind::address_time:
      return "address timer";
    case EventKind::thread_run:
      return "event thread";
    case EventKind::client_announcement:
      return "announcement to the server";
    case EventKind::client_sync:
      return "client sync";
    case EventKind::registration_expiry:
      return "HEARTBEAT(p) expiry";
    case EventKind::registration_reply:
      return "ACKNACK(p) generation";
    case EventKind::registration_initial:
      return "initial ACKNACK(p) due";
    case EventKind::learner_reply:
      return "ACKNACK to the server";
    case EventKind::learner_initial:
      return "initial ACKNACK to the server";
    case EventKind::relay_expiry:
      return "HEARTBEAT expiry of the server";
    case EventKind::relay_response:
      return "NACK response of the server";
    case EventKind::relay_suppression_end:
      return "suppression end of the server";
    case EventKind::server_routine:
    case EventKind::server_routine_again:
      return "server routine";
    case EventKind::server_sending:
      return "server sends";
    case EventKind::thread_free:
      return "thread free";
    default:
      return name_of(kind);
  }
}

const char* timer_start_label(EventKind kind) {
  switch (kind) {
    case EventKind::suppression_end:
      return "suppression started";
    case EventKind::initial_acknack_due:
      return "relation opened";
    default:
      return "timer started";
  }
}

}  // namespace stormproof::model::trace
