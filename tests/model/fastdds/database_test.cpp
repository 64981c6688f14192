// The database of a Discovery Server: what it lists for its relays.
#include "model/fastdds/database.hpp"

#include <set>

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

}  // namespace database_test
}  // namespace stormproof::model::fastdds
