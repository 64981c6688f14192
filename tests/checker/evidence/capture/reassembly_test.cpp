// UDP datagrams from IP fragments: in any order, and what hostile ones cost.
#include <algorithm>

#include <gtest/gtest.h>

#include "checker/evidence/capture/ip_reassembly.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture {

namespace reassembly_test {

using namespace testing;

const Route route{at(1, 7410), at(2, 7411), 5};

/// Feeds IP packets to a reassembly, and keeps what comes out.
struct Reassembler {
  Remarks remarks;
  IpReassembly reassembly;
  std::vector<Buffer> payloads;
  std::uint64_t packets = 0;
  std::int64_t now_ns = 0;

  explicit Reassembler(IpReassembly::Limits limits = {}) : reassembly{"a", remarks, limits} {}

  void add(const Buffer& ip) {
    Packet packet{++packets, now_ns, static_cast<std::uint32_t>(ip.size()), ip};
    if (const auto datagram = reassembly.add(packet, ip)) {
      payloads.emplace_back(datagram->payload.begin(), datagram->payload.end());
    }
  }
  [[nodiscard]] std::string remark() const {
    return remarks.list().empty() ? "" : remarks.list().front().what;
  }
};

Buffer numbered(std::size_t size) {
  Buffer bytes(size);
  for (std::size_t k = 0; k < size; ++k) bytes[k] = static_cast<std::uint8_t>(k * 7 + k / 256);
  return bytes;
}

/// A datagram of 24 + 24 + 12 bytes in three fragments.
std::vector<Buffer> three_fragments(const Buffer& payload) {
  const Buffer datagram = udp(route, payload);
  return {ipv4_fragment(route, datagram, 0, 24, true), ipv4_fragment(route, datagram, 24, 24, true),
          ipv4_fragment(route, datagram, 48, 12, false)};
}

TEST(Reassembly, FragmentsInAnyOrderAndTwice) {
  const Buffer payload = numbered(52);
  const std::vector<Buffer> fragments = three_fragments(payload);
  std::vector<std::size_t> order{0, 1, 2};
  do {
    Reassembler parts;
    for (const std::size_t k : order) {
      parts.add(fragments[k]);
      if (k != order.back()) parts.add(fragments[k]);
    }
    ASSERT_EQ(parts.payloads.size(), 1U);
    EXPECT_EQ(parts.payloads[0], payload);
    EXPECT_EQ(parts.remark(), "");
    EXPECT_EQ(parts.reassembly.waiting_bytes(), 0U);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Reassembly, FragmentsOfSeveralDatagramsDoNotMix) {
  Reassembler parts;
  Route other = route;
  other.id = 6;
  const Buffer one = numbered(52);
  const Buffer two(52, 9);
  const Buffer second = udp(other, two);
  for (const Buffer& fragment : three_fragments(one)) {
    if (parts.packets == 2) parts.add(ipv4_fragment(other, second, 0, 32, true));
    parts.add(fragment);
  }
  parts.add(ipv4_fragment(other, second, 32, 28, false));
  ASSERT_EQ(parts.payloads.size(), 2U);
  EXPECT_EQ(parts.payloads[0], one);
  EXPECT_EQ(parts.payloads[1], two);
}

TEST(Reassembly, AMissingFragmentIsReported) {
  Reassembler parts;
  const std::vector<Buffer> fragments = three_fragments(numbered(52));
  parts.add(fragments[0]);
  parts.add(fragments[2]);
  parts.reassembly.finish();
  EXPECT_TRUE(parts.payloads.empty());
  EXPECT_EQ(parts.remark(), "datagrams of which IP fragments are missing");
  EXPECT_EQ(parts.remarks.list().front().first, "a, packet 1");
}

TEST(Reassembly, OverlapsMakeADatagramVoid) {
  const Buffer datagram = udp(route, numbered(52));
  Buffer other = datagram;
  other[30] ^= 1U;
  for (const Buffer& overlapping :
       {ipv4_fragment(route, datagram, 16, 16, true), ipv4_fragment(route, datagram, 0, 32, true),
        ipv4_fragment(route, other, 24, 24, true)}) {
    Reassembler parts;
    parts.add(ipv4_fragment(route, datagram, 0, 24, true));
    parts.add(ipv4_fragment(route, datagram, 24, 24, true));
    parts.add(overlapping);
    EXPECT_EQ(parts.remark(), "datagrams whose IP fragments overlap");
    parts.add(ipv4_fragment(route, datagram, 48, 12, false));
    EXPECT_TRUE(parts.payloads.empty());
  }
}

TEST(Reassembly, ImpossibleLengthsAreRefused) {
  const Buffer large = numbered(70'000);
  const Buffer datagram = udp(route, numbered(52));
  const auto remark_after = [](const std::vector<Buffer>& fragments) {
    Reassembler parts;
    for (const Buffer& fragment : fragments) parts.add(fragment);
    EXPECT_TRUE(parts.payloads.empty());
    return parts.remark();
  };
  constexpr const char* impossible = "IP fragments with impossible lengths";
  EXPECT_EQ(remark_after({ipv4_fragment(route, large, 65'528, 64, false)}), impossible);
  EXPECT_EQ(remark_after({ipv4_fragment(route, datagram, 0, 23, true)}), impossible);
  EXPECT_EQ(remark_after({ipv4_fragment(route, datagram, 8, 0, true)}), impossible);
  // Two ends, and bytes behind the end.
  EXPECT_EQ(remark_after({ipv4_fragment(route, datagram, 48, 8, false),
                          ipv4_fragment(route, datagram, 56, 4, false)}),
            impossible);
  EXPECT_EQ(remark_after({ipv4_fragment(route, datagram, 24, 24, true),
                          ipv4_fragment(route, datagram, 8, 8, false)}),
            impossible);
}

TEST(Reassembly, FragmentsDoNotWaitForEver) {
  Reassembler parts;
  const std::vector<Buffer> fragments = three_fragments(numbered(52));
  parts.add(fragments[0]);
  parts.add(fragments[1]);
  parts.now_ns = 30'000'000'001;
  parts.add(fragments[2]);
  EXPECT_TRUE(parts.payloads.empty());
  EXPECT_EQ(parts.remark(), "datagrams of which IP fragments are missing");
}

TEST(Reassembly, AFloodOfFragmentsTakesBoundedMemory) {
  Reassembler parts{{.datagrams = 16, .bytes = 10'000}};
  const Buffer datagram = udp(route, numbered(60'000));
  for (std::uint32_t id = 0; id < 2'000; ++id) {
    Route one = route;
    one.id = id % 50;
    parts.add(ipv4_fragment(one, datagram, 8 * (id % 5'000), 8, true));
    EXPECT_LT(parts.reassembly.waiting_bytes(), 10'200U);
  }
  EXPECT_TRUE(parts.payloads.empty());
}

TEST(Reassembly, UdpLengthsAreChecked) {
  Buffer datagram = udp(route, numbered(20));
  datagram[5] = 29;  // one byte more than there is
  Reassembler parts;
  parts.add(ipv4_fragment(route, datagram, 0, datagram.size(), false));
  EXPECT_EQ(parts.remark(), "UDP datagrams with an impossible length");
  datagram[5] = 18;  // link padding behind it
  parts.add(ipv4_fragment(route, datagram, 0, datagram.size(), false));
  ASSERT_EQ(parts.payloads.size(), 1U);
  EXPECT_EQ(parts.payloads[0].size(), 10U);
}

TEST(Reassembly, PacketsCutByTheSnapLengthAreReportedWhereverTheyAreCut) {
  const Buffer frame = ethernet(ipv4(route, Message{prefix(1)}.announcement({}).buffer()));
  for (std::size_t captured = 0; captured < frame.size(); ++captured) {
    PcapFile file;
    file.frame(0, frame).cut_frame(1, frame, captured);
    const Conversation conversation = conversation_of({file.buffer()});
    EXPECT_EQ(conversation.datagrams.size(), 1U);
    ASSERT_EQ(conversation.remarks.size(), 1U) << captured;
    EXPECT_EQ(
        conversation.remarks[0],
        (Remark{"IP packets cut short by the capture (its snap length)", "0.pcap, packet 2", 1}));
  }
}

TEST(Reassembly, OtherPacketsAreNoneOfItsBusiness) {
  const Buffer frame = ethernet(Buffer(46, 0), 0x0806);
  PcapFile file;
  file.message(0, route, Message{prefix(1)}.announcement({}));
  file.frame(1, frame).cut_frame(2, frame, 30);
  EXPECT_TRUE(conversation_of({file.buffer()}).remarks.empty());
}

TEST(Reassembly, APacketThatIsLongerThanItsFrame) {
  Buffer ip = ipv4(route, numbered(20));
  ip.pop_back();
  Reassembler parts;
  parts.add(ip);
  EXPECT_EQ(parts.remark(), "IP packets that are longer than their frames");
}

TEST(Reassembly, HostileHeadersOfIpv6End) {
  const auto packet = [](std::uint8_t next, const Buffer& payload) {
    Writer out;
    out.u32(0x60000000).u16(payload.size()).u8(next).u8(64).bytes(Buffer(32, 1));
    return out.bytes(payload).buffer();
  };
  Writer chain;
  for (int k = 0; k < 100; ++k) chain.u8(k % 2 == 0 ? 60 : 0).u8(0).u16(0).u32(0);
  Reassembler parts;
  parts.add(packet(0, chain.buffer()));
  parts.add(packet(0, Writer{}.u8(17).u8(255).u16(0).u32(0).buffer()));
  parts.add(packet(44, Writer{}.u8(44).u8(0).u16(0xfff8 | 1U).u32(1).bytes(Buffer(8)).buffer()));
  parts.reassembly.finish();
  EXPECT_TRUE(parts.payloads.empty());
}

TEST(Reassembly, Ipv6WholeAndInFragments) {
  Route v6 = route;
  v6.source.address.bytes = {0xfe, 0x80, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  v6.destination.address.bytes = {0xff, 0x03, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2};
  EXPECT_TRUE(v6.destination.address.is_multicast());
  EXPECT_EQ(to_string(v6.source), "[fe80::1]:7410");
  const Buffer payload = numbered(40);
  Reassembler parts;
  parts.add(ipv6(v6, payload));
  const Buffer datagram = udp(v6, payload);
  const auto fragment = [&](std::size_t offset, std::size_t length, bool more) {
    Writer out;
    out.u32(0x60000000).u16(length + 8).u8(44).u8(64);
    out.bytes(v6.source.address.bytes).bytes(v6.destination.address.bytes);
    out.u8(17).u8(0).u16(offset | (more ? 1U : 0U)).u32(77);
    return out.bytes(part(datagram, offset, length)).buffer();
  };
  parts.add(fragment(24, 24, false));
  parts.add(fragment(0, 24, true));
  ASSERT_EQ(parts.payloads.size(), 2U);
  EXPECT_EQ(parts.payloads[0], payload);
  EXPECT_EQ(parts.payloads[1], payload);
}

}  // namespace reassembly_test
}  // namespace stormproof::capture
