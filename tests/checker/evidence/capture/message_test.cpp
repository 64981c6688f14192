// RTPS messages: both byte orders, the interpretation of INFO_DST and INFO_SRC, what is skipped,
// and what is refused.
#include <gtest/gtest.h>

#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/message_events.hpp"
#include "checker/evidence/capture/rtps_message.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture {

namespace message_test {

using namespace testing;

constexpr EntityId pub = entity::publications_writer;
const Route route{at(1, 7410), at(2, 7411)};

Conversation conversation_with(const Message& message) {
  PcapFile file;
  file.message(0, route, message);
  return conversation_of({file.buffer()});
}

class Orders : public ::testing::TestWithParam<ByteOrder> {};

TEST_P(Orders, EverySubmessageIsReadAsItWasWritten) {
  Message message{prefix(1), GetParam()};
  message.to(prefix(2)).timestamp().descriptor(pub, 0x100000002).vendor_specific();
  message.heartbeat(pub, 1, 0x300000004, 17, 0x02 | 0x04);
  message.acknack(pub, 5, 33, 0xc0000001, true, 9).gap(pub, 3, 8);
  const Conversation conversation = conversation_with(message);
  ASSERT_EQ(conversation.events.size(), 4U);
  for (const Event& event : conversation.events) {
    EXPECT_EQ(event.source, prefix(1));
    EXPECT_EQ(event.destination, prefix(2));
    EXPECT_EQ(event.writer, pub);
  }
  const DataEvent* data = conversation.events[0].data();
  ASSERT_NE(data, nullptr);
  EXPECT_EQ(data->sequence_number, 0x100000002);
  EXPECT_EQ(data->endpoint, (Guid{prefix(1), 0x203}));
  const HeartbeatEvent* heartbeat = conversation.events[1].heartbeat();
  ASSERT_NE(heartbeat, nullptr);
  EXPECT_EQ(heartbeat->first, 1);
  EXPECT_EQ(heartbeat->last, 0x300000004);
  EXPECT_EQ(heartbeat->count, 17U);
  EXPECT_TRUE(heartbeat->is_final && heartbeat->is_liveliness);
  const AcknackEvent* acknack = conversation.events[2].acknack();
  ASSERT_NE(acknack, nullptr);
  EXPECT_EQ(acknack->missing.base, 5);
  EXPECT_EQ(acknack->missing.num_bits, 33U);
  EXPECT_EQ(acknack->missing.size(), 3U);
  EXPECT_TRUE(acknack->missing.has(0) && acknack->missing.has(1) && acknack->missing.has(31));
  EXPECT_FALSE(acknack->missing.has(2) || acknack->missing.has(32) || acknack->missing.has(300));
  EXPECT_EQ(acknack->count, 9U);
  EXPECT_TRUE(acknack->is_final);
  const GapEvent* gap = conversation.events[3].gap();
  ASSERT_NE(gap, nullptr);
  EXPECT_EQ(gap->start, 3);
  EXPECT_EQ(gap->list.base, 8);
  EXPECT_TRUE(conversation.remarks.empty());
}

TEST_P(Orders, AnAnnouncementNamesItsLocators) {
  UdpEnd v6{Address{}, 7413};
  v6.address.bytes[15] = 1;
  const Conversation conversation =
      conversation_with(Message{prefix(1), GetParam()}.announcement({at(1, 7410), v6}));
  ASSERT_EQ(conversation.topology.participants.size(), 1U);
  EXPECT_EQ(conversation.topology.participants[0].locators, (std::set<UdpEnd>{v6, at(1, 7410)}));
}

INSTANTIATE_TEST_SUITE_P(Message, Orders, ::testing::Values(ByteOrder::little, ByteOrder::big));

TEST(Message, InfoDstHoldsUntilTheNextOne) {
  const Conversation conversation = conversation_with(Message{prefix(1)}
                                                          .heartbeat(pub, 1, 1, 1)
                                                          .to(prefix(2))
                                                          .heartbeat(pub, 1, 1, 2)
                                                          .heartbeat(pub, 1, 1, 3)
                                                          .to(prefix(3))
                                                          .heartbeat(pub, 1, 1, 4)
                                                          .to(GuidPrefix{})
                                                          .heartbeat(pub, 1, 1, 5));
  ASSERT_EQ(conversation.events.size(), 5U);
  EXPECT_EQ(conversation.events[0].destination, std::nullopt);
  EXPECT_EQ(conversation.events[1].destination, prefix(2));
  EXPECT_EQ(conversation.events[2].destination, prefix(2));
  EXPECT_EQ(conversation.events[3].destination, prefix(3));
  EXPECT_FALSE(conversation.events[4].has_info_dst);
}

TEST(Message, InfoSrcChangesTheSource) {
  const Conversation conversation =
      conversation_with(Message{prefix(1)}.from(prefix(7)).heartbeat(pub, 1, 1, 1));
  ASSERT_EQ(conversation.events.size(), 1U);
  EXPECT_EQ(conversation.events[0].source, prefix(7));
}

TEST(Message, LengthZeroReachesToTheEnd) {
  Message message{prefix(1)};
  message.heartbeat(pub, 1, 1, 1);
  Buffer bytes = message.buffer();
  bytes[22] = 0;  // octetsToNextHeader
  SubmessageReader reader{bytes};
  const auto heartbeat = reader.next();
  ASSERT_TRUE(heartbeat.has_value());
  EXPECT_TRUE(decode_heartbeat(*heartbeat).has_value());
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_FALSE(reader.is_cut());
}

TEST(Message, ASubmessageThatReachesBeyondTheEndIsReportedAndThoseBeforeItCount) {
  Message message{prefix(1)};
  message.heartbeat(pub, 1, 1, 1).heartbeat(pub, 1, 1, 2);
  Buffer bytes = message.buffer();
  bytes.pop_back();
  PcapFile file;
  file.frame(0, ethernet(ipv4(route, bytes)));
  const Conversation conversation = conversation_of({file.buffer()});
  EXPECT_EQ(conversation.events.size(), 1U);
  ASSERT_EQ(conversation.remarks.size(), 1U);
  EXPECT_EQ(conversation.remarks[0],
            (Remark{"RTPS messages that end inside a submessage", "0.pcap, packet 1", 1}));
}

TEST(Message, AParticipantWithoutAPayloadLeaves) {
  const auto data = [](std::uint8_t flags) {
    Writer body{ByteOrder::little};
    body.u16(0).u16(16).entity(entity::spdp_reader).entity(entity::spdp_writer).sequence_number(1);
    if (flags != 0) body.u8(0).u8(3).u16(0).u16(0x50).u16(16).bytes(prefix(1).bytes).entity(0x1c1);
    if (flags != 0) body.u16(1).u16(0);
    return body.buffer();
  };
  constexpr std::uint8_t key_only = 0x08;
  const Conversation conversation = conversation_with(
      Message{prefix(1)}.submessage(0x15, 0, data(0)).submessage(0x15, key_only, data(key_only)));
  ASSERT_EQ(conversation.events.size(), 2U);
  EXPECT_TRUE(conversation.events[0].data()->is_gone);
  EXPECT_TRUE(conversation.events[1].data()->is_gone);
  EXPECT_TRUE(conversation.remarks.empty());
}

TEST(Message, HostileLengthsAreRefused) {
  Writer too_many{ByteOrder::little};
  too_many.entity(pub + 5).entity(pub).sequence_number(1).u32(257).bytes(Buffer(64, 255));
  Writer short_bitmap{ByteOrder::little};
  short_bitmap.entity(pub + 5).entity(pub).sequence_number(1).u32(256).u32(0).u32(0);
  Writer far_qos{ByteOrder::little};
  far_qos.u16(0).u16(60'000).entity(pub + 5).entity(pub).sequence_number(1);
  Writer near_qos{ByteOrder::little};
  near_qos.u16(0).u16(4).entity(pub + 5).entity(pub).sequence_number(1);
  const Conversation conversation =
      conversation_with(Message{prefix(1)}
                            .submessage(0x06, 0, too_many.buffer())
                            .submessage(0x06, 0, short_bitmap.buffer())
                            .submessage(0x15, 4, far_qos.buffer())
                            .submessage(0x15, 4, near_qos.buffer())
                            .submessage(0x07, 0, Buffer(27, 0))
                            .submessage(0x0e, 0, Buffer(11, 0))
                            .heartbeat(pub, 1, 1, 1));
  EXPECT_EQ(conversation.events.size(), 1U);
  ASSERT_EQ(conversation.remarks.size(), 1U);
  EXPECT_EQ(conversation.remarks[0].count, 6U);
}

TEST(Message, HostileSetsAndFragmentNumbers) {
  const auto body = [] { return Writer{ByteOrder::little}; };
  const auto set = [&body](std::uint32_t num_bits, std::size_t bytes) {
    Writer out = body().entity(pub + 5).entity(pub).sequence_number(INT64_MAX).u32(num_bits);
    return out.bytes(Buffer(bytes, 255)).buffer();
  };
  const auto fragment = [&body](std::uint32_t number) {
    Writer out = body().u16(0).u16(28).entity(0).entity(pub).sequence_number(1).u32(number);
    return out.u16(65535).u16(65535).u32(0xffffffff).buffer();
  };
  Message message{prefix(1)};
  for (const std::uint32_t num_bits : {257U, 0x7fffffffU, 0x80000000U, 0xffffffffU}) {
    message.submessage(0x06, 0, set(num_bits, 400)).submessage(0x08, 0, set(num_bits, 400));
  }
  message.submessage(0x16, 0, fragment(0));
  Conversation conversation = conversation_with(message);
  EXPECT_TRUE(conversation.events.empty());
  ASSERT_EQ(conversation.remarks.size(), 1U);
  EXPECT_EQ(conversation.remarks[0].count, 9U);
  conversation = conversation_with(Message{prefix(1)}
                                       .submessage(0x06, 0, set(256, 36))
                                       .submessage(0x16, 0, fragment(0xffffffff)));
  ASSERT_EQ(conversation.events.size(), 2U);
  EXPECT_EQ(conversation.events[0].acknack()->missing.size(), 256U);
  EXPECT_EQ(conversation.events[1].data()->fragment, 0xffffffffU);
}

TEST(Message, HostileStringsAreNoNames) {
  for (const std::uint32_t length : {5U, 0x7fffffffU, 0xffffffffU}) {
    Writer body{ByteOrder::little};
    body.u16(0).u16(16).entity(pub + 5).entity(pub).sequence_number(1).u8(0).u8(3).u16(0);
    body.u16(0x5a).u16(16).bytes(prefix(1).bytes).entity(0x103);
    body.u16(5).u16(8).u32(length).text("abcd").u16(1).u16(0);
    const Conversation conversation =
        conversation_with(Message{prefix(1)}.submessage(0x15, 4, body.buffer()));
    ASSERT_EQ(conversation.topology.participants.size(), 1U);
    ASSERT_EQ(conversation.topology.participants[0].endpoints.size(), 1U);
    EXPECT_EQ(conversation.topology.participants[0].endpoints.begin()->second.topic, "");
  }
}

TEST(Message, WhatIsBeyondTheLimitsIsLeftOutWithARemark) {
  const auto extracted = [](const Message& message, ExtractionLimits limits, Remarks& remarks) {
    Extraction extraction;
    extraction.limits = limits;
    Datagram datagram;
    datagram.payload = message.buffer();
    EXPECT_TRUE(extract(datagram, 0, "a, packet 1", extraction, remarks));
    return extraction.events.size();
  };
  Message message{prefix(1)};
  for (std::uint8_t source = 1; source <= 5; ++source) {
    message.from(prefix(source)).heartbeat(pub, 1, 1, source).descriptor(pub, 1);
  }
  Remarks none;
  EXPECT_EQ(extracted(message, {.participants = 5}, none), 10U);
  EXPECT_TRUE(none.list().empty());
  Remarks few_participants;
  EXPECT_EQ(extracted(message, {.participants = 2}, few_participants), 4U);
  ASSERT_EQ(few_participants.list().size(), 1U);
  EXPECT_EQ(few_participants.list()[0].count, 6U);
}

TEST(Message, ACaptureWithMoreThanIsKeptIsUsedUpToThere) {
  PcapFile file;
  constexpr std::uint8_t packets = 100;
  for (std::uint8_t k = 0; k < packets; ++k) {
    Route way{at(1, 7410), multicast()};
    way.id = k + 1U;
    file.message(k * 1000, way, Message{prefix(1)}.heartbeat(pub, 1, 1, k));
  }
  const auto read = [&](std::optional<std::size_t> most) {
    const std::array captures{MemoryCapture{"a", file.buffer(), 1U << 20U, most}};
    auto conversation = read_conversation(captures);
    EXPECT_TRUE(conversation);
    return conversation ? *std::move(conversation) : Conversation{};
  };
  EXPECT_EQ(read({}).events.size(), packets);
  const Conversation some = read(10'000);
  EXPECT_GT(some.events.size(), 10U);
  EXPECT_LT(some.events.size(), 40U);
  EXPECT_EQ(some.last_ns, some.events.back().time_ns) << "it ends there";
  ASSERT_EQ(some.remarks.size(), 1U);
  EXPECT_EQ(some.remarks[0].what, "captures with more than is kept, used up to there");
}

TEST(Message, DataOfUsersIsCountedAndNoEvent) {
  constexpr EntityId topic = 0x00001203;
  const Conversation conversation = conversation_with(
      Message{prefix(1)}.descriptor(topic, 1).descriptor(topic, 2).heartbeat(topic, 1, 2, 1));
  EXPECT_EQ(conversation.events.size(), 1U) << "its HEARTBEAT is";
  ASSERT_EQ(conversation.datagrams.size(), 1U);
  EXPECT_EQ(conversation.datagrams[0].user.data, 2U);
  EXPECT_EQ(conversation.datagrams[0].user.fragments, 0U);
  const Counting counting = count(conversation, INT64_MAX);
  EXPECT_EQ(counting.traffic[static_cast<std::size_t>(Traffic::user)].data, 2U);
  const Conversation alone = conversation_with(Message{prefix(1)}.descriptor(topic, 1));
  EXPECT_TRUE(alone.events.empty());
  ASSERT_EQ(alone.topology.participants.size(), 1U) << "who sends nothing else is there, too";
}

TEST(Message, APayloadThatBreaksOffIsReportedButItsDataCounts) {
  Writer body{ByteOrder::little};
  body.u16(0).u16(16).entity(pub + 5).entity(pub).sequence_number(1);
  body.u8(0).u8(3).u16(0).u16(5).u16(400).text("abcd");
  const Conversation conversation =
      conversation_with(Message{prefix(1)}.submessage(0x15, 4, body.buffer()));
  EXPECT_EQ(conversation.events.size(), 1U);
  ASSERT_EQ(conversation.remarks.size(), 1U);
  EXPECT_NE(conversation.remarks[0].what.find("complete parameter list"), std::string::npos);
}

TEST(Message, FragmentedSamplesAndEncryptionAreNamed) {
  Writer body{ByteOrder::little};
  body.u16(0).u16(28).entity(pub + 5).entity(pub).sequence_number(1).u32(1).u16(1).u16(1024);
  body.u32(2000).bytes(Buffer(64, 0));
  const Conversation conversation = conversation_with(
      Message{prefix(1)}.submessage(0x16, 0, body.buffer()).submessage(0x30, 0, Buffer(8, 0)));
  ASSERT_EQ(conversation.events.size(), 1U);
  EXPECT_EQ(conversation.events[0].data()->fragment, 1U);
  ASSERT_EQ(conversation.remarks.size(), 2U);
}

TEST(Message, OtherDatagramsAreNoMessages) {
  Buffer other = Message{prefix(1)}.heartbeat(pub, 1, 1, 1).buffer();
  EXPECT_TRUE(message_header(other).has_value());
  other[0] = 'r';
  EXPECT_FALSE(message_header(other).has_value());
  other[0] = 'R';
  other[4] = 1;
  EXPECT_FALSE(message_header(other).has_value());
  EXPECT_FALSE(message_header(part(other, 0, 19)).has_value());
}

TEST(Message, ACaptureWithoutAnyIsAnError) {
  PcapFile file;
  file.frame(0, ethernet(ipv4(route, Buffer(30, 1))));
  const std::vector<MemoryCapture> captures{{"dns.pcap", file.buffer(), 1U << 20U}};
  const auto conversation = read_conversation(captures);
  ASSERT_FALSE(conversation);
  EXPECT_EQ(to_string(conversation.error()), "dns.pcap: no RTPS message in it");
}

}  // namespace message_test
}  // namespace stormproof::capture
