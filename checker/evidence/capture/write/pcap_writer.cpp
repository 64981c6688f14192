// pcap (nanosecond variant), Ethernet II, IPv4 (RFC 791, 1112) and UDP headers.
#include "checker/evidence/capture/write/pcap_writer.hpp"

#include "checker/evidence/capture/write/byte_writer.hpp"

namespace stormproof::capture::write {

namespace {

constexpr std::size_t ip_payload_limit = 1480;  // a multiple of 8, as fragments need

Bytes v4(const Address& address) { return part(address.bytes, 12); }

/// That of a host holds its IPv4 address and is locally administered; that of a group is given by
/// RFC 1112.
void add_mac(ByteWriter& out, const Address& address) {
  if (address.is_multicast()) {
    out.u32(0x01005e00U | (address.bytes[13] & 0x7fU)).bytes(part(address.bytes, 14));
  } else {
    out.u16(0x0200).bytes(v4(address));
  }
}

std::uint16_t checksum(Bytes header) {
  std::uint32_t sum = 0;
  for (Cursor words{header}; !words.rest().empty();) sum += words.u16();
  while (sum > 0xffff) sum = (sum & 0xffffU) + (sum >> 16U);
  return static_cast<std::uint16_t>(~sum);
}

Buffer ip_header(const UdpEnd& source, const UdpEnd& destination, std::uint16_t identification,
                 std::size_t offset, std::size_t length, bool more) {
  constexpr std::uint64_t more_fragments = 0x2000;
  constexpr std::size_t header_size = 20;
  constexpr std::size_t checksum_at = 10;
  ByteWriter out{ByteOrder::big};
  out.u8(0x45).u8(0).u16(header_size + length).u16(identification);
  out.u16(offset / 8 | (more ? more_fragments : 0)).u8(64).u8(17).u16(0);
  out.bytes(v4(source.address)).bytes(v4(destination.address));
  Buffer header = std::move(out).take();
  const std::uint16_t sum = checksum(header);
  header[checksum_at] = static_cast<std::uint8_t>(sum >> 8U);
  header[checksum_at + 1] = static_cast<std::uint8_t>(sum);
  return header;
}

}  // namespace

PcapWriter::PcapWriter(Sink sink) : sink_{std::move(sink)} {
  constexpr std::uint32_t nanosecond_magic = 0xa1b23c4d;
  constexpr std::uint32_t snap_length = 262'144;
  constexpr std::uint32_t ethernet = 1;
  ByteWriter out;
  out.u32(nanosecond_magic).u16(2).u16(4).u32(0).u32(0).u32(snap_length).u32(ethernet);
  sink_(out.buffer());
}

void PcapWriter::datagram(std::int64_t time_ns, const UdpEnd& source, const UdpEnd& destination,
                          Bytes payload) {
  constexpr std::uint64_t second = 1'000'000'000;
  constexpr std::uint16_t ipv4 = 0x0800;
  constexpr std::size_t udp_header = 8;
  ByteWriter udp{ByteOrder::big};
  // Checksum 0: none was computed.
  udp.u16(source.port).u16(destination.port).u16(udp_header + payload.size()).u16(0).bytes(payload);
  const auto time = static_cast<std::uint64_t>(time_ns);
  const std::uint16_t identification = ++identification_[source.address];
  for (std::size_t offset = 0; offset < udp.size(); offset += ip_payload_limit) {
    const Bytes piece = part(udp.buffer(), offset, ip_payload_limit);
    const bool more = offset + piece.size() < udp.size();
    ByteWriter frame{ByteOrder::big};
    add_mac(frame, destination.address);
    add_mac(frame, source.address);
    frame.u16(ipv4);
    frame.bytes(ip_header(source, destination, identification, offset, piece.size(), more));
    frame.bytes(piece);
    ByteWriter record;
    record.u32(time / second).u32(time % second).u32(frame.size()).u32(frame.size());
    sink_(record.bytes(frame.buffer()).buffer());
  }
}

}  // namespace stormproof::capture::write
