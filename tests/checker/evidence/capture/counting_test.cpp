// The rules of counting, one by one, on conversations of a few packets.
#include "checker/evidence/capture/counting.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture {

namespace counting_test {

using namespace testing;

constexpr std::int64_t always = std::numeric_limits<std::int64_t>::max();
constexpr EntityId pub = entity::publications_writer;
constexpr EntityId sub = entity::subscriptions_writer;

/// Participant 1 on host 1; 2 and 3 on host 2, with ports 7410 and 7412; all have announced.
PcapFile three_participants() {
  PcapFile file;
  file.message(0, {at(1, 7410), multicast()}, Message{prefix(1)}.announcement({at(1, 7410)}));
  file.message(1, {at(2, 7410), multicast()}, Message{prefix(2)}.announcement({at(2, 7410)}));
  file.message(2, {at(2, 7412), multicast()}, Message{prefix(3)}.announcement({at(2, 7412)}));
  return file;
}
const Route to_2{at(1, 7410), at(2, 7410)};
const Route to_3{at(1, 7410), at(2, 7412)};
const Route to_1{at(2, 7410), at(1, 7410)};

Counting count_of(const PcapFile& file, std::int64_t until = always) {
  return count(conversation_of({file.buffer()}), until);
}

TEST(Counting, SpdpByMulticastAndUnicast) {
  PcapFile file = three_participants();
  file.message(3, to_2, Message{prefix(1)}.announcement({at(1, 7410)}));
  const Counting counting = count_of(file);
  EXPECT_EQ(counting.counts.spdp_multicast, 3U);
  EXPECT_EQ(counting.counts.spdp_unicast, 1U);
  EXPECT_EQ(counting.counts.total(), 4U);
}

TEST(Counting, TheFirstOccurrenceOfAKeyIsInitialTheOthersAreRepairs) {
  PcapFile file = three_participants();
  file.message(3, to_2, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1));
  file.message(4, to_2, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1).descriptor(pub, 2));
  file.message(5, to_2, Message{prefix(1)}.to(prefix(2)).descriptor(sub, 1));
  file.message(6, to_3, Message{prefix(1)}.to(prefix(3)).descriptor(pub, 1));
  const Counting counting = count_of(file);
  EXPECT_EQ(counting.counts.initial_data, 4U);
  EXPECT_EQ(counting.counts.repair_data, 1U);
  EXPECT_EQ(counting.data_per_datagram.at(1), 3U);
  EXPECT_EQ(counting.data_per_datagram.at(2), 1U);
}

TEST(Counting, EachCopyWithoutInfoDstHasTheDestinationOfItsPort) {
  PcapFile file = three_participants();
  file.message(3, to_2, Message{prefix(1)}.descriptor(pub, 1));
  file.message(4, to_3, Message{prefix(1)}.descriptor(pub, 1));
  file.message(5, to_3, Message{prefix(1)}.to(prefix(3)).descriptor(pub, 1));
  const Conversation conversation = conversation_of({file.buffer()});
  const Counting counting = count(conversation, always);
  EXPECT_EQ(counting.counts.initial_data, 2U);
  EXPECT_EQ(counting.counts.repair_data, 1U);
  EXPECT_EQ(conversation.events[3].destination, prefix(2));
  EXPECT_EQ(conversation.events[4].destination, prefix(3));
  EXPECT_FALSE(conversation.events[4].has_info_dst);
  EXPECT_EQ(counting.unknown_destination, 0U);
}

TEST(Counting, APortThatChangesHandsGoesToWhoAnnouncedItLast) {
  PcapFile file = three_participants();
  file.message(3, to_2, Message{prefix(1)}.descriptor(pub, 1));
  file.message(4, {at(2, 7410), multicast()}, Message{prefix(4)}.announcement({at(2, 7410)}));
  file.message(5, to_2, Message{prefix(1)}.descriptor(pub, 1));
  const Conversation conversation = conversation_of({file.buffer()});
  EXPECT_EQ(conversation.events[3].destination, prefix(2));
  EXPECT_EQ(conversation.events[5].destination, prefix(4));
  EXPECT_EQ(count(conversation, always).counts.repair_data, 0U);
}

