// The tables of a default node: in which order its endpoints are created, how large their
// descriptors are, and which of them share a topic.
#include "model/fastdds/endpoints.hpp"

#include <numeric>
#include <string>

#include <gtest/gtest.h>

namespace stormproof::model::fastdds {
namespace endpoints_test {

std::string order_of(std::uint32_t publications, std::uint32_t subscriptions) {
  std::string order;
  const std::uint32_t count =
      default_publications + default_subscriptions + publications + subscriptions;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto [stream, d] = creation_order(k, publications);
    order += (stream == Stream::pub ? " p" : " s") + std::to_string(d);
  }
  return order;
}

TEST(Endpoints, ADefaultNodeCreatesItsServicesInPairs) {
  EXPECT_EQ(order_of(0, 0), " p0 s0 p1 s1 p2 s2 p3 s3 p4 s4 p5 s5 p6 s6 p7 p8 s7");
}

TEST(Endpoints, UserPublicationsComeBeforeUserSubscriptions) {
  const std::string defaults = order_of(0, 0);
  EXPECT_EQ(order_of(2, 3), defaults + " p9 p10 s8 s9 s10");
  EXPECT_EQ(order_of(0, 2), defaults + " s8 s9");
  EXPECT_EQ(order_of(3, 0), defaults + " p9 p10 p11");
}

TEST(Endpoints, SizesAreThoseOfTheDataSubmessages) {
  const auto sizes = [](Stream s, std::uint32_t count) {
    std::vector<std::int64_t> list;
    for (std::uint32_t d = 0; d < count; ++d) list.push_back(submessage_bytes(s, d));
    return list;
  };
  EXPECT_EQ(sizes(Stream::pub, 11),
            (std::vector<std::int64_t>{412, 384, 428, 436, 428, 452, 436, 428, 404, 392, 392}));
  EXPECT_EQ(sizes(Stream::sub, 10),
            (std::vector<std::int64_t>{412, 432, 440, 432, 448, 440, 432, 404, 392, 392}));
}

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
