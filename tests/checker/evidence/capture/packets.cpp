// The bytes of packets.
#include "tests/checker/evidence/capture/packets.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace stormproof::capture::testing {

namespace {

constexpr std::size_t unpack_limit_of_tests = 64U << 20U;

/// A locator as a parameter value has it.
void add_locator(Writer& out, const UdpEnd& end) {
  constexpr std::uint32_t udp_v4 = 1;
  constexpr std::uint32_t udp_v6 = 2;
  Buffer address(end.address.bytes.begin(), end.address.bytes.end());
  if (end.address.is_v4()) std::fill_n(address.begin(), 12, std::uint8_t{0});
  out.u16(0x32).u16(24).u32(end.address.is_v4() ? udp_v4 : udp_v6).u32(end.port).bytes(address);
}

void add_guid(Writer& out, std::uint16_t parameter, const GuidPrefix& prefix, EntityId entity) {
  out.u16(parameter).u16(16).bytes(prefix.bytes).entity(entity);
}

}  // namespace

Writer& Writer::number(std::uint64_t value, int size) {
  for (int k = 0; k < size; ++k) {
    const int shift = 8 * (order_ == ByteOrder::big ? size - 1 - k : k);
    buffer_.push_back(static_cast<std::uint8_t>(value >> shift));
  }
  return *this;
}

Writer& Writer::sequence_number(std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  return u32(bits >> 32U).u32(bits & 0xffffffffU);
}

Writer& Writer::entity(EntityId value) { return bytes(Writer{ByteOrder::big}.u32(value).buffer()); }

Writer& Writer::bytes(Bytes bytes) {
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  return *this;
}

Writer& Writer::text(const std::string& text) {
  buffer_.insert(buffer_.end(), text.begin(), text.end());
  return *this;
}

GuidPrefix prefix(std::uint8_t number) {
  GuidPrefix result;
  result.bytes = {1, 15, 0, 0, 0, 0, 0, 0, 0, 0, 0, number};
  return result;
}

Message::Message(const GuidPrefix& source, ByteOrder order, VendorId vendor) : order_{order} {
  message_.text("RTPS").u8(2).u8(2).u16(vendor).bytes(source.bytes);
}

Message& Message::submessage(std::uint8_t id, std::uint8_t flags, Bytes bytes) {
  const unsigned endian = order_ == ByteOrder::little ? 1 : 0;
  message_.u8(id).u8(flags | endian);
  message_.bytes(body().u16(bytes.size()).buffer()).bytes(bytes);
  return *this;
}

Message& Message::to(const GuidPrefix& destination) {
  return submessage(0x0e, 0, destination.bytes);
}

Message& Message::from(const GuidPrefix& source) {
  return submessage(0x0c, 0, body().u32(0).u8(2).u8(2).u16(0).bytes(source.bytes).buffer());
}

Message& Message::timestamp() { return submessage(0x09, 0, body().u32(1).u32(2).buffer()); }

Message& Message::vendor_specific() { return submessage(0x80, 0, body().u32(7).buffer()); }

Message& Message::announcement(const std::vector<UdpEnd>& locators, std::int64_t number) {
  Writer out = body();
  out.u16(0).u16(16).entity(entity::spdp_reader).entity(entity::spdp_writer);
  out.sequence_number(number);
  out.u8(0).u8(order_ == ByteOrder::little ? 3 : 2).u16(0);
  for (const UdpEnd& locator : locators) add_locator(out, locator);
  out.u16(0x8007).u16(4).u32(9).u16(1).u16(0);
  return submessage(0x15, 0x04, out.buffer());
}

Message& Message::descriptor(EntityId writer, std::int64_t number, bool is_gone) {
  const auto endpoint = static_cast<EntityId>(number << 8 | 0x03);
  const GuidPrefix source = [this] {
    GuidPrefix found;
    std::copy_n(message_.buffer().begin() + 8, found.bytes.size(), found.bytes.begin());
    return found;
  }();
  Writer out = body();
  out.u16(0).u16(16).entity(writer + 5).entity(writer).sequence_number(number);
  if (is_gone) {
    add_guid(out, 0x70, source, endpoint);
    out.u16(0x71).u16(4).entity(3).u16(1).u16(0);
    return submessage(0x15, 0x02, out.buffer());
  }
  out.u8(0).u8(order_ == ByteOrder::little ? 3 : 2).u16(0);
  out.u16(5).u16(8).u32(4).text("abc").u8(0);
  add_guid(out, 0x5a, source, endpoint);
  out.u16(1).u16(0);
  return submessage(0x15, 0x04, out.buffer());
}

Message& Message::heartbeat(EntityId writer, std::int64_t first, std::int64_t last,
                            std::uint32_t count, std::uint8_t flags) {
  Writer out = body();
  out.entity(0).entity(writer).sequence_number(first).sequence_number(last).u32(count);
  return submessage(0x07, flags, out.buffer());
}

Message& Message::acknack(EntityId writer, std::int64_t base, std::uint32_t num_bits,
                          std::uint32_t bits, bool is_final, std::uint32_t count) {
  Writer out = body();
  out.entity(writer + 5).entity(writer).sequence_number(base).u32(num_bits);
  for (std::uint32_t word = 0; word * 32 < num_bits; ++word) out.u32(word == 0 ? bits : 0);
  out.u32(count);
  return submessage(0x06, is_final ? 2 : 0, out.buffer());
}

