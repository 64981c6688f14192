// The order of the default node, and its two topics.
#include "model/engine/node_endpoints.hpp"

#include <array>

namespace stormproof::model {

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

constexpr std::uint32_t first_user_topic = 2;
constexpr std::uint32_t parameter_events_publication = 8;
constexpr std::uint32_t parameter_events_subscription = 7;

}  // namespace

Endpoint creation_order(std::uint32_t k, std::uint32_t user_publications) {
  if (k < defaults) return node_order[k];
  const std::uint32_t user = k - defaults;
  if (user < user_publications) return {Stream::pub, default_publications + user};
  return {Stream::sub, default_subscriptions + user - user_publications};
}

std::uint32_t shared_topic_of(Stream s, std::uint32_t d) {
  const bool pub = s == Stream::pub;
  const std::uint32_t count = pub ? default_publications : default_subscriptions;
  if (d >= count) return first_user_topic + d - count;
  if (d == 0) return 0;
  if (d == (pub ? parameter_events_publication : parameter_events_subscription)) return 1;
  return no_topic;
}

std::uint32_t descriptor_on_topic(std::uint32_t topic, Stream s) {
  const bool pub = s == Stream::pub;
  if (topic == 0) return 0;
  if (topic == 1) return pub ? parameter_events_publication : parameter_events_subscription;
  return (pub ? default_publications : default_subscriptions) + topic - first_user_topic;
}

}  // namespace stormproof::model