TEST(Counting, AnAddressThatNobodyAnnouncedIsReported) {
  PcapFile file = three_participants();
  file.message(3, {at(1, 7410), at(9, 7410)}, Message{prefix(1)}.heartbeat(pub, 1, 1, 1));
  EXPECT_EQ(count_of(file).unknown_destination, 1U);
}

TEST(Counting, MulticastDataHasNoDestinationAndIsThereForAll) {
  PcapFile file = three_participants();
  file.message(3, {at(1, 7410), multicast()}, Message{prefix(1)}.descriptor(pub, 1));
  const Counting counting = count_of(file);
  EXPECT_EQ(counting.counts.initial_data, 1U);
  EXPECT_EQ(counting.multicast_data, 1U);
  EXPECT_EQ(counting.required, 2U);
  EXPECT_TRUE(counting.missing.empty());
}

TEST(Counting, WhatStaysOnOneHostIsLeftOut) {
  PcapFile file = three_participants();
  file.message(3, {at(2, 7410), at(2, 7412)}, Message{prefix(2)}.to(prefix(3)).descriptor(pub, 1));
  file.message(4, to_1, Message{prefix(2)}.to(prefix(1)).descriptor(pub, 1));
  const Counting counting = count_of(file);
  EXPECT_EQ(counting.counts.initial_data, 1U);
  EXPECT_EQ(counting.same_host.initial_data, 1U);
  EXPECT_EQ(counting.required, 1U);
}

TEST(Counting, WhereAllAreOnOneHostNothingIsLeftOut) {
  PcapFile file;
  file.message(0, {at(1, 7410), multicast()}, Message{prefix(1)}.announcement({at(1, 7410)}));
  file.message(1, {at(1, 7412), multicast()}, Message{prefix(2)}.announcement({at(1, 7412)}));
  file.message(2, {at(1, 7410), at(1, 7412)}, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1));
  const Counting counting = count_of(file);
  EXPECT_EQ(counting.counts.initial_data, 1U);
  EXPECT_EQ(counting.required, 1U);
}

TEST(Counting, TheCutIsInclusive) {
  PcapFile file = three_participants();
  file.message(3, to_2, Message{prefix(1)}.to(prefix(2)).heartbeat(pub, 1, 1, 1));
  EXPECT_EQ(count_of(file, time_of(3)).counts.heartbeat, 1U);
  EXPECT_EQ(count_of(file, time_of(3) - 1).counts.heartbeat, 0U);
  EXPECT_EQ(count_of(file, time_of(3) - 1).after_cut, 1U);
}

TEST(Counting, OnlyTheReliableSedpEndpointsAreInTheClasses) {
  PcapFile file = three_participants();
  const EntityId user = 0x00000103;
  file.message(3, to_2,
               Message{prefix(1)}
                   .to(prefix(2))
                   .heartbeat(user, 1, 1, 1)
                   .heartbeat(entity::liveliness_writer, 1, 1, 1)
                   .acknack(user, 1, 0, 0, true));
  const Counting counting = count_of(file);
  EXPECT_EQ(counting.counts.heartbeat + counting.counts.acknack, 0U);
  EXPECT_EQ(counting.traffic[static_cast<std::size_t>(Traffic::user)].heartbeat, 1U);
  EXPECT_EQ(counting.traffic[static_cast<std::size_t>(Traffic::user)].acknack, 1U);
  EXPECT_EQ(counting.traffic[static_cast<std::size_t>(Traffic::liveliness)].heartbeat, 1U);
}

