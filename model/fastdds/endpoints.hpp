// How large the announcement and the descriptors of a ROS 2 node are on the wire in the versions of
// Fast DDS, descriptors as serialized DATA submessages, and which topics they belong to.
#pragma once

#include <array>
#include <cstdint>

#include "model/dds_profile.hpp"
#include "model/engine/node_endpoints.hpp"
#include "model/units.hpp"

namespace stormproof::model {
struct Scenario;  // model/scenario.hpp
}

namespace stormproof::model::fastdds {

using model::creation_order;
using model::default_publications;
using model::default_subscriptions;
using model::Endpoint;

/// UDP payload bytes.
inline constexpr std::int64_t heartbeat_to_one_bytes = 68;   ///< header, INFO_DST, HEARTBEAT
inline constexpr std::int64_t heartbeat_to_many_bytes = 52;  ///< without INFO_DST
inline constexpr std::int64_t acknack_bytes = 64;
inline constexpr std::int64_t acknack_bitmap_bytes = 4;  ///< more, if the bitmap is not empty
inline constexpr std::int64_t message_header_bytes = 20;
inline constexpr std::int64_t destination_bytes = 16;  ///< INFO_DST, if there is one destination
inline constexpr std::int64_t timestamp_bytes = 12;    ///< INFO_TS before each descriptor
inline constexpr std::int64_t heartbeat_submessage_bytes = 32;

/// What differs from version to version.
struct VersionSizes {
  std::int64_t announcement = 0;  ///< UDP payload
  std::array<std::int64_t, default_publications> publications{};
  std::array<std::int64_t, default_subscriptions> subscriptions{};
  std::int64_t user_publication = 0;
  std::int64_t user_subscription = 0;
  // With a Discovery Server: UDP payload of DATA(p) of a client, passed on by the server, and of
  // the server itself, without the HEARTBEAT that rides; inline QoS of a descriptor to or from it.
  std::int64_t registration = 0;
  std::int64_t passed_on = 0;
  std::int64_t of_server = 0;
  std::int64_t inline_qos = 0;
};
[[nodiscard]] const VersionSizes& sizes_of(const DdsProfile& dds);

/// Bytes of the DATA submessage of a descriptor.
[[nodiscard]] std::int64_t submessage_bytes(const DdsProfile& dds, Stream s, std::uint32_t d);
/// Of the largest descriptor.
[[nodiscard]] std::int64_t largest_submessage_bytes(const DdsProfile& dds);

/// Bytes of the DATA submessage of a question or answer about so many types, at least one, by its
/// stage (fsm/composition/lookup_parts.hpp), and of the largest one. Measured is the size for one;
/// each more is assumed to bring its identifier, or what its answer has beside a header of 96.
[[nodiscard]] std::int64_t sample_bytes(const DdsProfile& dds, std::uint32_t stage,
                                        std::size_t types);
[[nodiscard]] std::int64_t largest_sample_bytes(const DdsProfile& dds, std::size_t types);

/// What a descriptor says of its type if endpoints have types: its TypeInformation and its hash.
inline constexpr std::int64_t type_information_bytes = 96 + 92;
/// A profile, or the scenario's, as the deployment has it: with what descriptors say of types.
[[nodiscard]] DdsProfile deployed_profile(const Scenario& scenario, DdsProfile dds);
[[nodiscard]] DdsProfile deployed_profile(const Scenario& scenario);

/// Whether participants have endpoints that ask for types.
[[nodiscard]] constexpr bool looks_up_types(const DdsProfile& dds) {
  return dds.version.type_lookup == Whether::yes;
}

/// Topics of control-only relations: 0 is liveliness, then the two topics that every node has, then
/// user topic k; and what asks for types and answers.
namespace topic {
inline constexpr std::uint32_t liveliness = 0;
inline constexpr std::uint32_t ros_discovery_info = 1;
inline constexpr std::uint32_t parameter_events = 2;
inline constexpr std::uint32_t first_user = 3;
inline constexpr std::uint32_t none = UINT32_MAX;
inline constexpr std::array<std::uint32_t, 2> lookups{none - 2, none - 1};  ///< questions, answers
}  // namespace topic
/// Writers of a participant on these topics: that of questions, that of answers, and the others, of
/// which no samples are modelled.
inline constexpr std::uint32_t control_writers = 3;
inline constexpr std::array<const char*, control_writers> control_writer_names{
    "type_questions", "type_answers", "other"};
[[nodiscard]] constexpr bool is_lookup(std::uint32_t t) {
  return t == topic::lookups[0] || t == topic::lookups[1];
}

/// The topic of a descriptor, or `topic::none`.
[[nodiscard]] std::uint32_t topic_of(Stream s, std::uint32_t d);
/// The descriptor of stream s on a topic other than liveliness.
[[nodiscard]] std::uint32_t descriptor_on(std::uint32_t topic, Stream s);

}  // namespace stormproof::model::fastdds
