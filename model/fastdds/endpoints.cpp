// The tables of the default node.
#include "model/fastdds/endpoints.hpp"

namespace stormproof::model::fastdds {

namespace {

constexpr std::uint32_t defaults = default_publications + default_subscriptions;

constexpr std::array<Endpoint, defaults> node_order{{{Stream::pub, 0},
                                                     {Stream::sub, 0},
                                                     {Stream::pub, 1},
                                                     {Stream::sub, 1},
                                                     {Stream::pub, 2},
                                                     {Stream::sub, 2},
                                                     {Stream::pub, 3},
                                                     {Stream::sub, 3},
                                                     {Stream::pub, 4},
                                                     {Stream::sub, 4},
                                                     {Stream::pub, 5},
                                                     {Stream::sub, 5},
                                                     {Stream::pub, 6},
                                                     {Stream::sub, 6},
                                                     {Stream::pub, 7},
                                                     {Stream::pub, 8},
                                                     {Stream::sub, 7}}};

constexpr std::array<std::int64_t, default_publications> publication_bytes{412, 384, 428, 436, 428,
                                                                           452, 436, 428, 404};
constexpr std::array<std::int64_t, default_subscriptions> subscription_bytes{412, 432, 440, 432,
                                                                             448, 440, 432, 404};
constexpr std::int64_t user_bytes = 392;

constexpr std::uint32_t parameter_events_publication = 8;
constexpr std::uint32_t parameter_events_subscription = 7;

}  // namespace

Endpoint creation_order(std::uint32_t k, std::uint32_t user_publications) {
  if (k < defaults) return node_order[k];
  const std::uint32_t user = k - defaults;
  if (user < user_publications) return {Stream::pub, default_publications + user};
  return {Stream::sub, default_subscriptions + user - user_publications};
}

std::int64_t submessage_bytes(Stream s, std::uint32_t d) {
  if (s == Stream::pub) return d < default_publications ? publication_bytes[d] : user_bytes;
  return d < default_subscriptions ? subscription_bytes[d] : user_bytes;
}

std::uint32_t topic_of(Stream s, std::uint32_t d) {
  const bool pub = s == Stream::pub;
  const std::uint32_t count = pub ? default_publications : default_subscriptions;
  if (d >= count) return topic::first_user + d - count;
  if (d == 0) return topic::ros_discovery_info;
  if (d == (pub ? parameter_events_publication : parameter_events_subscription)) {
    return topic::parameter_events;
  }
  return topic::none;
}

std::uint32_t descriptor_on(std::uint32_t t, Stream s) {
  const bool pub = s == Stream::pub;
  if (t == topic::ros_discovery_info) return 0;
  if (t == topic::parameter_events) {
    return pub ? parameter_events_publication : parameter_events_subscription;
  }
  return (pub ? default_publications : default_subscriptions) + t - topic::first_user;
}

}  // namespace stormproof::model::fastdds
