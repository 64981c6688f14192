// The ring buffer against std::deque, over growth and wrap-around.
#include "model/engine/ring_buffer.hpp"

#include <deque>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace stormproof::model {
namespace ring_buffer_test {

RC_GTEST_PROP(RingBuffer, IsAFirstInFirstOutQueue, ()) {
  RingBuffer<int> ring;
  std::deque<int> reference;
  // Positive: push so many; negative: pop so many.
  const auto bursts = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-20, 30));
  int next = 0;
  for (const int burst : bursts) {
    for (int k = 0; k < burst; ++k) {
      ring.push_back(next);
      reference.push_back(next++);
    }
    for (int k = 0; k < -burst && !reference.empty(); ++k) {
      RC_ASSERT(ring.front() == reference.front());
      ring.pop_front();
      reference.pop_front();
    }
    RC_ASSERT(ring.size() == reference.size());
    RC_ASSERT(ring.empty() == reference.empty());
    if (reference.empty()) continue;
    RC_ASSERT(ring.front() == reference.front());
    RC_ASSERT(ring.back() == reference.back());
  }
}

TEST(RingBuffer, KeepsItsOrderWhenItGrowsWhileWrapped) {
  RingBuffer<int> ring;
  for (int k = 0; k < 16; ++k) ring.push_back(k);
  for (int k = 0; k < 10; ++k) ring.pop_front();
  for (int k = 16; k < 40; ++k) ring.push_back(k);  // wraps, then grows
  for (int k = 10; k < 40; ++k) {
    ASSERT_EQ(ring.front(), k);
    ring.pop_front();
  }
  EXPECT_TRUE(ring.empty());
}

}  // namespace ring_buffer_test
}  // namespace stormproof::model
