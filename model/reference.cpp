// Counts and airtimes of a discovery in which everything is sent once.
#include "model/reference.hpp"

#include "model/airtime.hpp"
#include "model/descriptor_sizes.hpp"
#include "model/engine/topology.hpp"

namespace stormproof::model {

namespace {

/// Airtime of whole packets over all stages of the route.
class RouteAirtime {
 public:
  explicit RouteAirtime(const WirelessProfile& wireless)
      : wireless_{wireless}, fragmentation_{wireless} {}

  [[nodiscard]] std::int64_t packet_ns(std::int64_t payload_bytes, bool multicast) const {
    std::int64_t sum = 0;
    for (const Stage& stage : wireless_.stages) {
      const ServiceRate rate = service_rate(wireless_, stage, multicast);
      for (std::int64_t k = 0; k < fragmentation_.count(payload_bytes); ++k) {
        sum += rate.airtime_ns(fragmentation_.bytes(payload_bytes, k));
      }
    }
    return sum;
  }

 private:
  const WirelessProfile& wireless_;
  Fragmentation fragmentation_;
};

/// All `count` descriptors of one stream, grouped into packets without piggybacked HEARTBEATs.
std::int64_t data_ns(const RouteAirtime& route, const DdsProfile& dds, Stream s,
                     std::uint32_t count) {
  const DescriptorSizes sizes{dds.descriptors};
  const std::int64_t shared = dds.sedp.shared_header_bytes.count();
  std::int64_t sum = 0;
  std::int64_t payload = 0;
  for (std::uint32_t d = 0; d < count; ++d) {
    const std::int64_t bytes = sizes.bytes(s, d);
    if (payload > 0 && packet_is_full(dds.sedp, payload, bytes - shared)) {
      sum += route.packet_ns(payload, false);
      payload = 0;
    }
    payload += payload == 0 ? bytes : bytes - shared;
  }
  return payload == 0 ? sum : sum + route.packet_ns(payload, false);
}

}  // namespace

Counts failure_free_reference(const Scenario& scenario) {
  const Topology topology{scenario.deployment, scenario.dds.descriptors};
  Counts counts;
  counts.initial_data = topology.required_deliveries();
  counts.heartbeat = topology.relation_count();
  counts.acknack = topology.relation_count();
  for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
    const std::uint64_t peers = topology.peer_count(i);
    switch (scenario.dds.spdp.resend) {
      case SpdpResend::all_known:
        counts.spdp_multicast += 1 + peers;
        counts.spdp_unicast += peers * (peers + 1) / 2;
        break;
      case SpdpResend::new_and_multicast:
        counts.spdp_multicast += 1 + peers;
        counts.spdp_unicast += peers;
        break;
      case SpdpResend::new_only:
        counts.spdp_multicast += 1;
        counts.spdp_unicast += peers;
        break;
      case SpdpResend::none: counts.spdp_multicast += 1; break;
    }
  }
  return counts;
}

std::optional<Nanoseconds> open_loop_airtime(const Scenario& scenario) {
  if (scenario.wireless.kind == ServiceKind::constant_delay) return std::nullopt;
  const Topology topology{scenario.deployment, scenario.dds.descriptors};
  const RouteAirtime route{scenario.wireless};
  const SedpProfile& sedp = scenario.dds.sedp;
  constexpr std::int64_t bitmap_word_bytes = 4;
  const std::int64_t control =
      route.packet_ns(sedp.heartbeat_bytes.count(), false) +
      route.packet_ns(sedp.acknack_bytes.count() + bitmap_word_bytes, false);
  const std::int64_t spdp_payload = scenario.dds.spdp.payload_bytes.count();
  const std::int64_t spdp_multicast = route.packet_ns(spdp_payload, true);
  const std::int64_t spdp_unicast = route.packet_ns(spdp_payload, false);

  std::int64_t sum = 0;
  for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
    const std::int64_t peers = topology.peer_count(i);
    sum += (1 + peers) * spdp_multicast + peers * (peers + 1) / 2 * spdp_unicast;
    for (const Stream s : streams) {
      sum += peers * (control + data_ns(route, scenario.dds, s, topology.descriptor_count(i, s)));
    }
  }
  return Nanoseconds{sum};
}

}  // namespace stormproof::model
