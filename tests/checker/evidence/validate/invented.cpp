// Events, their datagrams, and the topology that they reveal.
#include "tests/checker/evidence/validate/invented.hpp"

namespace stormproof::validate::testing {

using capture::DataEvent;
using capture::EntityId;
using capture::Event;

capture::GuidPrefix Invented::prefix(std::size_t who) {
  capture::GuidPrefix result;
  result.bytes.back() = static_cast<std::uint8_t>(who + 1);
  return result;
}

Event Invented::event(std::size_t who, std::optional<std::size_t> to, EntityId writer,
                      std::int64_t time_ns) const {
  Event event;
  event.time_ns = time_ns;
  event.bytes = 32;
  event.source = prefix(who);
  event.writer = writer;
  event.is_multicast = !to;
  if (to) {
    event.destination = prefix(*to);
    event.has_info_dst = true;
    const auto& list = conversation_.topology.participants;
    event.is_same_host = list[who].host == list[*to].host;
  }
  return event;
}

Invented& Invented::adds(Event event, std::uint32_t payload_bytes) {
  event.datagram = static_cast<std::uint32_t>(conversation_.datagrams.size());
  capture::DatagramRecord datagram;
  datagram.time_ns = event.time_ns;
  datagram.payload_bytes = payload_bytes;
  datagram.vendor = capture::fastdds_vendor;
  conversation_.datagrams.push_back(datagram);
  if (conversation_.events.empty()) conversation_.first_ns = event.time_ns;
  conversation_.last_ns = event.time_ns;
  conversation_.events.push_back(event);
  return *this;
}

Invented& Invented::participant(std::size_t host) {
  capture::Participant participant;
  participant.prefix = prefix(conversation_.topology.participants.size());
  participant.host = host;
  participant.vendor = capture::fastdds_vendor;
  conversation_.topology.participants.push_back(participant);
  conversation_.topology.hosts = std::max(conversation_.topology.hosts, host + 1);
  return *this;
}

Invented& Invented::announces(std::size_t who, std::int64_t time_ns) {
  Event spdp = event(who, {}, capture::entity::spdp_writer, time_ns);
  spdp.content = DataEvent{.sequence_number = 1};
  conversation_.topology.participants[who].first_ns = time_ns;
  return adds(spdp);
}

Invented& Invented::describes(std::size_t who, EntityId writer, std::int64_t number,
                              std::optional<std::size_t> to, std::int64_t time_ns) {
  Event data = event(who, to, writer, time_ns);
  const auto entity = static_cast<EntityId>(static_cast<std::uint64_t>(number) << 8U |
                                            (writer == pubs ? 0x03U : 0x04U));
  const capture::Guid guid{prefix(who), entity};
  data.content = DataEvent{.sequence_number = number, .endpoint = guid};
  capture::Endpoint endpoint;
  endpoint.entity = entity;
  endpoint.announced_by = writer;
  endpoint.sequence_number = number;
  endpoint.first_ns = time_ns;
  conversation_.topology.participants[who].endpoints.try_emplace(guid, endpoint);
  return adds(data);
}

Invented& Invented::describes_all(std::size_t who, EntityId writer, std::int64_t count,
                                  std::size_t to, std::int64_t time_ns) {
  for (std::int64_t number = 1; number <= count; ++number) {
    describes(who, writer, number, to, time_ns);
  }
  return *this;
}

Invented& Invented::heartbeat(std::size_t who, EntityId writer, std::int64_t last, std::size_t to,
                              std::int64_t time_ns) {
  Event heartbeat = event(who, to, writer, time_ns);
  heartbeat.content = capture::HeartbeatEvent{.first = 1, .last = last, .count = 1};
  return adds(heartbeat);
}

Invented& Invented::asks(std::size_t who, EntityId writer, std::int64_t number, std::size_t to,
                         std::int64_t time_ns) {
  Event acknack = event(who, to, writer, time_ns);
  capture::AcknackEvent content;
  content.missing.base = number;
  content.missing.num_bits = 1;
  content.missing.bits[0] = 1U << 31U;
  acknack.content = content;
  return adds(acknack);
}

Invented two_hosts() {
  Invented invented;
  invented.participant(0).participant(1).announces(0, 1 * ms).announces(1, 3 * ms);
  return invented;
}

}  // namespace stormproof::validate::testing
