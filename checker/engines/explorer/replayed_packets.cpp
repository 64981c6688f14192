// From packets to slots.
#include "checker/engines/explorer/replayed_packets.hpp"

#include <algorithm>

#include "checker/engines/explorer/cyclone_messages.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/submessage.hpp"

namespace stormproof::explorer {

using model::PacketKind;

bool PacketList::Entry::is(const Slot& expected) const {
  if (expected.what != slot.what || expected.set != slot.set) return false;
  if (expected.relation != slot.relation) return false;
  return !is_part || (expected.flags == slot.flags && expected.number == slot.number);
}

void PacketList::emitted(const model::Packet& packet, std::uint32_t source,
                         std::span<const std::uint32_t> destinations) {
  Entry entry{packet.number, packet.emitted, {}, source};
  entry.slot.set = static_cast<std::uint16_t>(packet.descriptors.word(0));
  switch (packet.kind) {
    case PacketKind::rtps_message:
      note_message(packet, entry);
      break;
    case PacketKind::spdp_multicast:
      announcements.push_back(entry);
      break;
    case PacketKind::spdp_unicast:
      for (const std::uint32_t destination : destinations) {
        entry.reader = destination == 0 ? 0 : destination - 1;
        announcements.push_back(entry);
        ++entry.number;
      }
      break;
    case PacketKind::data:
    case PacketKind::heartbeat:
    case PacketKind::acknack:
      // The first pairs go from participant 0 to all others.
      if (!is_explored(packet, scope_)) break;
      entry.slot.what = packet.kind == PacketKind::data        ? What::data
                        : packet.kind == PacketKind::heartbeat ? What::heartbeat
                                                               : What::acknack;
      for (const std::uint32_t destination : destinations) {
        const std::uint32_t reader = (packet.to_writer() ? source : destination) - 1;
        entry.slot.relation = static_cast<std::uint8_t>(explored_relation(packet, reader, scope_));
        of_relations.push_back(entry);
        ++entry.number;
      }
      break;
    default:
      break;
  }
}

/// What is about the explored relation, or announces its participants.
void PacketList::note_message(const model::Packet& packet, Entry entry) {
  if (packet.submessages == nullptr) return;
  entry.is_part = true;
  for (const Slot& part : parts_of(*packet.submessages)) {
    entry.slot = part;
    of_relations.push_back(entry);
  }
  const bool announces = std::ranges::any_of(*packet.submessages, [](const model::Submessage& m) {
    return m.kind == model::Submessage::Kind::spdp;
  });
  const bool is_other = of_relations.empty() || of_relations.back().number != packet.number;
  if (announces && is_other) announcements.push_back(entry);
}

}  // namespace stormproof::explorer
