// How a client and its Discovery Server meet, by GUID and by locator: in which order sides open,
// and what no vector tells apart.
#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "tests/model/fastdds/one_writer.hpp"
#include "tests/model/run_log.hpp"

namespace stormproof::model::fastdds {
namespace server_known_test {

using Names = std::vector<std::string>;

/// Client 1 is on another host than the server, which is 2; client 0 shares the server's host.
Scenario two_clients(ServerKnown known) {
  Scenario scenario = one_writer();
  scenario.deployment.participants[1].endpoints_done = scenario.deployment.participants[1].start;
  scenario.run_until = RunUntil::time_limit;
  scenario.time_limit = Nanoseconds{300 * ms};
  scenario.dds.discovery = Discovery::server;
  scenario.dds.server.known = known;
  scenario.dds.server.relay = Relay::once;
  scenario.dds.version.type_lookup = Whether::yes;
  return scenario;
}

/// The first time that each of these begins, in words, in the order in which they do.
Names order_of(const RunLog& log, const std::vector<std::pair<const char*, const char*>>& begins) {
  Names found;
  for (const std::string& move : log.transitions) {
    for (const auto& [prefix, words] : begins) {
      const bool is_new = std::ranges::find(found, words) == found.end();
      if (move.starts_with(prefix) && is_new) found.emplace_back(words);
    }
  }
  return found;
}

/// At the server, with client 1.
Names opened_at_server(ServerKnown known) {
  return order_of(run_and_log(two_clients(known)),
                  {{"ChangeForReader 5: Absent + ReaderMatched", "announcements"},
                   {"ControlReader 12: Closed", "liveliness reader"},
                   {"ControlWriter 17: Closed", "liveliness writer"},
                   {"ControlReader 13: Closed", "question reader"},
                   {"ControlReader 14: Closed", "answer reader"},
                   {"ControlWriter 18: Closed", "question writer"},
                   {"ControlWriter 19: Closed", "answer writer"},
                   {"DiscoveryReader 6: Unknown", "publications"},
                   {"DiscoveryReader 7: Unknown", "subscriptions"}});
}

TEST(ServerKnown, WhatIsBuiltInOpensBeforeTheReadersByLocatorAndAfterThemByGuid) {
  const Names built_in{"liveliness reader", "liveliness writer", "question reader",
                       "answer reader",     "question writer",   "answer writer"};
  Names by_guid{"announcements", "publications", "subscriptions"};
  by_guid.insert(by_guid.end(), built_in.begin(), built_in.end());
  EXPECT_EQ(opened_at_server(ServerKnown::guid), by_guid);
  Names by_locator{"announcements"};
  by_locator.insert(by_locator.end(), built_in.begin(), built_in.end());
  by_locator.insert(by_locator.end(), {"publications", "subscriptions"});
  EXPECT_EQ(opened_at_server(ServerKnown::locator), by_locator);
}

/// What the server sends to client 1 at the instant of its first DATA(p).
std::vector<PacketKind> sent_at_once(ServerKnown known) {
  const RunLog log = run_and_log(two_clients(known));
  std::vector<PacketKind> kinds;
  std::int64_t first_ns = -1;
  for (const Sent& one : log.sent) {
    if (one.source != 2 || one.destination != 1) continue;
    if (first_ns < 0) first_ns = one.time_ns;
    if (one.time_ns == first_ns) kinds.push_back(one.kind);
  }
  return kinds;
}

TEST(ServerKnown, TheServersOwnAnnouncementComesLast) {
  using enum PacketKind;
  EXPECT_EQ(sent_at_once(ServerKnown::guid), (std::vector{relayed, relayed, relayed, user_heartbeat,
                                                          user_heartbeat, user_heartbeat}));
  EXPECT_EQ(sent_at_once(ServerKnown::locator),
            (std::vector{relayed, user_heartbeat, user_heartbeat, user_heartbeat, relayed, relayed,
                         relayed}));
}

/// Its reader and its HEARTBEAT(p) come before what it learns.
TEST(ServerKnown, AClientThatMeetsTheServerGreetsItFirst) {
  const RunLog log = run_and_log(two_clients(ServerKnown::locator));
  EXPECT_EQ(order_of(log, {{"InitialAckNack 5: Dormant", "reader of announcements"},
                           {"SingleShot 3: Idle", "HEARTBEAT(p) repeats"},
                           {"ControlReader 17: Closed", "liveliness reader"},
                           {"ControlWriter 12: Closed", "liveliness writer"},
                           {"ControlReader 18: Closed", "question reader"},
                           {"ControlReader 19: Closed", "answer reader"},
                           {"ControlWriter 13: Closed", "question writer"},
                           {"ControlWriter 14: Closed", "answer writer"}}),
            (Names{"reader of announcements", "HEARTBEAT(p) repeats", "liveliness reader",
                   "liveliness writer", "question reader", "answer reader", "question writer",
                   "answer writer"}));
  const auto greetings = log.times_of(PacketKind::registration_heartbeat, 1, 2);
  ASSERT_FALSE(greetings.empty());
  EXPECT_EQ(greetings.front(), 102 * ms);
}

/// It says nothing until announcement 1.
TEST(ServerKnown, AnnouncementZeroIsSilentByLocator) {
  const auto first = [](ServerKnown known) {
    return run_and_log(two_clients(known)).times_of(PacketKind::registration, 1, 2).front();
  };
  EXPECT_EQ(first(ServerKnown::guid), 0);
  EXPECT_EQ(first(ServerKnown::locator), 100 * ms);
}

/// Without the server's own announcement, which is lost, a client that knows its locator answers no
/// ACKNACK(p) and reads no HEARTBEAT.
TEST(ServerKnown, AClientAnswersNobodyWhomItDoesNotKnow) {
  Scenario scenario = two_clients(ServerKnown::locator);
  scenario.wireless.lost_packets = {7};
  const RunLog log = run_and_log(scenario);
  EXPECT_FALSE(log.of(PacketKind::registration_acknack, 2, 1).empty());
  EXPECT_TRUE(log.of(PacketKind::registration_heartbeat, 1, 2).empty());
  EXPECT_TRUE(log.of(PacketKind::relayed_acknack, 1, 2).empty());
  scenario.wireless.lost_packets.clear();
  EXPECT_FALSE(run_and_log(scenario).of(PacketKind::relayed_acknack, 1, 2).empty());
}

/// The server's own DATA(p) without a HEARTBEAT, and with what the statistics module adds.
TEST(ServerKnown, TheAnswerHasTheSizeOfItsVersion) {
  const auto sizes = [](SizesSince since, std::int64_t statistics) {
    Scenario scenario = two_clients(ServerKnown::locator);
    scenario.dds.version.sizes = since;
    scenario.dds.version.statistics_bytes = Bytes{statistics};
    const RunLog log = run_and_log(scenario);
    std::int64_t answer = 0;
    for (const Sent& one : log.of(PacketKind::relayed, 2, 1)) {
      if (one.time_ns == 101 * ms) answer = one.payload_bytes;  // the last one is
    }
    return std::pair{log.of(PacketKind::registration, 1, 2).front().payload_bytes, answer};
  };
  EXPECT_EQ(sizes(SizesSince::v2_6, 0), (std::pair<std::int64_t, std::int64_t>{324, 396}));
  EXPECT_EQ(sizes(SizesSince::v3_2, 60), (std::pair<std::int64_t, std::int64_t>{628, 716}));
  EXPECT_EQ(sizes(SizesSince::v3_6, 60), (std::pair<std::int64_t, std::int64_t>{632, 712}));
}

}  // namespace server_known_test
}  // namespace stormproof::model::fastdds
