// The database of a Discovery Server: what it lists for its relays.
#include "model/fastdds/database.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "props/generators/dice.hpp"

namespace stormproof::model::fastdds {
namespace database_test {

/// That is why no rule says what a relay does with a change that nobody needs.
TEST(Database, ListsOnlyWhatSomebodyNeeds) {
  static const Deployment deployment = Deployment::homogeneous(2, 2, 4);
  static const Topology topology{deployment, DescriptorProfile{}, SameHostPairs::with_server};
  std::size_t listed = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    props::Dice dice{seed};
    const auto relaying = dice.choice<model::Relay>(2);
    const auto discovery = dice.chance(50) ? Discovery::server : Discovery::super_client;
    Database database{topology, topology.first_server(), discovery, {.relay = relaying}};
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

/// Two participants that know each other's announcements.
Database two_that_know_each_other(const Topology& topology, Rejoin rejoin) {
  Database database{topology, topology.first_server(), Discovery::super_client, {.rejoin = rejoin}};
  for (const std::uint32_t i : {0U, 1U}) database.join(i);
  for (const std::uint32_t i : {0U, 1U}) database.arrive(database.descriptor(i, Stream::pub, 0));
  (void)database.update();
  database.note(database.announcement(0), 1);
  (void)database.update();
  return database;
}

/// Who was told of somebody is told that it is gone, though it has acknowledged that it was there;
/// the descriptors leave, and nobody has to tell anything to who is gone.
TEST(Database, TellsThatSomebodyIsGone) {
  static const Deployment deployment = Deployment::homogeneous(2, 1, 4);
  static const Topology topology{deployment, DescriptorProfile{}, SameHostPairs::with_server};
  Database database = two_that_know_each_other(topology, Rejoin::dropped);
  const Item announcement = database.announcement(0);
  EXPECT_FALSE(database.relevant(announcement, 1));
  database.leave(0);
  const Database::Lists lists = database.update();
  EXPECT_EQ(lists.goodbyes, std::vector{announcement});
  EXPECT_TRUE(std::ranges::count(lists.leaving, database.descriptor(0, Stream::pub, 0)) == 1);
  EXPECT_TRUE(database.relevant(announcement, 1));
  EXPECT_TRUE(database.is_gone(0));
  EXPECT_FALSE(database.relevant(database.announcement(1), 0));
  database.forget(announcement);
  EXPECT_FALSE(database.is_gone(0));
  EXPECT_FALSE(database.relevant(announcement, 1));
}

/// While that is told it is dropped, or the goodbye is withdrawn (Fast DDS #5780); afterwards it is
/// anybody new.
TEST(Database, TakesInWhoReturns) {
  static const Deployment deployment = Deployment::homogeneous(2, 1, 4);
  static const Topology topology{deployment, DescriptorProfile{}, SameHostPairs::with_server};
  for (const Rejoin rejoin : {Rejoin::dropped, Rejoin::known}) {
    Database database = two_that_know_each_other(topology, rejoin);
    database.leave(0);
    (void)database.update();
    database.join(0);
    const Database::Lists lists = database.update();
    EXPECT_EQ(database.is_in(0), rejoin == Rejoin::known);
    EXPECT_EQ(std::ranges::count(lists.leaving, database.announcement(0)),
              rejoin == Rejoin::known ? 1 : 0);
    if (rejoin == Rejoin::known) continue;
    database.forget(database.announcement(0));
    database.join(0);
    (void)database.update();
    EXPECT_TRUE(database.is_in(0));
  }
}

}  // namespace database_test
}  // namespace stormproof::model::fastdds
