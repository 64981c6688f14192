// The rules of a Discovery Server that large runs hardly show: each is met alone, so that another
// reading of it fails here (specs/guide/discovery-server.md, "The database", "The server's
// writers").
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "model/engine/running_world.hpp"
#include "props/generators/dice.hpp"
#include "tests/model/fastdds/server_by_hand.hpp"

namespace stormproof::model::fastdds {
namespace server_rules_test {

using Numbers = ServerByHand::Numbers;
using Sent = ServerByHand::Sent;

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000'000;

/// When which change went to whom.
using Deliveries = std::vector<std::tuple<std::int64_t, std::uint32_t, std::int64_t>>;
Deliveries deliveries(const std::vector<Sent>& data) {
  Deliveries list;
  for (const Sent& one : data) list.emplace_back(one.time_ns, one.client, one.what.number);
  return list;
}
/// When who was told what it need not have.
using Gaps = std::vector<std::tuple<std::int64_t, std::uint32_t, Numbers>>;
Gaps gaps(const std::vector<Sent>& sent) {
  Gaps list;
  for (const Sent& one : sent) list.emplace_back(one.time_ns, one.client, one.what.numbers);
  return list;
}
/// Who got something of a relay.
std::vector<std::uint32_t> receivers(const std::vector<Sent>& sent, std::uint32_t relay) {
  std::vector<std::uint32_t> list;
  for (const Sent& one : sent) {
    if (one.relay == relay) list.push_back(one.client);
  }
  return list;
}

/// Client 0 publishes what the others subscribe to. At once the server sends, of announcements,
/// those of 1 and then of 2 to client 0, and that of 0 to the others in between.
ServerByHand& meet(ServerByHand& server, std::uint32_t clients) {
  for (std::uint32_t i = 0; i < clients; ++i) server.registers(i);
  server.advertises(0, Stream::pub);
  for (std::uint32_t i = 1; i < clients; ++i) server.advertises(i, Stream::sub);
  server.until(0);
  return server;
}

TEST(ServerThread, IsBusyForGapsToo) {
  ServerByHand server{3};
  meet(server, 3).until(ms);
  const std::vector<Sent> sent = server.sent();
  std::vector<Sent> data = sent;
  std::erase_if(data, [](const Sent& one) { return !one.what.has_data; });
  // Number 1 is the server's own. Number 3 goes to two clients, with a GAP to each: 200 us.
  EXPECT_EQ(deliveries(data),
            (Deliveries{{0, 0, 2}, {50 * us, 1, 3}, {50 * us, 2, 3}, {250 * us, 0, 4}}));
}

TEST(ServerThread, IsBusyWithEmptyQueues) {
  ServerByHand server{3};
  meet(server, 3).until(260 * us);  // busy until 350 us: a GAP, and number 4
  (void)server.sent();
  server.registers(3 - 1);  // known: nothing
  server.advertises(0, Stream::pub, 1);
  server.until(ms);  // with what is new, unacknowledged announcements are sent again
  const Deliveries again = deliveries(server.data());
  ASSERT_FALSE(again.empty());
  EXPECT_EQ(std::get<0>(again.front()), 350 * us);
}

TEST(ServerGap, BeginsAfterWhatIsListedBefore) {
  ServerByHand server{3};
  meet(server, 3).until(ms);
  // Number 2 is in the list of client 0, unacknowledged: its GAP before 4 is 3 alone.
  EXPECT_EQ(gaps(server.gaps()), (Gaps{{50 * us, 1, {2}}, {50 * us, 2, {2}}, {250 * us, 0, {3}}}));
}

TEST(ServerGap, BeginsAboveTheLowMarkIfNothingIsListedBefore) {
  ServerByHand server{4};
  meet(server, 3).until(ms);
  server.acknowledges(0, relay::announcements, 5);
  (void)server.sent();
  server.registers(3);
  server.advertises(3, Stream::sub);
  server.until(2 * ms);
  // What 0 has acknowledged is gone; the announcement of 0 is number 5 now, that of 3 number 6.
  const std::vector<Sent> sent = server.gaps();
  Gaps to_0;
  for (const auto& gap : gaps(sent)) {
    if (std::get<1>(gap) == 0) to_0.push_back(gap);
  }
  ASSERT_EQ(to_0.size(), 1U);
  EXPECT_EQ(std::get<2>(to_0[0]), Numbers{5});
}

TEST(ServerGap, ComesTheFirstTimeOnly) {
  ServerByHand server{2};
  meet(server, 2).until(20 * ms);  // its suppression is over: 3 is missing again
  EXPECT_EQ(server.gaps().size(), 1U);
  server.acknowledges(1, relay::announcements, 1, {1, 3});
  server.until(121 * ms);
  const std::vector<Sent> sent = server.sent();
  EXPECT_EQ(deliveries(sent), (Deliveries{{120 * ms, 1, 1}, {120 * ms + 50 * us, 1, 3}}));
}

TEST(ServerAckNack, AGapAnswersWhatItsReaderNeedNotHave) {
  ServerByHand server{2};
  meet(server, 2).until(ms);
  (void)server.sent();
  server.acknowledges(1, relay::announcements, 1, {2});
  const std::vector<Sent> sent = server.sent();
  EXPECT_EQ(gaps(sent), (Gaps{{ms, 1, {2}}}));
  EXPECT_FALSE(sent.at(0).what.has_heartbeat);
}

TEST(ServerAckNack, AGapNamesWhatIsAcknowledgedOnlyBesideSomethingElse) {
  ServerByHand server{2};
  meet(server, 2).until(ms);
  server.acknowledges(1, relay::announcements, 2);
  (void)server.sent();
  server.acknowledges(1, relay::announcements, 1, {1});  // older, but later
  EXPECT_TRUE(server.sent().empty());
  server.acknowledges(1, relay::announcements, 1, {1, 2});
  EXPECT_EQ(gaps(server.sent()), (Gaps{{ms, 1, {1, 2}}}));
}

TEST(ServerAckNack, AGapNamesNothingBeforeTheHistory) {
  ServerByHand server{2, Discovery::super_client};
  meet(server, 2).until(ms);  // the server's own announcement was sent again, as number 2
  (void)server.sent();
  server.acknowledges(0, relay::announcements, 1, {1});
  EXPECT_TRUE(server.sent().empty());
  server.acknowledges(0, relay::announcements, 1, {1, 5});
  EXPECT_EQ(gaps(server.sent()), (Gaps{{ms, 0, {5}}}));
}

/// One publication of 0 went to 1, which has acknowledged it: at 900 ms the history is empty, and
/// an expiry is due at 1,450 ms. Client 0 has acknowledged nothing of it.
ServerByHand& empty_history(ServerByHand& server) {
  meet(server, 2).until(ms);
  server.acknowledges(0, relay::announcements, 4);
  server.acknowledges(1, relay::announcements, 4);
  server.until(455 * ms);
  server.acknowledges(0, relay::subscriptions, 2);
  server.acknowledges(1, relay::publications, 2);
  server.until(1'000 * ms);
  (void)server.sent();
  return server;
}

TEST(ServerExpiry, WithAnEmptyHistoryAsksWhoHasNotAcknowledgedTheLastChange) {
  ServerByHand server{3};
  empty_history(server).until(1'449 * ms);
  EXPECT_EQ(server.sent().size(), 0U);
  server.until(1'460 * ms);
  const std::vector<Sent> sent = server.heartbeats();
  EXPECT_EQ(receivers(sent, relay::publications), std::vector<std::uint32_t>{0});
  for (const Sent& one : sent) {
    EXPECT_EQ(one.what.first, 2);
    EXPECT_EQ(one.what.last, 1);
  }
}

TEST(ServerOpening, TakesWhatIsGoneAsAcknowledged) {
  ServerByHand server{3};
  empty_history(server).registers(2);
  EXPECT_EQ(receivers(server.heartbeats(), relay::publications), std::vector<std::uint32_t>{2});
  server.until(1'460 * ms);
  EXPECT_EQ(receivers(server.heartbeats(), relay::publications), std::vector<std::uint32_t>{0});
}

TEST(ServerRoutine, RunsUntilEverybodyHasAcknowledgedTheServer) {
  ServerByHand server{3};
  empty_history(server);
  EXPECT_EQ(server.scheduled_for(EventKind::server_routine_again),
            (Numbers{450 * ms, 900 * ms}));  // at 900 ms nothing is left
  server.registers(2);
  server.until(1'500 * ms);
  EXPECT_EQ(server.scheduled_for(EventKind::server_routine_again),
            (Numbers{1'450 * ms, 1'900 * ms}));
  server.acknowledges(2, relay::announcements, 2);
  server.until(5'000 * ms);
  EXPECT_TRUE(server.scheduled_for(EventKind::server_routine_again).empty());
}

TEST(ServerRoutine, SendsItsOwnAnnouncementToSuperClientsBeforeAllOthers) {
  ServerByHand server{2, Discovery::super_client};
  meet(server, 2).until(ms);
  std::vector<Sent> sent = server.data();
  ASSERT_EQ(sent.size(), 4U);
  for (const std::size_t first : {0U, 1U}) {
    EXPECT_EQ(sent[first].what.participant, server.server_id());
    EXPECT_EQ(sent[first].what.number, 2);  // it was 1
  }
  EXPECT_EQ(sent[2].what.number, 3);
  EXPECT_EQ(sent[3].what.number, 4);
}

/// That is why no rule says what a relay does with a change that nobody needs.
TEST(Database, ListsOnlyWhatSomebodyNeeds) {
  static const Deployment deployment = Deployment::homogeneous(2, 2, 4);
  static const Topology topology{deployment, DescriptorProfile{}, SameHostPairs::with_server};
  std::size_t listed = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    props::Dice dice{seed};
    const auto relaying = dice.choice<model::Relay>(2);
    const auto discovery = dice.chance(50) ? Discovery::server : Discovery::super_client;
    Database database{topology, discovery, relaying};
    std::set<Item> arrived;
    for (const std::uint32_t i : {0U, 1U, 2U, 3U}) database.join(i);
    for (int k = 0; k < 30; ++k) {
      const std::uint32_t i = dice.count(0, 3);
      const auto s = dice.choice<Stream>(2);
      const std::uint32_t d = dice.count(0, topology.descriptor_count(i, s) - 1);
      const Item item = database.descriptor(i, s, d);
      if (dice.chance(50) && arrived.insert(item).second) database.arrive(item);
      for (const std::uint32_t j : {0U, 1U, 2U, 3U}) {
        const Item told = dice.chance(50) ? database.announcement(i) : item;
        if (dice.chance(30) && database.relevant(told, j)) database.note(told, j);
      }
      if (!dice.chance(30)) continue;
      const Database::Lists lists = database.update();
      for (const auto* list : {&lists.announcements, &lists.publications, &lists.subscriptions}) {
        for (const Item one : *list) {
          ++listed;
          EXPECT_TRUE(database.relevant(one, 0) || database.relevant(one, 1) ||
                      database.relevant(one, 2) || database.relevant(one, 3))
              << "seed " << seed << ", item " << one;
        }
      }
    }
  }
  EXPECT_GT(listed, 1'000U);
}

using Items = std::vector<Item>;

/// What the clients of `meet` have, in a database of three of them.
Database met(model::Relay relaying) {
  static const Deployment deployment = Deployment::homogeneous(1, 3, 0);
  static const Topology topology{deployment, DescriptorProfile{}, SameHostPairs::with_server};
  Database database{topology, Discovery::server, relaying};
  for (const std::uint32_t i : {0U, 1U, 2U}) database.join(i);
  database.arrive(database.descriptor(0, Stream::pub, 0));
  database.arrive(database.descriptor(1, Stream::sub, 0));
  database.arrive(database.descriptor(2, Stream::sub, 0));
  EXPECT_EQ(database.update().announcements, (Items{1, 0, 2}));
  return database;
}

TEST(ServerDatabase, RelaysOnceForEachClientThatItWasListedFor) {
  Database database = met(model::Relay::once);
  // It was listed for 1 when 2 was looked at: only the former waits.
  database.arrive(database.descriptor(0, Stream::pub, 1));
  EXPECT_EQ(database.update().announcements, Items{0});
  database.arrive(database.descriptor(0, Stream::pub, 2));
  EXPECT_EQ(database.update().announcements, Items{});
}

TEST(ServerDatabase, RepeatsAnnouncementsWheneverSomethingIsNew) {
  Database database = met(model::Relay::repeat);
  EXPECT_EQ(database.update().announcements, Items{});
  database.arrive(database.descriptor(0, Stream::pub, 1));
  EXPECT_EQ(database.update().announcements, (Items{1, 0, 2}));
}

TEST(ServerDatabase, NewClientsHaveToAcknowledgeTheServer) {
  Database database = met(model::Relay::repeat);
  database.all_noted = true;
  database.arrive(database.descriptor(0, Stream::pub, 1));
  (void)database.update();
  EXPECT_TRUE(database.all_noted);
  database.join(0);
  (void)database.update();
  EXPECT_FALSE(database.all_noted);
}

}  // namespace server_rules_test
}  // namespace stormproof::model::fastdds
