// Which messages share a packet: by port, by where they go, and by size.
#include "model/cyclone/packer.hpp"

#include <gtest/gtest.h>

namespace stormproof::model::cyclone {
namespace packer_test {

Message message(Destination to, std::int64_t bytes = 32) {
  Message m;
  m.to = std::move(to);
  m.bytes = bytes;
  return m;
}
Destination set_of(std::uint32_t writer, std::uint64_t version, std::vector<std::uint32_t> who) {
  return {.is_set = true, .addresses = std::move(who), .writer = writer, .version = version};
}
Destination announcement_to(std::vector<std::uint32_t> who) {
  return {.is_set = true, .addresses = std::move(who), .writer = UINT32_MAX, .version = 0};
}
Message repair(Destination to, std::int64_t bytes) {
  Message m = message(std::move(to), bytes);
  m.retransmission = true;
  return m;
}

bool fit(Message first, Message second, const SedpProfile& sedp = {}) {
  Packer packer{sedp};
  packer.add(std::move(first));
  packer.add(std::move(second));
  return !packer.is_complete();
}

TEST(Packer, ByNameTheSameParticipant) {
  EXPECT_TRUE(fit(message(Destination::only(1)), message(Destination::only(1))));
  EXPECT_FALSE(fit(message(Destination::only(1)), message(Destination::only(2))));
  EXPECT_FALSE(fit(message(Destination::only(1)), message(set_of(7, 1, {1}))));
}

TEST(Packer, SetsOfOneWriterAsLongAsNobodyMatches) {
  EXPECT_TRUE(fit(message(set_of(7, 3, {1, 2})), message(set_of(7, 3, {1, 2}))));
  EXPECT_FALSE(fit(message(set_of(7, 3, {1, 2})), message(set_of(7, 4, {1, 2}))));
  EXPECT_FALSE(fit(message(set_of(7, 3, {1, 2})), message(set_of(8, 3, {1, 2}))));
}

TEST(Packer, SetsOfOneAddressWhoseverTheyAre) {
  EXPECT_TRUE(fit(message(set_of(7, 3, {1})), message(set_of(8, 9, {1}))));
  EXPECT_TRUE(fit(message(set_of(7, 3, {1})), message(set_of(7, 4, {1}))));
  EXPECT_FALSE(fit(message(set_of(7, 3, {1})), message(set_of(8, 9, {2}))));
  EXPECT_TRUE(fit(message(set_of(7, 3, {group})), message(set_of(8, 9, {group}))));
}

TEST(Packer, AnnouncementsOnlyToTheGroupAlone) {
  EXPECT_TRUE(fit(message(announcement_to({group})), message(announcement_to({group}))));
  EXPECT_FALSE(fit(message(announcement_to({group, 1})), message(announcement_to({group, 1}))));
  EXPECT_TRUE(fit(message(announcement_to({group})), message(set_of(7, 1, {group}))));
}

TEST(Packer, UserTopicsHaveTheirOwnPort) {
  Message of_user = message(Destination::only(1));
  of_user.of_user = true;
  EXPECT_FALSE(fit(message(Destination::only(1)), std::move(of_user)));
}

TEST(Packer, APacketIsFilledToItsLimitExactly) {
  SedpProfile sedp;
  sedp.max_message_size = Bytes{1'000};
  sedp.max_rexmit_message_size = Bytes{500};
  const Destination to = Destination::only(1);  // 36 bytes of headers
  EXPECT_TRUE(fit(message(to, 900), message(to, 64), sedp));
  EXPECT_FALSE(fit(message(to, 900), message(to, 65), sedp));
  EXPECT_TRUE(fit(repair(to, 400), message(to, 64), sedp));
  EXPECT_FALSE(fit(repair(to, 400), message(to, 65), sedp));
  EXPECT_FALSE(fit(message(to, 400), repair(to, 65), sedp));
  const Destination set = set_of(7, 1, {1, 2});  // 20 bytes
  EXPECT_TRUE(fit(message(set, 900), message(set, 80), sedp));
  EXPECT_FALSE(fit(message(set, 900), message(set, 81), sedp));
}

TEST(Packer, WhatDoesNotFitOpensTheNextPacket) {
  const SedpProfile sedp;
  Packer packer{sedp};
  packer.add(message(Destination::only(1), 50));
  packer.add(message(Destination::only(2), 60));
  ASSERT_TRUE(packer.is_complete());
  EXPECT_EQ(packer.take_open().bytes, 20 + 16 + 50);
  EXPECT_FALSE(packer.has_open());
  packer.open_held();
  ASSERT_TRUE(packer.has_open());
  const Bundle second = packer.take_open();
  EXPECT_EQ(second.bytes, 20 + 16 + 60);
  EXPECT_TRUE(second.to.is_only(2));
}

}  // namespace packer_test
}  // namespace stormproof::model::cyclone
