// What a ROS 2 node creates whatever its DDS: which endpoint when, and which of them share a topic.
// The order is that of rcl and the rmw layer creating a node (rosout, ros_discovery_info, six
// parameter services, parameter_events).
#pragma once

#include <cstdint>

#include "model/units.hpp"

namespace stormproof::model {

inline constexpr std::uint32_t default_publications = 9;
inline constexpr std::uint32_t default_subscriptions = 8;

/// One endpoint of a participant: descriptor d of stream s.
struct Endpoint {
  Stream stream{};
  std::uint32_t descriptor = 0;
};

/// The k-th endpoint that a participant with `user_publications` creates (and any number of user
/// subscriptions).
[[nodiscard]] Endpoint creation_order(std::uint32_t k, std::uint32_t user_publications);

/// The topic of a descriptor: 0 ros_discovery_info, 1 parameter_events, 2 + k the user topic k; or
/// `no_topic`, if nobody has the other side.
inline constexpr std::uint32_t no_topic = UINT32_MAX;
[[nodiscard]] std::uint32_t shared_topic_of(Stream s, std::uint32_t d);
/// The descriptor of stream s on a topic.
[[nodiscard]] std::uint32_t descriptor_on_topic(std::uint32_t topic, Stream s);

}  // namespace stormproof::model