Message& Message::gap(EntityId writer, std::int64_t start, std::int64_t base) {
  Writer out = body();
  out.entity(writer + 5).entity(writer).sequence_number(start).sequence_number(base).u32(0);
  return submessage(0x08, 0, out.buffer());
}

UdpEnd at(std::uint8_t host, std::uint16_t port) {
  return {Address::from(Buffer{10, 0, 0, host}), port};
}

UdpEnd multicast() { return {Address::from(Buffer{239, 255, 0, 1}), 7400}; }

Buffer udp(const Route& route, Bytes payload) {
  Writer out;
  out.u16(route.source.port).u16(route.destination.port).u16(payload.size() + 8).u16(0);
  return out.bytes(payload).buffer();
}

Buffer ipv4_fragment(const Route& route, Bytes datagram, std::size_t offset, std::size_t length,
                     bool more) {
  const Bytes payload = part(datagram, offset, length);
  Writer out;
  out.u8(0x45).u8(0).u16(payload.size() + 20).u16(route.id);
  out.u16(offset / 8 | (more ? 0x2000U : 0U)).u8(64).u8(17).u16(0);
  out.bytes(part(route.source.address.bytes, 12)).bytes(part(route.destination.address.bytes, 12));
  return out.bytes(payload).buffer();
}

Buffer ipv4(const Route& route, Bytes payload) {
  const Buffer datagram = udp(route, payload);
  return ipv4_fragment(route, datagram, 0, datagram.size(), false);
}

Buffer ipv6(const Route& route, Bytes payload) {
  const Buffer datagram = udp(route, payload);
  Writer out;
  out.u32(0x60000000).u16(datagram.size()).u8(17).u8(64);
  out.bytes(route.source.address.bytes).bytes(route.destination.address.bytes);
  return out.bytes(datagram).buffer();
}

Buffer igmp(std::uint8_t host, Bytes body) {
  constexpr std::size_t protocol_at = 9;
  constexpr std::uint8_t protocol = 2;
  Buffer packet = ipv4_fragment({at(host, 0), multicast()}, body, 0, body.size(), false);
  packet[protocol_at] = protocol;
  return packet;
}

Buffer igmp_message(std::uint8_t host, std::uint8_t type) {
  Writer body;
  body.u8(type).u8(0).u16(0).bytes(part(multicast().address.bytes, 12));
  return igmp(host, body.buffer());
}

Buffer ethernet(Bytes ip, std::uint16_t type) {
  Writer out;
  out.u32(0).u32(0).u32(0).u16(type);
  return out.bytes(ip).buffer();
}

PcapFile::PcapFile(std::uint32_t link_type, ByteOrder order, bool in_nanoseconds)
    : file_{order}, in_nanoseconds_{in_nanoseconds} {
  file_.u32(in_nanoseconds ? 0xa1b23c4d : 0xa1b2c3d4).u16(2).u16(4);
  file_.u32(0).u32(0).u32(65535).u32(link_type);
}

PcapFile& PcapFile::frame(std::int64_t microseconds, Bytes frame) {
  return cut_frame(microseconds, frame, frame.size());
}

PcapFile& PcapFile::cut_frame(std::int64_t microseconds, Bytes frame, std::size_t captured) {
  const auto time = static_cast<std::uint64_t>(microseconds);
  const std::uint64_t unit = in_nanoseconds_ ? 1000 : 1;
  file_.u32(1'000'000'000 + time / 1'000'000).u32(time % 1'000'000 * unit);
  file_.u32(captured).u32(frame.size()).bytes(part(frame, 0, captured));
  return *this;
}

PcapFile& PcapFile::message(std::int64_t microseconds, const Route& route, const Message& message) {
  return frame(microseconds, ethernet(ipv4(route, message.buffer())));
}

PcapngFile::PcapngFile(ByteOrder order) : file_{order} {
  block(0x0a0d0d0a, Writer{order}.u32(0x1a2b3c4d).u16(1).u16(0).u32(~0U).u32(~0U).buffer());
}

PcapngFile& PcapngFile::interface(std::uint16_t link_type, std::uint8_t resolution) {
  Writer body{file_.order()};
  body.u16(link_type).u16(0).u32(0).u16(9).u16(1).u8(resolution).u8(0).u16(0).u32(0);
  return block(1, body.buffer());
}

PcapngFile& PcapngFile::packet(std::uint32_t interface, std::uint64_t time, Bytes frame) {
  Writer body{file_.order()};
  body.u32(interface).u32(time >> 32U).u32(time & 0xffffffffU);
  body.u32(frame.size()).u32(frame.size()).bytes(frame);
  return block(6, body.buffer());
}

PcapngFile& PcapngFile::block(std::uint32_t type, Bytes body, std::optional<std::uint32_t> length) {
  const std::size_t padding = (4 - body.size() % 4) % 4;
  const std::uint64_t size = length ? *length : 12 + body.size() + padding;
  file_.u32(type).u32(size).bytes(body).bytes(Buffer(padding, 0)).u32(size);
  return *this;
}

std::int64_t time_of(std::int64_t microseconds) {
  return 1'000'000'000'000'000'000 + microseconds * 1000;
}

Conversation conversation_of(const std::vector<Buffer>& files) {
  std::vector<MemoryCapture> captures;
  for (const Buffer& file : files) {
    captures.push_back({std::to_string(captures.size()) + ".pcap", file, unpack_limit_of_tests});
  }
  auto conversation = read_conversation(captures);
  if (!conversation) {
    ADD_FAILURE() << to_string(conversation.error());
    return {};
  }
  return std::move(*conversation);
}

}  // namespace stormproof::capture::testing