TEST(Counting, LookupsAreInAClassOfTheirOwnAndEachCopyCounts) {
  const EntityId requests = entity::lookup_requests_writer;
  const EntityId replies = entity::lookup_replies_writer;
  PcapFile file = three_participants();
  file.message(3, to_2, Message{prefix(1)}.descriptor(requests, 1));
  file.message(4, to_3, Message{prefix(1)}.descriptor(requests, 1));
  file.message(5, to_1, Message{prefix(2)}.descriptor(replies, 1).heartbeat(replies, 1, 1, 1));
  file.message(6, to_2, Message{prefix(1)}.acknack(replies, 2, 0, 0, true).descriptor(pub, 1));
  file.message(7, {at(2, 7410), at(2, 7412)}, Message{prefix(2)}.descriptor(requests, 1));
  const Counting counting = count_of(file);
  EXPECT_EQ(counting.counts.lookup, 3U);
  EXPECT_EQ(counting.lookup_requests.data, 2U);
  EXPECT_EQ(counting.lookup_requests.samples, 1U);
  EXPECT_EQ(counting.lookup_replies.data, 1U);
  EXPECT_EQ(counting.lookup_replies.heartbeat, 1U);
  EXPECT_EQ(counting.lookup_replies.acknack, 1U);
  EXPECT_EQ(counting.lookup_messages(), 5U);
  EXPECT_EQ(counting.lookup_datagrams, 3U);
  EXPECT_EQ(counting.last_lookup_ns, time_of(5));
  EXPECT_EQ(counting.counts.total(), 4U);  // three announcements and a descriptor
  EXPECT_EQ(counting.traffic[static_cast<std::size_t>(Traffic::other_builtin)].data, 0U);
  EXPECT_EQ(count_of(file, time_of(3)).counts.lookup, 1U);
}

TEST(Counting, AcknacksByWhatTheySay) {
  PcapFile file = three_participants();
  file.message(3, to_1, Message{prefix(2)}.to(prefix(1)).acknack(pub, 0, 0, 0, false));
  file.message(4, to_1, Message{prefix(2)}.to(prefix(1)).acknack(pub, 1, 0, 0, true));
  file.message(5, to_1, Message{prefix(2)}.to(prefix(1)).acknack(pub, 1, 3, 0xa0000000, false));
  file.message(6, to_1, Message{prefix(2)}.to(prefix(1)).acknack(pub, 4, 0, 0, true));
  const AcknackFigures figures = count_of(file).acknacks;
  EXPECT_EQ(figures.initial, 2U);
  EXPECT_EQ(figures.preemptive, 1U);
  EXPECT_EQ(figures.negative, 1U);
  EXPECT_EQ(figures.requested, 2U);
  EXPECT_EQ(figures.positive, 1U);
  EXPECT_EQ(figures.final_flag, 2U);
}

TEST(Counting, HeartbeatsByTheirCause) {
  constexpr std::int64_t second = 1'000'000;
  const auto to_reader = [] { return Message{prefix(1)}.to(prefix(2)); };
  PcapFile file = three_participants();
  file.message(3, to_2, to_reader().heartbeat(pub, 1, 0, 1));
  file.message(4, to_1, Message{prefix(2)}.to(prefix(1)).acknack(pub, 0, 0, 0, false));
  file.message(5, to_2, to_reader().heartbeat(pub, 1, 1, 2));
  file.message(6, to_2, to_reader().descriptor(pub, 1).heartbeat(pub, 1, 1, 3));
  file.message(7, to_2, to_reader().heartbeat(pub, 1, 1, 4));
  for (const Route& copy : {to_2, to_3}) {
    file.message(8, copy, Message{prefix(1)}.heartbeat(pub, 1, 1, 5));
    file.message(second, copy, Message{prefix(1)}.heartbeat(pub, 1, 1, 6));
    file.message(second + 9, copy, Message{prefix(1)}.heartbeat(pub, 1, 1, 7));
  }
  const HeartbeatFigures figures = count_of(file).heartbeats;
  EXPECT_EQ(figures.of(HeartbeatKind::relation_open), 1U);
  EXPECT_EQ(figures.of(HeartbeatKind::reply), 1U);
  EXPECT_EQ(figures.of(HeartbeatKind::directed_piggyback), 1U);
  EXPECT_EQ(figures.of(HeartbeatKind::directed), 1U);
  EXPECT_EQ(figures.of(HeartbeatKind::fan_out_piggyback), 4U);
  EXPECT_EQ(figures.of(HeartbeatKind::fan_out_periodic), 2U);
  EXPECT_EQ(figures.behind_data, 1U);
  EXPECT_EQ(figures.empty, 1U);
}

