// What packets weigh in the profile's implementation, for whoever computes with packets that no run
// has sent: baselines, bounds, captures that are written.
#pragma once

#include <cstdint>
#include <functional>

#include "model/dds_profile.hpp"

namespace stormproof::model {

/// UDP payload bytes.
struct PacketSizes {
  std::int64_t announcement = 0;
  std::int64_t heartbeat = 0;          ///< of its own, to one reader
  std::int64_t acknack = 0;            ///< that asks for something among 32 descriptors
  std::int64_t header = 0;             ///< what every message has once, whoever it goes to
  std::int64_t destination = 0;        ///< more in a message to one reader; 0: part of the header
  std::int64_t heartbeat_in_data = 0;  ///< what a HEARTBEAT adds to a message with DATA
  /// What a descriptor adds to a message.
  std::function<std::int64_t(Stream, std::uint32_t)> descriptor;
  /// Whether a message with `payload` bytes has no room for a descriptor that adds `added`.
  std::function<bool(std::int64_t payload, std::int64_t added)> is_full;
};

/// Of the profile as it is; what descriptors say of types that a deployment has is in
/// fastdds::deployed_profile.
[[nodiscard]] PacketSizes packet_sizes(const DdsProfile& dds);

}  // namespace stormproof::model
