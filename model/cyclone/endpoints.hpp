// What a ROS 2 node has in Cyclone DDS 0.10: its writers, and how large what they send is on the
// wire. Sizes are those of submessages, as captured.
#pragma once

#include <cstdint>
#include <string>

#include "model/engine/node_endpoints.hpp"
#include "model/engine/topology.hpp"
#include "model/units.hpp"

namespace stormproof::model::cyclone {

/// The writers of a participant: five builtin ones, in the order in which they match, then one for
/// each topic.
namespace writer {
inline constexpr std::uint32_t publications = 0;
inline constexpr std::uint32_t subscriptions = 1;
inline constexpr std::uint32_t liveliness = 2;  ///< then the two of type lookup
inline constexpr std::uint32_t first_topic = 5;
inline constexpr std::uint32_t none = UINT32_MAX;
}  // namespace writer

/// How many numbers a participant's writers take: as many as the one with the most has.
[[nodiscard]] std::uint32_t writers_per_participant(const Topology& topology);
/// "publications", "ros_discovery_info", "user topic 3".
[[nodiscard]] std::string name_of_writer(std::uint32_t writer);

/// The writer of the topic of a descriptor, or `writer::none`.
[[nodiscard]] inline std::uint32_t topic_writer(Stream s, std::uint32_t d) {
  const std::uint32_t topic = shared_topic_of(s, d);
  return topic == no_topic ? writer::none : writer::first_topic + topic;
}
/// The descriptor of stream s on the topic of a writer.
[[nodiscard]] inline std::uint32_t descriptor_of(std::uint32_t topic_writer, Stream s) {
  return descriptor_on_topic(topic_writer - writer::first_topic, s);
}

// UDP payload bytes.
inline constexpr std::int64_t header_bytes = 20;
inline constexpr std::int64_t destination_bytes = 16;  ///< if it goes to a participant by name
inline constexpr std::int64_t announcement_bytes = 316;
inline constexpr std::int64_t announcement_with_multicast_bytes = 372;
inline constexpr std::int64_t heartbeat_bytes = 32;
inline constexpr std::int64_t acknack_bytes = 28;
inline constexpr std::int64_t gap_bytes = 32;
inline constexpr std::int64_t bitmap_word_bytes = 4;
inline constexpr std::int64_t timestamp_bytes = 12;  ///< before DATA
inline constexpr std::int64_t deletion_bytes = 64;   ///< of an endpoint, or of a participant
inline constexpr std::int64_t largest_submessage_bytes = 372;  ///< except ACKNACKs

/// Bytes of the DATA of a sample, its timestamp included.
[[nodiscard]] std::int64_t data_bytes(std::uint32_t writer, std::uint32_t sample);

}  // namespace stormproof::model::cyclone
