// Blocks: their type, their length, what they hold, their length again.
#include "checker/evidence/capture/write/pcapng_writer.hpp"

#include <utility>

#include "checker/evidence/capture/write/byte_writer.hpp"

namespace stormproof::capture::write {

namespace {

constexpr std::uint32_t section_header = 0x0a0d0d0a;
constexpr std::uint32_t interface_description = 1;
constexpr std::uint32_t enhanced_packet = 6;

Buffer block(std::uint32_t type, const ByteWriter& content) {
  const std::size_t length = content.size() + 12;
  ByteWriter out;
  out.u32(type).u32(length).bytes(content.buffer()).u32(length);
  return std::move(out).take();
}

ByteWriter& padded(ByteWriter& out, Bytes bytes) {
  return out.bytes(bytes).zeros((4 - bytes.size() % 4) % 4);
}

void end_of_options(ByteWriter& out) { out.u16(0).u16(0); }

/// Link types of files are those of libpcap, but for raw IP, whose number differs by system.
std::uint32_t link_type_in_files(int link_type) {
  constexpr int raw_of_linux = 12;
  constexpr std::uint32_t raw = 101;
  return link_type == raw_of_linux ? raw : static_cast<std::uint32_t>(link_type);
}

}  // namespace

PcapngWriter::PcapngWriter(Sink sink, int link_type) : sink_{std::move(sink)} {
  constexpr std::uint32_t byte_order_magic = 0x1a2b3c4d;
  constexpr std::uint64_t unknown_length = UINT64_MAX;
  ByteWriter section;
  section.u32(byte_order_magic).u16(1).u16(0).u32(unknown_length).u32(unknown_length);
  sink_(block(section_header, section));
  constexpr std::uint16_t time_resolution = 9;  // the option, and 10⁻⁹ s
  ByteWriter interface;
  interface.u16(link_type_in_files(link_type)).u16(0).u32(0);
  interface.u16(time_resolution).u16(1).u8(9).zeros(3);
  end_of_options(interface);
  sink_(block(interface_description, interface));
}

void PcapngWriter::packet(const Packet& packet, std::string_view comment) {
  const auto time = static_cast<std::uint64_t>(packet.time_ns);
  ByteWriter out;
  out.u32(0).u32(time >> 32U).u32(time).u32(packet.bytes.size()).u32(packet.original_length);
  padded(out, packet.bytes);
  if (!comment.empty()) {
    constexpr std::uint16_t comment_option = 1;
    out.u16(comment_option).u16(comment.size());
    padded(out, {reinterpret_cast<const std::uint8_t*>(comment.data()), comment.size()});
    end_of_options(out);
  }
  sink_(block(enhanced_packet, out));
}

}  // namespace stormproof::capture::write
