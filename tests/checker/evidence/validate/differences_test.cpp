// Each difference is found where it is, and not where it is not.
#include "checker/evidence/validate/differences.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/checker/evidence/validate/invented.hpp"

namespace stormproof::validate::testing {
namespace differences_test {

/// Two default nodes that describe themselves to each other, pushed at equal intervals of 1 ms.
Invented plain() {
  Invented invented;
  invented.participant(0).participant(1).announces(0, 0).announces(1, 0);
  for (const std::size_t who : {0U, 1U}) {
    invented.describes_all(who, pubs, 9, 1 - who, 17 * ms);
    invented.describes_all(who, subs, 8, 1 - who, 17 * ms);
  }
  return invented;
}

std::vector<Difference> found(Invented& invented, bool fastdds = true, const Sizes& sizes = {}) {
  const auto observation = observe(invented.conversation(), invented.conversation().last_ns);
  EXPECT_TRUE(observation);
  model::Scenario scenario;
  if (fastdds) scenario.dds.implementation = model::ImplementationKind::fastdds;
  return differences(invented.conversation(), *observation, scenario, sizes);
}

std::uint64_t count_of(const std::string& id, const std::vector<Difference>& list) {
  const auto one = std::ranges::find(list, id, &Difference::id);
  return one == list.end() ? 0 : one->count;
}

/// How often `id` is found in the plain conversation with one event more.
std::uint64_t with(const std::string& id, const capture::Event& event,
                   std::uint32_t payload_bytes = 100) {
  Invented invented = plain();
  EXPECT_EQ(count_of(id, found(invented)), 0U) << id;
  invented.adds(event, payload_bytes);
  return count_of(id, found(invented));
}

capture::Event event(capture::EntityId writer, std::optional<std::size_t> to = 1) {
  return plain().event(0, to, writer, 20 * ms);
}

TEST(Differences, Submessages) {
  capture::Event gap = event(pubs);
  gap.content = capture::GapEvent{};
  EXPECT_EQ(with("gap", gap), 1U);
  capture::Event fragment = event(pubs);
  fragment.content = capture::DataEvent{.sequence_number = 3, .fragment = 1};
  EXPECT_EQ(with("data-frag", fragment), 1U);
  capture::Event user = event(0x00000103);
  user.content = capture::DataEvent{.sequence_number = 1};
  EXPECT_EQ(with("user-data", user), 1U);
  capture::Event alive = event(capture::entity::liveliness_writer);
  alive.content = capture::DataEvent{.sequence_number = 1};
  EXPECT_EQ(with("liveliness-data", alive), 1U);
}

TEST(Differences, VendorSubmessages) {
  capture::Event heartbeat = event(pubs);
  heartbeat.content = capture::HeartbeatEvent{.first = 1, .last = 9, .count = 1};
  constexpr std::uint32_t header_destination_heartbeat = 20 + 16 + 32;
  EXPECT_EQ(with("other-submessages", heartbeat, header_destination_heartbeat), 0U);
  EXPECT_EQ(with("other-submessages", heartbeat, header_destination_heartbeat + 60), 1U);
}

TEST(Differences, Destinations) {
  capture::Event multicast = event(pubs, std::nullopt);
  multicast.content = capture::DataEvent{.sequence_number = 3};
  EXPECT_EQ(with("multicast-sedp", multicast), 1U);
  capture::Event lost = event(pubs);
  lost.destination.reset();
  lost.content = capture::DataEvent{.sequence_number = 3};
  EXPECT_EQ(with("unknown-destination", lost), 1U);
  capture::Event same_host = event(pubs);
  same_host.is_same_host = true;
  same_host.content = capture::DataEvent{.sequence_number = 3};
  EXPECT_EQ(with("same-host", same_host), 1U);
}

TEST(Differences, Participants) {
  Invented invented = plain();
  EXPECT_EQ(count_of("other-vendor", found(invented)), 0U);
  auto& participants = invented.conversation().topology.participants;
  participants[1].vendor = 0x0110;
  participants[0].locators = {capture::UdpEnd{}, capture::UdpEnd{{}, 7}};
  EXPECT_EQ(count_of("other-vendor", found(invented)), 1U);
  EXPECT_EQ(count_of("other-vendor", found(invented, false)), 0U) << "the paper's has no vendor";
  EXPECT_EQ(count_of("locators", found(invented)), 1U);
}

TEST(Differences, Endpoints) {
  Invented invented = plain();
  EXPECT_EQ(count_of("fewer-endpoints", found(invented)), 0U);
  EXPECT_EQ(count_of("disposed", found(invented)), 0U);
  invented.conversation().topology.participants[0].endpoints.begin()->second.is_gone = true;
  EXPECT_EQ(count_of("disposed", found(invented)), 1U);
  EXPECT_EQ(count_of("fewer-endpoints", found(invented)), 1U);
}

TEST(Differences, Creation) {
  Invented invented = plain();  // all endpoints at 17 ms
  EXPECT_EQ(count_of("uneven-creation", found(invented)), 2U);
  EXPECT_EQ(count_of("created-later", found(invented)), 0U);
  EXPECT_EQ(count_of("created-later", found(invented, false)), 2U);
}

TEST(Differences, Sizes) {
  Invented invented = plain();  // every datagram has 100 bytes
  Sizes same;
  Sizes other;
  for (auto& sizes : same) sizes[100] = 1;
  for (auto& sizes : other) sizes[99] = 1;
  EXPECT_EQ(count_of("size", found(invented, true, same)), 0U);
  EXPECT_EQ(count_of("size", found(invented, true, other)), 34U) << "initial DATA comes first";
}

TEST(Differences, WhatCannotBeRead) {
  Invented invented = plain();
  invented.conversation().remarks.push_back({"IP fragments are missing", "a.pcap, packet 7", 3});
  EXPECT_EQ(count_of("unreadable", found(invented)), 3U);
}

}  // namespace differences_test
}  // namespace stormproof::validate::testing
