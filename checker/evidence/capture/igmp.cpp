// Queries, reports of all versions, and leaves.
#include "checker/evidence/capture/igmp.hpp"

namespace stormproof::capture {

namespace {

/// A report of version 3: for each group how its sender listens to it (RFC 3376, section 4.2).
void add_report(const Address& from, Cursor cursor, Igmp& igmp) {
  constexpr std::uint8_t includes = 1;    // "from these sources only": from none, if there are none
  constexpr std::uint8_t to_include = 3;  // the same, as a change
  constexpr std::uint8_t block_sources = 6;
  constexpr std::size_t word = 4;
  cursor.skip(2);
  const std::uint16_t groups = cursor.u16();
  for (std::uint16_t k = 0; k < groups && !cursor.failed(); ++k) {
    const std::uint8_t type = cursor.u8();
    const std::size_t auxiliary = cursor.u8() * word;
    const std::size_t sources = cursor.u16();
    const Address group = Address::from(cursor.take(word));
    cursor.skip(sources * word + auxiliary);
    if (cursor.failed() || type == block_sources) continue;
    if (sources == 0 && (type == includes || type == to_include)) {
      igmp.members[group].erase(from);
    } else {
      igmp.members[group].insert(from);
    }
  }
}

}  // namespace

void add_igmp(const IpPacket& packet, Igmp& igmp) {
  constexpr std::uint8_t protocol = 2;
  constexpr std::uint8_t query = 0x11;
  constexpr std::uint8_t report_1 = 0x12;
  constexpr std::uint8_t report_2 = 0x16;
  constexpr std::uint8_t leave = 0x17;
  constexpr std::uint8_t report_3 = 0x22;
  constexpr std::size_t most_groups = 1024;
  if (packet.protocol != protocol || packet.is_fragment()) return;
  Cursor cursor{packet.payload};
  const std::uint8_t type = cursor.u8();
  cursor.skip(3);  // a time, and the checksum
  if (cursor.failed() || igmp.members.size() > most_groups) return;
  if (type == query) igmp.queriers.insert(packet.source);
  if (type == report_3) return add_report(packet.source, cursor, igmp);
  const Address group = Address::from(cursor.take(4));
  if (cursor.failed()) return;
  if (type == report_1 || type == report_2) igmp.members[group].insert(packet.source);
  if (type == leave) igmp.members[group].erase(packet.source);
}

}  // namespace stormproof::capture
