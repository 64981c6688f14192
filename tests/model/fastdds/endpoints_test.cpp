// The endpoints of a default node: which of them share a topic.
#include "model/fastdds/endpoints.hpp"

#include <gtest/gtest.h>

namespace stormproof::model::fastdds {
namespace endpoints_test {

TEST(Endpoints, BothSidesOfATopicAgreeOnIt) {
  EXPECT_EQ(topic_of(Stream::pub, 0), topic::ros_discovery_info);
  EXPECT_EQ(topic_of(Stream::sub, 0), topic::ros_discovery_info);
  EXPECT_EQ(topic_of(Stream::pub, 8), topic::parameter_events);
  EXPECT_EQ(topic_of(Stream::sub, 7), topic::parameter_events);
  for (std::uint32_t k = 0; k < 5; ++k) {
    EXPECT_EQ(topic_of(Stream::pub, 9 + k), topic::first_user + k);
    EXPECT_EQ(topic_of(Stream::sub, 8 + k), topic::first_user + k);
  }
}

TEST(Endpoints, ServicesHaveNoTopicOfTheirOwn) {
  for (std::uint32_t d = 1; d < 8; ++d) EXPECT_EQ(topic_of(Stream::pub, d), topic::none) << d;
  for (std::uint32_t d = 1; d < 7; ++d) EXPECT_EQ(topic_of(Stream::sub, d), topic::none) << d;
}

TEST(Endpoints, ATopicLeadsBackToItsDescriptor) {
  for (const Stream s : {Stream::pub, Stream::sub}) {
    for (std::uint32_t t = topic::ros_discovery_info; t < topic::first_user + 4; ++t) {
      EXPECT_EQ(topic_of(s, descriptor_on(t, s)), t);
    }
  }
}

}  // namespace endpoints_test
}  // namespace stormproof::model::fastdds
