// A message that is being filled. That it already carries a descriptor cannot come about through
// events (a descriptor is in the queue at most once, and nothing puts it there during a run), so it
// is tested here only.
#include "model/fastdds/message.hpp"

#include <gtest/gtest.h>

namespace stormproof::model::fastdds {
namespace message_test {

Message opened(const std::vector<std::uint32_t>& readers, std::uint32_t count = 130) {
  Message message;
  message.start(4, readers, count);
  return message;
}

TEST(Message, IsClosedBeforeItIsStarted) { EXPECT_FALSE(Message{}.open); }

TEST(Message, OneDestinationIsNamedAndTakes16Bytes) {
  EXPECT_EQ(opened({7}).bytes, 36);
  EXPECT_EQ(opened({7, 9}).bytes, 20);
  EXPECT_EQ(opened({7, 9, 11}).bytes, 20);
}

TEST(Message, StartsEmpty) {
  const Message message = opened({7, 9});
  EXPECT_TRUE(message.open);
  EXPECT_EQ(message.writer, 4U);
  EXPECT_EQ(message.data, 0U);
  EXPECT_EQ(message.heartbeats, 0U);
  EXPECT_EQ(message.initial_data, std::vector<std::uint32_t>(2, 0));
}

TEST(Message, KnowsWhatItCarries) {
  Message message = opened({7});
  for (const std::uint32_t d : {0U, 63U, 64U, 129U}) {
    EXPECT_FALSE(message.carries(d)) << d;
    message.add(d, 100);
    EXPECT_TRUE(message.carries(d)) << d;
  }
  EXPECT_FALSE(message.carries(1));
  EXPECT_FALSE(message.carries(65));
  EXPECT_EQ(message.data, 4U);
  EXPECT_EQ(message.bytes, 36 + 4 * 100);
}

TEST(Message, StartedAgainItCarriesNothing) {
  Message message = opened({7});
  message.add(64, 100);
  message.heartbeats = 2;
  message.announced = 65;
  message.initial_data[0] = 1;
  message.start(5, {7, 9}, 70);
  EXPECT_FALSE(message.carries(64));
  EXPECT_EQ(message.data, 0U);
  EXPECT_EQ(message.bytes, 20);
  EXPECT_EQ(message.heartbeats, 0U);
  EXPECT_EQ(message.announced, 0U);
  EXPECT_EQ(message.initial_data, std::vector<std::uint32_t>(2, 0));
}

}  // namespace message_test
}  // namespace stormproof::model::fastdds
