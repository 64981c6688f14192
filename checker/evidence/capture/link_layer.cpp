// Header lengths and protocol fields of the link types.
#include "checker/evidence/capture/link_layer.hpp"

#include <pcap.h>

namespace stormproof::capture {

namespace {

constexpr std::uint16_t ethertype_v4 = 0x0800;
constexpr std::uint16_t ethertype_v6 = 0x86dd;

bool is_vlan_tag(std::uint16_t ethertype) {
  return ethertype == 0x8100 || ethertype == 0x88a8 || ethertype == 0x9100;
}

/// What follows the VLAN tags, any number of them, if it is an IP packet. `ethertype` is that of
/// the frame, and `rest` what follows it.
std::optional<Bytes> after_tags(std::uint16_t ethertype, Bytes rest) {
  Cursor cursor{rest};
  while (is_vlan_tag(ethertype)) {
    cursor.skip(2);
    ethertype = cursor.u16();  // 0 at the end of the frame
  }
  if (cursor.failed()) return Bytes{};
  if (ethertype != ethertype_v4 && ethertype != ethertype_v6) return std::nullopt;
  return cursor.rest();
}

/// The same of a frame that has its EtherType at `offset`, and a payload from `payload` on.
std::optional<Bytes> after_ethertype(Bytes frame, std::size_t offset, std::size_t payload) {
  if (frame.size() < payload) return Bytes{};
  return after_tags(Cursor{part(frame, offset)}.u16(), part(frame, payload));
}

}  // namespace

bool is_supported_link(int link_type) {
  switch (link_type) {
    case DLT_EN10MB:
    case DLT_LINUX_SLL:
    case DLT_LINUX_SLL2:
    case DLT_RAW:
    case DLT_IPV4:
    case DLT_IPV6:
    case DLT_NULL:
    case DLT_LOOP:
      return true;
    default:
      return false;
  }
}

std::optional<Bytes> ip_packet(Bytes frame, int link_type) {
  constexpr std::size_t mac_addresses = 12;
  constexpr std::size_t sll_protocol = 14;
  constexpr std::size_t sll2_header = 20;
  constexpr std::size_t address_family = 4;
  switch (link_type) {
    case DLT_EN10MB:
      return after_ethertype(frame, mac_addresses, mac_addresses + 2);
    case DLT_LINUX_SLL:
      return after_ethertype(frame, sll_protocol, sll_protocol + 2);
    case DLT_LINUX_SLL2:
      return after_ethertype(frame, 0, sll2_header);
    case DLT_NULL:
    case DLT_LOOP:
      // The family's number depends on the system that captured; the IP header has its version.
      return part(frame, address_family);
    default:
      return frame;
  }
}

}  // namespace stormproof::capture
