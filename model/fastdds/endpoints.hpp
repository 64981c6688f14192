// How large the descriptors of a ROS 2 node are on the wire in Fast DDS 2.6.11, as serialized DATA
// submessages, and which topics they belong to.
#pragma once

#include <array>
#include <cstdint>

#include "model/engine/node_endpoints.hpp"
#include "model/units.hpp"

namespace stormproof::model::fastdds {

using model::creation_order;
using model::default_publications;
using model::default_subscriptions;
using model::Endpoint;

/// UDP payload bytes.
inline constexpr std::int64_t spdp_bytes = 252;
inline constexpr std::int64_t heartbeat_to_one_bytes = 68;   ///< header, INFO_DST, HEARTBEAT
inline constexpr std::int64_t heartbeat_to_many_bytes = 52;  ///< without INFO_DST
inline constexpr std::int64_t acknack_bytes = 64;
inline constexpr std::int64_t acknack_bitmap_bytes = 4;  ///< more, if the bitmap is not empty
inline constexpr std::int64_t message_header_bytes = 20;
inline constexpr std::int64_t destination_bytes = 16;  ///< INFO_DST, if there is one destination
inline constexpr std::int64_t timestamp_bytes = 12;    ///< INFO_TS before each descriptor
inline constexpr std::int64_t heartbeat_submessage_bytes = 32;
inline constexpr std::int64_t inline_qos_bytes = 32;  ///< of a descriptor to or from a server
inline constexpr std::int64_t largest_submessage_bytes = 452;  ///< of one descriptor

/// Bytes of the DATA submessage of a descriptor.
[[nodiscard]] std::int64_t submessage_bytes(Stream s, std::uint32_t d);

/// Topics of control-only relations: 0 is liveliness, then the two topics that every node has, then
/// user topic k.
namespace topic {
inline constexpr std::uint32_t liveliness = 0;
inline constexpr std::uint32_t ros_discovery_info = 1;
inline constexpr std::uint32_t parameter_events = 2;
inline constexpr std::uint32_t first_user = 3;
inline constexpr std::uint32_t none = UINT32_MAX;
}  // namespace topic

/// The topic of a descriptor, or `topic::none`.
[[nodiscard]] std::uint32_t topic_of(Stream s, std::uint32_t d);
/// The descriptor of stream s on a topic other than liveliness.
[[nodiscard]] std::uint32_t descriptor_on(std::uint32_t topic, Stream s);

}  // namespace stormproof::model::fastdds
