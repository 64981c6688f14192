// A packet that a capture of several interfaces holds several times is one packet; what a sender
// repeats is another.
#include "checker/evidence/capture/repeated_packets.hpp"

#include <gtest/gtest.h>

#include "checker/evidence/capture/counting.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture {
namespace repeated_packets_test {

using namespace testing;

constexpr std::uint32_t ethernet_link = 1;
constexpr std::uint32_t raw_link = 12;  // as libpcap has it on Linux: an IP packet alone
constexpr std::uint32_t cooked_link = 113;

Message descriptor() {
  return Message{prefix(1)}.to(prefix(2)).descriptor(entity::publications_writer, 1);
}
Route route(std::uint32_t id) { return {at(1, 7410), at(2, 7410), id}; }
Buffer packet(std::uint32_t id) { return ipv4(route(id), descriptor().buffer()); }

/// The same frame as another interface has it.
Buffer through_another(Buffer frame) {
  frame[0] ^= 2;
  return frame;
}
/// With a cooked header: `type` 0 for us, 4 from us.
Buffer cooked(std::uint8_t type, Bytes ip) {
  Writer out;
  out.u16(type).u16(1).u16(6).u32(0).u32(0).u16(0x0800).bytes(ip);
  return out.buffer();
}

std::size_t datagrams(const PcapFile& file) {
  return conversation_of({file.buffer()}).datagrams.size();
}

TEST(RepeatedPackets, OneIdentificationIsOnePacketHoweverOftenItIsSeen) {
  PcapFile file{ethernet_link};
  const Buffer frame = ethernet(packet(7));
  file.frame(0, frame).frame(3, frame).frame(9, through_another(frame));
  const Conversation conversation = conversation_of({file.buffer()});
  EXPECT_EQ(conversation.datagrams.size(), 1U);
  EXPECT_EQ(conversation.captures.front().packets, 3U);
  ASSERT_EQ(conversation.remarks.size(), 1U);
  EXPECT_EQ(conversation.remarks.front().count, 2U);
  EXPECT_EQ(conversation.remarks.front().first, "0.pcap, packet 2");
}

TEST(RepeatedPackets, WhatASenderRepeatsIsAnother) {
  PcapFile file{ethernet_link};
  file.frame(0, ethernet(packet(7))).frame(3, ethernet(packet(8)));
  EXPECT_EQ(datagrams(file), 2U);
}

TEST(RepeatedPackets, LaterTheIdentificationIsUsedAgain) {
  PcapFile file{ethernet_link};
  file.frame(0, ethernet(packet(7))).frame(10'001, ethernet(packet(7)));
  EXPECT_EQ(datagrams(file), 2U);
}

TEST(RepeatedPackets, RoutersWriteTheTimeToLiveAndInterfacesChecksums) {
  constexpr std::size_t time_to_live_at = 8;
  constexpr std::size_t udp_checksum_at = 20 + 6;
  Buffer routed = packet(7);
  --routed[time_to_live_at];
  routed[udp_checksum_at] ^= 0xff;
  PcapFile file{ethernet_link};
  file.frame(0, ethernet(packet(7))).frame(3, ethernet(routed));
  EXPECT_EQ(datagrams(file), 1U);
}

TEST(RepeatedPackets, AnotherByteIsAnotherPacket) {
  Buffer other = packet(7);
  ++other.back();
  PcapFile file{ethernet_link};
  file.frame(0, ethernet(packet(7))).frame(3, ethernet(other));
  EXPECT_EQ(datagrams(file), 2U);
}

TEST(RepeatedPackets, WithoutIdentificationAnotherInterfaceTells) {
  PcapFile same{ethernet_link};
  same.frame(0, ethernet(packet(0))).frame(3, ethernet(packet(0)));
  EXPECT_EQ(datagrams(same), 2U) << "nothing says that it is the same packet";
  PcapFile bridge{ethernet_link};
  bridge.frame(0, ethernet(packet(0))).frame(3, through_another(ethernet(packet(0))));
  EXPECT_EQ(datagrams(bridge), 1U);
  PcapFile any{cooked_link};
  any.frame(0, cooked(4, packet(0))).frame(3, cooked(4, packet(0))).frame(9, cooked(0, packet(0)));
  EXPECT_EQ(datagrams(any), 1U) << "cooked: a capture of all interfaces";
}

TEST(RepeatedPackets, ARawLinkHasIdentificationsToo) {
  PcapFile file{raw_link};
  file.frame(0, packet(7)).frame(3, packet(7)).frame(4, packet(8));
  EXPECT_EQ(datagrams(file), 2U);
}

TEST(RepeatedPackets, FragmentsAreSeenOnceEach) {
  const Buffer datagram = udp(route(7), descriptor().buffer());
  const Buffer first = ethernet(ipv4_fragment(route(7), datagram, 0, 64, true));
  const Buffer rest = ethernet(ipv4_fragment(route(7), datagram, 64, datagram.size() - 64, false));
  PcapFile file{ethernet_link};
  file.frame(0, first).frame(1, first).frame(2, rest).frame(3, rest);
  const Conversation conversation = conversation_of({file.buffer()});
  ASSERT_EQ(conversation.datagrams.size(), 1U);
  EXPECT_EQ(conversation.datagrams.front().frames, 2U);
  ASSERT_EQ(conversation.remarks.size(), 1U) << "no fragment is missing";
}

TEST(RepeatedPackets, MemoryIsBounded) {
  // All at one instant: nothing is too old to be remembered.
  RepeatedPackets repeated{static_cast<int>(ethernet_link)};
  const Buffer frame = ethernet(packet(7));
  const auto there = [&](std::uint32_t id) {
    const Buffer ip = packet(id);
    return repeated.was_there(0, ethernet(ip), ip);
  };
  EXPECT_FALSE(there(1));
  EXPECT_TRUE(there(1));
  for (std::uint32_t id = 2; id < 2 + RepeatedPackets::most; ++id) {
    const Buffer ip = packet(id);
    static_cast<void>(repeated.was_there(0, ethernet(ip), ip));
  }
  EXPECT_FALSE(there(1)) << "the first was forgotten";
}

}  // namespace repeated_packets_test
}  // namespace stormproof::capture
