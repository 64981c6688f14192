// How large descriptors are and how many share a packet: the inputs of grouping, for the writer and
// for the open-loop baseline alike.
#pragma once

#include <array>
#include <cstdint>

#include "model/dds_profile.hpp"

namespace stormproof::model {

/// UDP payload of a packet that carries one descriptor alone.
class DescriptorSizes {
 public:
  explicit DescriptorSizes(const DescriptorProfile& profile)
      : defaults_{profile.default_publications, profile.default_subscriptions},
        first_{profile.default_bytes[0].count()},
        range_{(profile.default_bytes[1] - profile.default_bytes[0]).count()},
        user_{profile.user_bytes.count()} {}

  /// Default descriptors come first and are spread evenly over the given range of sizes.
  [[nodiscard]] std::int64_t bytes(Stream s, std::uint32_t d) const {
    const std::int64_t defaults = defaults_[index_of(s)];
    if (d >= defaults) return user_;
    return defaults == 1 ? first_ : first_ + range_ * d / (defaults - 1);
  }

 private:
  std::array<std::int64_t, 2> defaults_;
  std::int64_t first_;
  std::int64_t range_;
  std::int64_t user_;
};

/// Whether a packet with `payload_bytes` has no room for a descriptor that would add `added_bytes`.
[[nodiscard]] constexpr bool packet_is_full(const SedpProfile& sedp, std::int64_t payload_bytes,
                                            std::int64_t added_bytes) {
  constexpr std::int64_t mtu_limit = 1472;  // UDP payload of one unfragmented Ethernet frame
  switch (sedp.grouping) {
    case Grouping::single:
      return true;
    case Grouping::mtu:
      return payload_bytes + added_bytes > mtu_limit;
    case Grouping::message:
      return payload_bytes + added_bytes > sedp.grouping_limit_bytes.count();
  }
  return true;
}

}  // namespace stormproof::model
