// The tables of the default node.
#include "model/fastdds/endpoints.hpp"

namespace stormproof::model::fastdds {

namespace {

constexpr std::array<std::int64_t, default_publications> publication_bytes{412, 384, 428, 436, 428,
                                                                           452, 436, 428, 404};
constexpr std::array<std::int64_t, default_subscriptions> subscription_bytes{412, 432, 440, 432,
                                                                             448, 440, 432, 404};
constexpr std::int64_t user_bytes = 392;

}  // namespace

std::int64_t submessage_bytes(Stream s, std::uint32_t d) {
  if (s == Stream::pub) return d < default_publications ? publication_bytes[d] : user_bytes;
  return d < default_subscriptions ? subscription_bytes[d] : user_bytes;
}

std::uint32_t topic_of(Stream s, std::uint32_t d) {
  const std::uint32_t shared = shared_topic_of(s, d);
  return shared == no_topic ? topic::none : topic::ros_discovery_info + shared;
}

std::uint32_t descriptor_on(std::uint32_t t, Stream s) {
  return descriptor_on_topic(t - topic::ros_discovery_info, s);
}

}  // namespace stormproof::model::fastdds
