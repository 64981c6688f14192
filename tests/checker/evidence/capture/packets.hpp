// Packets built byte by byte, for tests: messages, datagrams, frames and capture files as any
// sender and any capture program might have made them, also wrong ones.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/capture/bytes.hpp"
#include "checker/evidence/capture/events.hpp"

namespace stormproof::capture::testing {

using Buffer = std::vector<std::uint8_t>;

/// Appends numbers in a byte order.
class Writer {
 public:
  explicit Writer(ByteOrder order = ByteOrder::big) : order_{order} {}

  Writer& u8(std::uint64_t value) { return number(value, 1); }
  Writer& u16(std::uint64_t value) { return number(value, 2); }
  Writer& u32(std::uint64_t value) { return number(value, 4); }
  Writer& sequence_number(std::int64_t value);
  /// An entity id: octets, in no byte order.
  Writer& entity(EntityId value);
  Writer& bytes(Bytes bytes);
  Writer& text(const std::string& text);

  [[nodiscard]] ByteOrder order() const { return order_; }
  [[nodiscard]] const Buffer& buffer() const { return buffer_; }

 private:
  Writer& number(std::uint64_t value, int size);

  ByteOrder order_;
  Buffer buffer_;
};

/// A prefix that ends in `number`.
[[nodiscard]] GuidPrefix prefix(std::uint8_t number);

/// An RTPS message under construction.
class Message {
 public:
  explicit Message(const GuidPrefix& source, ByteOrder order = ByteOrder::little,
                   VendorId vendor = fastdds_vendor);

  Message& to(const GuidPrefix& destination);
  Message& from(const GuidPrefix& source);
  Message& timestamp();
  Message& vendor_specific();
  /// SPDP: announces metatraffic locators.
  Message& announcement(const std::vector<UdpEnd>& locators, std::int64_t number = 1);
  /// SEDP: describes the endpoint whose entity key is `number`.
  Message& descriptor(EntityId writer, std::int64_t number, bool is_gone = false);
  Message& heartbeat(EntityId writer, std::int64_t first, std::int64_t last, std::uint32_t count,
                     std::uint8_t flags = 0);
  /// `bits` is the bitmap's first word.
  Message& acknack(EntityId writer, std::int64_t base, std::uint32_t num_bits, std::uint32_t bits,
                   bool is_final, std::uint32_t count = 1);
  Message& gap(EntityId writer, std::int64_t start, std::int64_t base);
  Message& submessage(std::uint8_t id, std::uint8_t flags, Bytes body);

  [[nodiscard]] const Buffer& buffer() const { return message_.buffer(); }

 private:
  [[nodiscard]] Writer body() const { return Writer{order_}; }

  ByteOrder order_;
  Writer message_;
};

struct Route {
  UdpEnd source{};
  UdpEnd destination{};
  std::uint32_t id = 0;  ///< 0: none, so that equal packets are different ones
};
/// 10.0.0.`host`:`port`.
[[nodiscard]] UdpEnd at(std::uint8_t host, std::uint16_t port);
/// 239.255.0.1:7400.
[[nodiscard]] UdpEnd multicast();

/// UDP header and payload.
[[nodiscard]] Buffer udp(const Route& route, Bytes payload);
/// One IPv4 packet with the bytes `offset` … `offset + length` of a UDP datagram.
[[nodiscard]] Buffer ipv4_fragment(const Route& route, Bytes datagram, std::size_t offset,
                                   std::size_t length, bool more);
[[nodiscard]] Buffer ipv4(const Route& route, Bytes payload);
[[nodiscard]] Buffer ipv6(const Route& route, Bytes payload);
/// IGMP from 10.0.0.`host`, with any body; and a message of version 1 or 2 about 239.255.0.1.
[[nodiscard]] Buffer igmp(std::uint8_t host, Bytes body);
[[nodiscard]] Buffer igmp_message(std::uint8_t host, std::uint8_t type);
[[nodiscard]] Buffer ethernet(Bytes ip, std::uint16_t type = 0x0800);

/// A pcap file under construction.
class PcapFile {
 public:
  explicit PcapFile(std::uint32_t link_type = 1, ByteOrder order = ByteOrder::little,
                    bool in_nanoseconds = false);
  /// Adds a frame `microseconds` after 1,000,000,000 s.
  PcapFile& frame(std::int64_t microseconds, Bytes frame);
  /// Adds a message in one Ethernet frame.
  PcapFile& message(std::int64_t microseconds, const Route& route, const Message& message);
  /// Adds what the snap length left of a frame: its first `captured` bytes.
  PcapFile& cut_frame(std::int64_t microseconds, Bytes frame, std::size_t captured);
  [[nodiscard]] const Buffer& buffer() const { return file_.buffer(); }

 private:
  Writer file_;
  bool in_nanoseconds_;
};

/// A pcapng file under construction.
class PcapngFile {
 public:
  explicit PcapngFile(ByteOrder order = ByteOrder::little);
  /// Adds an interface. `resolution`: times count 10^-n s, or with the highest bit 2^-n s.
  PcapngFile& interface(std::uint16_t link_type, std::uint8_t resolution = 6);
  /// Adds a packet at `time` in the units of its interface.
  PcapngFile& packet(std::uint32_t interface, std::uint64_t time, Bytes frame);
  /// Adds any block; its length is that of the body, unless given.
  PcapngFile& block(std::uint32_t type, Bytes body, std::optional<std::uint32_t> length = {});
  [[nodiscard]] const Buffer& buffer() const { return file_.buffer(); }

 private:
  Writer file_;
};

/// Nanoseconds since 1970 of `microseconds` in a PcapFile.
[[nodiscard]] std::int64_t time_of(std::int64_t microseconds);
/// Reads files as "0.pcap", "1.pcap", …; fails the test if that gives an error.
[[nodiscard]] Conversation conversation_of(const std::vector<Buffer>& files);

}  // namespace stormproof::capture::testing
