// IGMP of all versions, and packets that are none.
#include "checker/evidence/capture/igmp.hpp"

#include <gtest/gtest.h>

#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture::testing {
namespace {

const Address group = multicast().address;

Igmp of(const std::vector<Buffer>& packets) {
  Igmp igmp;
  for (const Buffer& packet : packets) {
    if (const auto ip = parse_ip(packet)) add_igmp(*ip, igmp);
  }
  return igmp;
}

/// A report of version 3 about one group.
Buffer report_3(std::uint8_t host, std::uint8_t type, std::uint16_t sources,
                std::uint16_t groups = 1) {
  Writer body;
  body.u8(0x22).u8(0).u16(0).u16(0).u16(groups);
  body.u8(type).u8(0).u16(sources).bytes(part(group.bytes, 12));
  for (std::uint16_t k = 0; k < sources; ++k) body.u32(0x0a000001);
  return igmp(host, body.buffer());
}

TEST(Igmp, WhoAsksAndWhoListens) {
  const Igmp found = of({igmp_message(9, 0x11), igmp_message(1, 0x16), igmp_message(2, 0x12)});
  EXPECT_EQ(found.queriers, std::set{at(9, 0).address});
  EXPECT_EQ(found.members.at(group), (std::set{at(1, 0).address, at(2, 0).address}));
}

TEST(Igmp, WhoLeavesListensNoLonger) {
  EXPECT_TRUE(of({igmp_message(1, 0x16), igmp_message(1, 0x17)}).members.at(group).empty());
  constexpr std::uint8_t to_include = 3;
  EXPECT_TRUE(of({report_3(1, 4, 0), report_3(1, to_include, 0)}).members.at(group).empty());
}

TEST(Igmp, ReportsOfVersion3) {
  constexpr std::uint8_t excludes = 2;
  constexpr std::uint8_t allow = 5;
  constexpr std::uint8_t block = 6;
  const std::set only{at(1, 0).address};
  EXPECT_EQ(of({report_3(1, excludes, 0)}).members.at(group), only);
  EXPECT_EQ(of({report_3(1, allow, 2)}).members.at(group), only);
  EXPECT_TRUE(of({report_3(1, block, 1)}).members.empty());
}

TEST(Igmp, WhatIsCutOrNoneSaysNothing) {
  Buffer packet = igmp_message(1, 0x16);
  packet[9] = 17;
  EXPECT_TRUE(of({packet}).members.empty()) << "UDP";
  EXPECT_TRUE(of({report_3(1, 2, 0, 0)}).members.empty()) << "no group";
  EXPECT_EQ(of({report_3(1, 2, 0, 65'535)}).members.size(), 1U) << "more groups than there are";
  const Buffer whole = igmp_message(1, 0x16);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_TRUE(of({Buffer(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))})
                    .members.empty())
        << length;
  }
}

}  // namespace
}  // namespace stormproof::capture::testing
