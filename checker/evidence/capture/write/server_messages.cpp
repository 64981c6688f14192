// From what a server relays to submessages.
#include "checker/evidence/capture/write/server_messages.hpp"

#include <algorithm>

#include "checker/evidence/capture/write/descriptions.hpp"
#include "model/fastdds/relay.hpp"

namespace stormproof::capture::write {

namespace {

using model::PacketKind;
using model::Relayed;

/// The entities of one of the server's relays; those of announcements are SPDP's.
Ends ends_of(const model::Packet& packet) {
  if (packet.detail == model::fastdds::relay::announcements) {
    return {capture::entity::spdp_writer, capture::entity::spdp_reader};
  }
  return {sedp_writer(packet.stream), sedp_reader(packet.stream)};
}

}  // namespace

Buffer ServerMessages::message(const model::Packet& packet, std::uint32_t source,
                               std::uint32_t destination, std::int64_t time_ns) {
  MessageWriter out{vendor_, identities_[source].prefix};
  out.info_dst(identities_[destination].prefix);
  switch (packet.kind) {
    case PacketKind::relayed:
      relay(out, packet, source, time_ns);
      break;
    case PacketKind::relayed_acknack:
      acknowledge(out, packet, source);
      break;
    default:
      register_with(out, packet, source, time_ns);
      break;
  }
  out.fill(packet.payload_bytes);
  return out.buffer();
}

/// DATA(p) of a client is always number 1; before it, its HEARTBEATs announce nothing.
void ServerMessages::register_with(MessageWriter& out, const model::Packet& packet,
                                   std::uint32_t source, std::int64_t time_ns) {
  using capture::entity::spdp_reader;
  using capture::entity::spdp_writer;
  if (packet.kind == PacketKind::registration) {
    registered_.insert(source);
    out.info_ts(time_ns);
    out.data(spdp_reader, spdp_writer, 1, participant_parameters(identities_[source], vendor_),
             packet.payload_bytes - out.size());
  } else if (packet.kind == PacketKind::registration_heartbeat) {
    out.heartbeat(spdp_reader, spdp_writer, registered_.contains(source) ? 1 : 0,
                  next_count(source, spdp_writer));
  } else {
    SequenceNumberSet missing;
    if (!packet.initial_acknack) missing.base = 2;
    out.acknack(spdp_reader, spdp_writer, missing, next_count(source, spdp_reader),
                !packet.initial_acknack);
  }
}

void ServerMessages::relay(MessageWriter& out, const model::Packet& packet, std::uint32_t source,
                           std::int64_t time_ns) {
  const Relayed& relayed = *packet.relayed;
  const auto [writer, reader] = ends_of(packet);
  if (!relayed.numbers.empty()) out.gap(reader, writer, relayed.numbers);
  if (relayed.has_data) {
    out.info_ts(time_ns);
    const std::size_t tail = relayed.has_heartbeat ? MessageWriter::heartbeat_size : 0;
    add_data(out, relayed, reader, writer, packet.payload_bytes - tail);
  }
  if (!relayed.has_heartbeat) return;
  out.heartbeat(reader, writer, static_cast<std::uint64_t>(relayed.last),
                next_count(source, writer), static_cast<std::uint64_t>(relayed.first));
}

/// As its participant describes itself or an endpoint; to `end` bytes after the start.
void ServerMessages::add_data(MessageWriter& out, const Relayed& relayed, EntityId reader,
                              EntityId writer, std::size_t end) {
  const Identity& whose = identities_[relayed.participant];
  const auto number = static_cast<std::uint64_t>(relayed.number);
  const std::size_t size = end > out.size() ? end - out.size() : 0;
  if (relayed.is_goodbye) {
    ParameterWriter key;
    key.guid(id_of(ParameterId::participant_guid), {whose.prefix, entity::participant});
    out.disposal(reader, writer, number, key, size);
    return;
  }
  if (relayed.is_announcement) {
    out.data(reader, writer, number, participant_parameters(whose, vendor_), size);
    return;
  }
  const model::DescriptorProfile& descriptors = scenario_.dds.descriptors;
  const std::uint32_t defaults = relayed.stream == model::Stream::pub
                                     ? descriptors.default_publications
                                     : descriptors.default_subscriptions;
  out.data(
      reader, writer, number,
      endpoint_parameters(whose, vendor_, relayed.stream, relayed.descriptor,
                          topic_name(relayed.stream, relayed.descriptor, defaults, whose.name)),
      size);
}

void ServerMessages::acknowledge(MessageWriter& out, const model::Packet& packet,
                                 std::uint32_t source) {
  const auto [writer, reader] = ends_of(packet);
  SequenceNumberSet missing;
  if (!packet.initial_acknack) missing.base = packet.relayed->base;
  for (const std::int64_t number : packet.relayed->numbers) {
    ask(missing, static_cast<std::uint32_t>(number - 1));
  }
  out.acknack(reader, writer, missing, next_count(source, reader),
              missing.num_bits == 0 && !packet.initial_acknack);
}

}  // namespace stormproof::capture::write