TEST(Counting, TheCauseOfAFanOutIsNotGuessedForOtherVendors) {
  PcapFile file = three_participants();
  const VendorId cyclone = 0x0110;
  const Message message = Message{prefix(1), ByteOrder::little, cyclone}.heartbeat(pub, 1, 1, 1);
  file.message(3, to_2, message);
  EXPECT_EQ(count_of(file).heartbeats.of(HeartbeatKind::fan_out), 1U);
}

TEST(RequiredKeys, ADescriptorThatOneReceiverNeverGotIsMissing) {
  PcapFile file = three_participants();
  file.message(3, to_2, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1));
  const Counting counting = count_of(file);
  EXPECT_EQ(counting.required, 2U);
  ASSERT_EQ(counting.missing.size(), 1U);
  EXPECT_EQ(counting.missing[0], (MissingKey{prefix(1), prefix(3), pub, 1}));
}

TEST(RequiredKeys, ADescriptorThatNobodyGotIsMissedThroughTheHeartbeat) {
  PcapFile file = three_participants();
  file.message(3, to_2, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1));
  file.message(4, to_3, Message{prefix(1)}.to(prefix(3)).descriptor(pub, 1));
  EXPECT_TRUE(count_of(file).missing.empty());
  file.message(5, to_2, Message{prefix(1)}.to(prefix(2)).heartbeat(pub, 1, 2, 1));
  EXPECT_EQ(count_of(file).missing.size(), 2U);
  file.message(6, to_2, Message{prefix(1)}.to(prefix(2)).gap(pub, 2, 3));
  EXPECT_TRUE(count_of(file).missing.empty());
}

TEST(RequiredKeys, AHostileRangeIsCountedWithoutBeingListed) {
  PcapFile file = three_participants();
  file.message(3, to_2, Message{prefix(1)}.to(prefix(2)).heartbeat(pub, 1, INT64_MAX, 1));
  const Counting counting = count_of(file);
  EXPECT_EQ(counting.missing_count, 2U * 65'536U);
  EXPECT_EQ(counting.missing.size(), most_missing_listed);
  file.message(4, to_2, Message{prefix(1)}.to(prefix(2)).heartbeat(pub, INT64_MIN, INT64_MAX, 2));
  file.message(5, to_2, Message{prefix(1)}.to(prefix(2)).gap(pub, INT64_MIN, INT64_MAX));
  EXPECT_EQ(count_of(file).missing_count, 0U);
}

TEST(RequiredKeys, AnEndpointThatIsGoneIsNotRequired) {
  PcapFile file = three_participants();
  file.message(3, to_2, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1));
  file.message(4, to_2, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1, true));
  EXPECT_EQ(count_of(file).required, 2U) << "the same sequence number does not take it back";
  Message gone{prefix(1)};
  const Buffer description = Message{prefix(1)}.descriptor(pub, 1, true).buffer();
  Buffer body{description.begin() + 24, description.end()};
  body[16] = 2;  // its own sequence number
  file.message(5, to_2, gone.to(prefix(2)).submessage(0x15, 0x02, body));
  EXPECT_EQ(count_of(file).required, 0U);
}

}  // namespace counting_test
}  // namespace stormproof::capture
