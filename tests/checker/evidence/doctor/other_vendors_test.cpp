// Captures of libraries that there is no model of: counted as far as RTPS goes, and named.
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/evidence/capture/summary.hpp"
#include "checker/evidence/doctor/doctor.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::doctor {
namespace other_vendors_test {

using namespace capture::testing;
using capture::Conversation;
namespace entity = capture::entity;

constexpr std::uint16_t connext = 0x0101;
constexpr std::uint16_t opendds = 0x0103;

/// Two participants that announce themselves; the first one sends two descriptors and a HEARTBEAT.
PcapFile discovery_of(std::uint16_t vendor) {
  const auto little = capture::ByteOrder::little;
  const auto by = [&](std::uint8_t who) { return Message{prefix(who), little, vendor}; };
  const capture::EntityId pub = entity::publications_writer;
  PcapFile file;
  file.message(0, {at(1, 7410), multicast()}, by(1).announcement({at(1, 7410)}));
  file.message(9, {at(2, 7410), multicast()}, by(2).announcement({at(2, 7410)}));
  const Route route{at(1, 7410), at(2, 7410)};
  file.message(20, route, by(1).to(prefix(2)).descriptor(pub, 1).descriptor(pub, 2));
  file.message(99, route, by(1).to(prefix(2)).heartbeat(pub, 1, 2, 1));
  return file;
}

Report diagnosed(const Conversation& conversation) {
  Request request;
  request.budget = 50;
  auto report = diagnose(conversation, request);
  EXPECT_TRUE(report) << to_string(report.error());
  return *std::move(report);
}

TEST(OtherVendors, AreNamedAndCountedAndGetNoAdvice) {
  for (const auto& [vendor, name] :
       {std::pair{connext, "RTI Connext"}, std::pair{opendds, "OpenDDS"}}) {
    const Conversation conversation = conversation_of({discovery_of(vendor).buffer()});
    const auto counting = capture::count(conversation, std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(counting.counts.initial_data, 2U) << name;
    EXPECT_EQ(counting.counts.heartbeat, 1U) << name;
    EXPECT_EQ(counting.counts.spdp_multicast, 2U) << name;
    const auto json = capture::to_json({conversation, counting});
    EXPECT_EQ(json.at("topology").at("participants")[0].at("vendor"), name);
    const Report report = diagnosed(conversation);
    ASSERT_EQ(report.products.size(), 1U) << name;
    EXPECT_EQ(report.products[0].vendor, name);
    EXPECT_TRUE(report.presets.empty()) << name;
    EXPECT_TRUE(report.advice.empty()) << name;
  }
}

/// 20 bytes of a TCP header from `source` to `destination`.
Buffer tcp(std::uint16_t source, std::uint16_t destination) {
  Writer header;
  header.u16(source).u16(destination);
  for (int k = 0; k < 4; ++k) header.u32(0);
  return header.buffer();
}

TEST(OtherVendors, ZenohIsNamedAndIsNoRtps) {
  Buffer packet = ipv4({at(1, 50'000), at(2, 7447)}, Buffer{});
  packet[9] = 6;  // TCP, with the ports where UDP has them
  Buffer zenoh = packet;
  const Buffer header = tcp(50'000, 7447);
  zenoh.resize(20);
  zenoh.insert(zenoh.end(), header.begin(), header.end());
  zenoh[3] = static_cast<std::uint8_t>(zenoh.size());
  PcapFile alone;
  alone.frame(0, ethernet(zenoh));
  const Buffer content = alone.buffer();
  const auto read = capture::read_conversation(
      std::vector<capture::MemoryCapture>{{"zenoh.pcap", content, 1'048'576}});
  ASSERT_FALSE(read);
  EXPECT_NE(to_string(read.error()).find("Zenoh"), std::string::npos) << to_string(read.error());

  PcapFile both = discovery_of(connext);
  both.frame(200, ethernet(zenoh));
  const Conversation conversation = conversation_of({both.buffer()});
  ASSERT_EQ(conversation.remarks.size(), 1U);
  EXPECT_NE(conversation.remarks[0].what.find("Zenoh"), std::string::npos);
  EXPECT_EQ(conversation.datagrams.size(), 4U);
}

TEST(OtherVendors, AParticipantOnAPortOfZenohIsNoZenoh) {
  PcapFile file;
  file.message(0, {at(1, 7446), at(2, 7446)}, Message{prefix(1)}.announcement({at(1, 7446)}));
  EXPECT_TRUE(conversation_of({file.buffer()}).remarks.empty());
}

}  // namespace other_vendors_test
}  // namespace stormproof::doctor
