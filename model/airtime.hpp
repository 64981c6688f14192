// Fragmentation and airtime of a packet: the paper's service demand a(c) = O + 8·B/R of one
// fragment, in whole nanoseconds (rounded to nearest), and the split of a UDP payload into IP
// fragments.
#pragma once

#include <cstdint>

#include "model/wireless_profile.hpp"

namespace stormproof::model {

inline constexpr std::int64_t udp_header_bytes = 8;
inline constexpr std::int64_t ip_header_bytes = 20;

/// How packets become fragments under one wireless profile.
class Fragmentation {
 public:
  explicit Fragmentation(const WirelessProfile& wireless)
      : mtu_payload_{wireless.mtu_payload_bytes.count()},
        header_{ip_header_bytes + wireless.link_overhead_bytes.count()} {}

  /// Number of IP fragments of a packet with this UDP payload.
  [[nodiscard]] std::int64_t count(std::int64_t payload_bytes) const {
    const std::int64_t bytes = payload_bytes + udp_header_bytes;
    return bytes <= mtu_payload_ ? 1 : (bytes + mtu_payload_ - 1) / mtu_payload_;
  }
  /// Bytes on the channel of fragment k (from 0).
  [[nodiscard]] std::int64_t bytes(std::int64_t payload_bytes, std::int64_t k) const {
    const std::int64_t rest = payload_bytes + udp_header_bytes - mtu_payload_ * k;
    return (rest < mtu_payload_ ? rest : mtu_payload_) + header_;
  }
  /// Bytes on the channel of a full fragment.
  [[nodiscard]] std::int64_t longest() const { return mtu_payload_ + header_; }
  /// Bytes that the packet occupies in the source queue: the sum over its fragments.
  [[nodiscard]] std::int64_t demand(std::int64_t payload_bytes, std::int64_t fragments) const {
    return payload_bytes + udp_header_bytes + header_ * fragments;
  }

 private:
  std::int64_t mtu_payload_;
  std::int64_t header_;
};

/// Overhead and rate of one stage for one mode (unicast or multicast).
struct ServiceRate {
  std::int64_t overhead_ns = 0;
  std::int64_t bits_per_second = 1;

  [[nodiscard]] std::int64_t airtime_ns(std::int64_t bytes) const {
    return overhead_ns + (8 * bytes * 1'000'000'000 + bits_per_second / 2) / bits_per_second;
  }
};

/// The same, remembering the last size: in a storm most fragments are HEARTBEATs of one size.
class MemoizedRate {
 public:
  MemoizedRate() = default;
  explicit MemoizedRate(const ServiceRate& rate) : rate_{rate} {}

  [[nodiscard]] std::int64_t airtime_ns(std::int64_t bytes) {
    if (bytes != bytes_) {
      bytes_ = bytes;
      airtime_ns_ = rate_.airtime_ns(bytes);
    }
    return airtime_ns_;
  }

 private:
  ServiceRate rate_;
  std::int64_t bytes_ = -1;
  std::int64_t airtime_ns_ = 0;
};

/// What a packet meets in `stage`: stage overrides come before the profile's values.
[[nodiscard]] inline ServiceRate service_rate(const WirelessProfile& wireless, const Stage& stage,
                                              bool multicast_packet) {
  if (multicast_packet && stage.multicast_as == MulticastAs::multicast) {
    return {stage.overhead_multicast.value_or(wireless.overhead_multicast).count(),
            stage.rate_multicast.value_or(wireless.rate_multicast).count()};
  }
  return {stage.overhead_unicast.value_or(wireless.overhead_unicast).count(),
          stage.rate_unicast.value_or(wireless.rate_unicast).count()};
}

/// Airtime of whole packets over all stages of the route.
class RouteAirtime {
 public:
  explicit RouteAirtime(const WirelessProfile& wireless)
      : wireless_{wireless}, fragmentation_{wireless} {}

  [[nodiscard]] std::int64_t packet_ns(std::int64_t payload_bytes, bool multicast) const {
    std::int64_t sum = 0;
    for (const Stage& stage : wireless_.stages) {
      const ServiceRate rate = service_rate(wireless_, stage, multicast);
      for (std::int64_t k = 0; k < fragments(payload_bytes); ++k) {
        sum += rate.airtime_ns(fragmentation_.bytes(payload_bytes, k));
      }
    }
    return sum;
  }
  [[nodiscard]] std::int64_t fragments(std::int64_t payload_bytes) const {
    return fragmentation_.count(payload_bytes);
  }
  [[nodiscard]] std::size_t stages() const { return wireless_.stages.size(); }

 private:
  const WirelessProfile& wireless_;
  Fragmentation fragmentation_;
};

}  // namespace stormproof::model
