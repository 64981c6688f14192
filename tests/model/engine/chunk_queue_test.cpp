// The queue in chunks against std::deque, over chunks that come and go.
#include "model/engine/chunk_queue.hpp"

#include <deque>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace stormproof::model {
namespace chunk_queue_test {

RC_GTEST_PROP(ChunkQueue, IsAFirstInFirstOutQueue, ()) {
  ChunkQueue<int> queue;
  std::deque<int> reference;
  // Positive: push so many; negative: pop so many.
  const auto bursts = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-2'000, 3'000));
  int next = 0;
  for (const int burst : bursts) {
    for (int k = 0; k < burst; ++k) {
      queue.push_back() = next;
      reference.push_back(next++);
    }
    for (int k = 0; k < -burst && !reference.empty(); ++k) {
      RC_ASSERT(queue.front() == reference.front());
      queue.pop_front();
      reference.pop_front();
    }
    RC_ASSERT(queue.size() == reference.size());
    RC_ASSERT(queue.empty() == reference.empty());
    if (reference.empty()) continue;
    RC_ASSERT(queue.front() == reference.front());
  }
}

TEST(ChunkQueue, UsesAChunkAgainThatHasBeenLeft) {
  ChunkQueue<int> queue;
  int first = 0;
  for (int k = 0; k < 10'000; ++k) {
    queue.push_back() = 2 * k;
    queue.push_back() = 2 * k + 1;
    ASSERT_EQ(queue.front(), first++);
    queue.pop_front();
  }
  for (; !queue.empty(); queue.pop_front()) ASSERT_EQ(queue.front(), first++);
  EXPECT_EQ(first, 20'000);
  queue.push_back() = 1;
  EXPECT_EQ(queue.front(), 1);
  queue.pop_front();
  EXPECT_TRUE(queue.empty());
}

}  // namespace chunk_queue_test
}  // namespace stormproof::model
