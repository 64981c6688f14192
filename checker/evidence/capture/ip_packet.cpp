// IPv4 (RFC 791) and IPv6 with its extension headers (RFC 8200).
#include "checker/evidence/capture/ip_packet.hpp"

namespace stormproof::capture {

namespace {

constexpr std::size_t fragment_unit = 8;

std::optional<IpPacket> parse_v4(Bytes bytes) {
  constexpr std::size_t shortest_header = 20;
  constexpr std::uint16_t more_fragments = 0x2000;
  constexpr std::uint16_t offset_bits = 0x1fff;
  Cursor cursor{bytes};
  const std::size_t header = (cursor.u8() & 0x0fU) * std::size_t{4};
  cursor.skip(1);
  const std::size_t total = cursor.u16();
  IpPacket packet;
  packet.id = cursor.u16();
  const std::uint16_t fragment = cursor.u16();
  packet.time_to_live = cursor.u8();
  packet.protocol = cursor.u8();
  cursor.skip(2);
  packet.source = Address::from(cursor.take(4));
  packet.destination = Address::from(cursor.take(4));
  if (cursor.failed() || header < shortest_header || total < header) return std::nullopt;
  packet.offset = (fragment & offset_bits) * fragment_unit;
  packet.more = (fragment & more_fragments) != 0;
  packet.is_cut = bytes.size() < total;
  packet.payload = part(bytes, header, total - header);
  return packet;
}

/// Walks the extension headers in `packet.payload`; false if they are not to be understood.
bool skip_extensions(IpPacket& packet) {
  constexpr std::uint8_t hop_by_hop = 0;
  constexpr std::uint8_t routing = 43;
  constexpr std::uint8_t fragment = 44;
  constexpr std::uint8_t destination_options = 60;
  constexpr int most_extensions = 8;
  for (int k = 0; k < most_extensions; ++k) {
    Cursor cursor{packet.payload};
    if (packet.protocol == fragment) {
      packet.protocol = cursor.u8();
      cursor.skip(1);
      const std::uint16_t field = cursor.u16();
      packet.id = cursor.u32();
      packet.offset = field & 0xfff8U;
      packet.more = (field & 1U) != 0;
      packet.payload = cursor.rest();
      if (cursor.failed()) return false;
      if (packet.offset > 0) return true;  // the headers that follow are in the first fragment
    } else if (packet.protocol == hop_by_hop || packet.protocol == routing ||
               packet.protocol == destination_options) {
      packet.protocol = cursor.u8();
      const std::size_t units = cursor.u8() + std::size_t{1};
      cursor.skip(units * 8 - 2);
      packet.payload = cursor.rest();
      if (cursor.failed()) return false;
    } else {
      return true;
    }
  }
  return false;
}

std::optional<IpPacket> parse_v6(Bytes bytes) {
  constexpr std::size_t header = 40;
  Cursor cursor{bytes};
  cursor.skip(4);
  const std::size_t length = cursor.u16();
  IpPacket packet;
  packet.protocol = cursor.u8();
  packet.time_to_live = cursor.u8();
  packet.source = Address::from(cursor.take(16));
  packet.destination = Address::from(cursor.take(16));
  if (cursor.failed()) return std::nullopt;
  packet.payload = part(bytes, header, length);
  packet.is_cut = packet.payload.size() < length;
  if (!skip_extensions(packet) && !packet.is_cut) return std::nullopt;
  return packet;
}

}  // namespace

std::optional<IpPacket> parse_ip(Bytes bytes) {
  if (bytes.empty()) return std::nullopt;
  switch (bytes[0] >> 4U) {
    case 4:
      return parse_v4(bytes);
    case 6:
      return parse_v6(bytes);
    default:
      return std::nullopt;
  }
}

}  // namespace stormproof::capture
