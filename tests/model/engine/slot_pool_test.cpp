// The slot pool: no slot is given out twice, addresses stay, and freed slots are used again before
// memory grows.
#include "model/engine/slot_pool.hpp"

#include <set>

#include <gtest/gtest.h>

namespace stormproof::model {
namespace slot_pool_test {

TEST(SlotPool, GivesOutDifferentSlotsWithStableAddresses) {
  SlotPool<int> pool;
  std::set<std::uint32_t> slots;
  std::vector<int*> addresses;
  for (int k = 0; k < 1'000; ++k) {
    const std::uint32_t slot = pool.take();
    EXPECT_TRUE(slots.insert(slot).second);
    pool[slot] = static_cast<int>(slot);
    addresses.push_back(&pool[slot]);
  }
  std::size_t k = 0;
  for (const int* address : addresses) {
    EXPECT_EQ(address, &pool[static_cast<std::uint32_t>(*address)]) << k++;
  }
}

TEST(SlotPool, NumbersStayBelowTheMostThatWereInUseAtOnce) {
  SlotPool<int> pool;
  for (int round = 0; round < 1'000; ++round) {
    const std::uint32_t a = pool.take();
    const std::uint32_t b = pool.take();
    EXPECT_NE(a, b);
    EXPECT_LT(std::max(a, b), 256U);
    pool.give_back(round % 2 == 0 ? a : b);
    pool.give_back(round % 2 == 0 ? b : a);
  }
}

TEST(SlotPool, AFreedSlotKeepsItsContentUntilItIsTaken) {
  SlotPool<int> pool;
  const std::uint32_t slot = pool.take();
  pool[slot] = 42;
  pool.give_back(slot);
  EXPECT_EQ(pool.take(), slot);
  EXPECT_EQ(pool[slot], 42);
}

}  // namespace slot_pool_test
}  // namespace stormproof::model
