// A generated RTPS/UDP packet, from its emission until its last service. One record can stand for
// several packets that differ only in their destination (a HEARTBEAT to every open relation of a
// writer, an SPDP copy to every known participant): the copies are told apart when they leave the
// source queue, so a backlog of millions of HEARTBEATs takes the memory of the decisions that
// caused them (model/engine/packet_tape.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "model/engine/descriptor_set.hpp"
#include "model/run_result.hpp"
#include "model/units.hpp"

namespace stormproof::model {

enum class PacketKind : std::uint8_t {
  spdp_multicast,
  spdp_unicast,
  data,
  heartbeat,
  acknack,
  user_heartbeat,  ///< of a control-only relation
  user_acknack,    ///< of a control-only relation
  lookup,          ///< samples that ask for types, and answers, of a control-only relation
  rtps_message,    ///< of Cyclone DDS, with submessages of any kind
  // With a Discovery Server: of a client's announcements, then of the server's three writers.
  registration,            ///< DATA(p) of a client
  registration_heartbeat,  ///< HEARTBEAT of a client for it
  registration_acknack,    ///< ACKNACK of the server for it
  relayed,                 ///< DATA and HEARTBEAT, GAP and HEARTBEAT, or one of them
  relayed_acknack
};
inline constexpr std::size_t packet_kind_count =
    static_cast<std::size_t>(PacketKind::relayed_acknack) + 1;

[[nodiscard]] const char* name_of(PacketKind kind);

struct Submessage;  // model/engine/submessage.hpp
struct Relayed;     // model/fastdds/relayed.hpp

/// What a packet is, but for its lists.
struct PacketNumbers {
  std::uint64_t number = 0;  ///< position in emission order, from 0; of the first copy
  Nanoseconds emitted;       ///< when it entered the backlog
  std::uint32_t pair = 0;    ///< cross-host pair (writer side, reader side); of the first copy.
                             ///< For a multicast packet: the number of the sending participant
  std::uint32_t payload_bytes = 0;
  std::uint32_t copies = 1;      ///< how many packets this record stands for
  std::uint32_t rank_limit = 0;  ///< the copies go to the recipients of rank below this one
  std::uint32_t detail = 0;      ///< Fast DDS. HEARTBEAT (also in DATA): how many descriptors it
                             ///< announces; ACKNACK: its base; control-only relations: the relation
  std::uint32_t initial_data = 0;  ///< how many of its descriptors count as generated for the first
                                   ///< time, of those that count; control-only relations: how many
                                   ///< samples it carries
  std::uint32_t repair_data = 0;   ///< and how many of them as repeated; control-only relations:
                                   ///< the last sample that it carries, announces or acknowledges;
                                   ///< ACKNACK of a server that has a life: its number
  std::uint16_t heartbeats = 0;  ///< how many HEARTBEATs ride in it; the receiver sees them as one
  PacketKind kind{};
  Stream stream{};
  bool from_repair =
      false;  ///< DATA made by repair generation: its source completion starts suppression
  bool carries_initial = false;  ///< DATA: at least one descriptor was generated for the first time
  bool carries_heartbeat = false;  ///< DATA with a piggybacked HEARTBEAT
  bool initial_acknack = false;    ///< ACKNACK marked initial
  bool to_group = false;           ///< a message that goes to the multicast group
  bool to_nobody = false;          ///< an announcement to a port that nobody has
  TrafficClass use{};              ///< of a message, or of what a server relays: what it is for
  std::uint8_t port = 0;           ///< of its flow: 1 for data of applications, 0 for all else

  [[nodiscard]] bool multicast() const { return to_group || kind == PacketKind::spdp_multicast; }
  /// Whether it goes from the reader side to the writer side of its pair.
  [[nodiscard]] bool to_writer() const {
    return kind == PacketKind::acknack || kind == PacketKind::user_acknack ||
           kind == PacketKind::registration_acknack || kind == PacketKind::relayed_acknack;
  }
  [[nodiscard]] std::uint32_t relation() const {
    return 2 * pair + static_cast<std::uint32_t>(stream);
  }
  [[nodiscard]] std::uint32_t number_of_acknack() const { return repair_data; }
  void set_number_of_acknack(std::uint32_t k) { repair_data = k; }
  // Of a control-only relation, whose samples have the numbers from 1 on.
  [[nodiscard]] std::uint32_t samples() const { return initial_data; }
  [[nodiscard]] std::uint32_t last_sample() const { return repair_data; }
  void set_samples(std::uint32_t count, std::uint32_t last) {
    initial_data = count;
    repair_data = last;
  }
};

struct Packet : PacketNumbers {
  DescriptorSet descriptors;  ///< DATA: what it carries; ACKNACK: its bitmap
  std::shared_ptr<const std::vector<Submessage>> submessages;  ///< of a message
  std::shared_ptr<const Relayed> relayed;  ///< what a server sends, or is asked for

  /// Becomes a packet without lists. Memory of packets is used again: nothing is cleared first.
  void become(const PacketNumbers& numbers) {
    static_cast<PacketNumbers&>(*this) = numbers;
    if (!descriptors.empty()) descriptors = {};
    if (submessages) submessages.reset();
    if (relayed) relayed.reset();
  }
};

/// The class of channel use that a packet belongs to.
[[nodiscard]] inline TrafficClass traffic_class(const PacketNumbers& packet) {
  switch (packet.kind) {
    case PacketKind::spdp_multicast:
    case PacketKind::spdp_unicast:
    case PacketKind::registration:
    case PacketKind::registration_heartbeat:
    case PacketKind::registration_acknack:
      return TrafficClass::spdp;
    case PacketKind::data:
      return packet.carries_initial ? TrafficClass::initial_data : TrafficClass::repair_data;
    case PacketKind::heartbeat:
      return TrafficClass::heartbeat;
    case PacketKind::acknack:
      return TrafficClass::acknack;
    case PacketKind::user_heartbeat:
    case PacketKind::user_acknack:
      return TrafficClass::user_control;
    case PacketKind::lookup:
      return TrafficClass::lookup;
    case PacketKind::rtps_message:
    case PacketKind::relayed:
    case PacketKind::relayed_acknack:
      return packet.use;
  }
  return TrafficClass::spdp;
}

}  // namespace stormproof::model
