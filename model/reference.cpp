// Counts and airtimes of a discovery in which everything is sent once.
#include "model/reference.hpp"

#include "model/airtime.hpp"
#include "model/descriptor_sizes.hpp"
#include "model/engine/topology.hpp"
#include "model/fastdds/endpoints.hpp"

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

constexpr std::int64_t bitmap_word_bytes = 4;  // an ACKNACK that asks for something

/// UDP payloads under the paper's profile.
class PaperSizes {
 public:
  explicit PaperSizes(const DdsProfile& dds) : dds_{dds}, descriptors_{dds.descriptors} {}
  [[nodiscard]] std::int64_t spdp() const { return dds_.spdp.payload_bytes.count(); }
  [[nodiscard]] std::int64_t heartbeat() const { return dds_.sedp.heartbeat_bytes.count(); }
  [[nodiscard]] std::int64_t acknack() const {
    return dds_.sedp.acknack_bytes.count() + bitmap_word_bytes;
  }
  /// What every DATA packet has once.
  [[nodiscard]] std::int64_t header() const { return dds_.sedp.shared_header_bytes.count(); }
  /// What a descriptor adds to a packet.
  [[nodiscard]] std::int64_t descriptor(Stream s, std::uint32_t d) const {
    return descriptors_.bytes(s, d) - header();
  }
  [[nodiscard]] bool is_full(std::int64_t payload, std::int64_t added) const {
    return packet_is_full(dds_.sedp, payload, added);
  }

 private:
  const DdsProfile& dds_;
  DescriptorSizes descriptors_;
};

/// UDP payloads of Fast DDS.
class FastddsSizes {
 public:
  [[nodiscard]] static std::int64_t spdp() { return fastdds::spdp_bytes; }
  [[nodiscard]] static std::int64_t heartbeat() { return fastdds::heartbeat_to_one_bytes; }
  [[nodiscard]] static std::int64_t acknack() {
    return fastdds::acknack_bytes + fastdds::acknack_bitmap_bytes;
  }
  [[nodiscard]] static std::int64_t header() {
    return fastdds::message_header_bytes + fastdds::destination_bytes;
  }
  [[nodiscard]] static std::int64_t descriptor(Stream s, std::uint32_t d) {
    return fastdds::timestamp_bytes + fastdds::submessage_bytes(s, d);
  }
  [[nodiscard]] bool is_full(std::int64_t payload, std::int64_t added) const {
    return payload + added > limit.count();
  }

  Bytes limit;  ///< of a message
};

/// All `count` descriptors of one stream, grouped into packets without piggybacked HEARTBEATs.
template <class Sizes>
std::int64_t data_ns(const RouteAirtime& route, const Sizes& sizes, Stream s, std::uint32_t count) {
  std::int64_t sum = 0;
  std::int64_t payload = 0;
  for (std::uint32_t d = 0; d < count; ++d) {
    const std::int64_t added = sizes.descriptor(s, d);
    if (payload > 0 && sizes.is_full(payload, added)) {
      sum += route.packet_ns(payload, false);
      payload = 0;
    }
    payload += payload == 0 ? sizes.header() + added : added;
  }
  return payload == 0 ? sum : sum + route.packet_ns(payload, false);
}

template <class Sizes>
std::int64_t everything_once_ns(const Topology& topology, const RouteAirtime& route,
                                const Sizes& sizes) {
  const std::int64_t control =
      route.packet_ns(sizes.heartbeat(), false) + route.packet_ns(sizes.acknack(), false);
  const std::int64_t multicast = route.packet_ns(sizes.spdp(), true);
  const std::int64_t unicast = route.packet_ns(sizes.spdp(), false);
  std::int64_t sum = 0;
  for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
    const std::int64_t peers = topology.peer_count(i);
    sum += (1 + peers) * multicast + peers * (peers + 1) / 2 * unicast;
    for (const Stream s : streams) {
      sum += peers * (control + data_ns(route, sizes, s, topology.descriptor_count(i, s)));
    }
  }
  return sum;
}

/// SPDP of the failure-free reference: each of a participant's `recognitions` sends one
/// announcement more. With Fast DDS same-host participants are recognised too; of the copies to all
/// known ones, on average the share of the cross-host peers crosses hosts.
void add_spdp(Counts& counts, SpdpResend resend, std::uint64_t recognitions, std::uint64_t peers) {
  switch (resend) {
    case SpdpResend::all_known:
      counts.spdp_multicast += 1 + recognitions;
      counts.spdp_unicast += peers * (recognitions + 1) / 2;
      break;
    case SpdpResend::new_and_multicast:
      counts.spdp_multicast += 1 + recognitions;
      counts.spdp_unicast += peers;
      break;
    case SpdpResend::new_only:
      counts.spdp_multicast += 1;
      counts.spdp_unicast += peers;
      break;
    case SpdpResend::none:
      counts.spdp_multicast += 1;
      break;
  }
}

}  // namespace

Counts failure_free_reference(const Scenario& scenario) {
  const Topology topology{scenario.deployment, scenario.dds.descriptors};
  Counts counts;
  counts.initial_data = topology.required_deliveries();
  counts.heartbeat = topology.relation_count();
  counts.acknack = topology.relation_count();
  const bool fastdds = is_fastdds(scenario.dds);
  for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
    const std::uint64_t peers = topology.peer_count(i);
    add_spdp(counts, scenario.dds.spdp.resend, fastdds ? topology.participant_count() - 1 : peers,
             peers);
  }
  return counts;
}

std::optional<Nanoseconds> open_loop_airtime(const Scenario& scenario) {
  if (scenario.wireless.kind == ServiceKind::constant_delay) return std::nullopt;
  const Topology topology{scenario.deployment, scenario.dds.descriptors};
  const RouteAirtime route{scenario.wireless};
  if (is_fastdds(scenario.dds)) {
    const FastddsSizes sizes{scenario.dds.sedp.grouping_limit_bytes};
    return Nanoseconds{everything_once_ns(topology, route, sizes)};
  }
  return Nanoseconds{everything_once_ns(topology, route, PaperSizes{scenario.dds})};
}

}  // namespace stormproof::model
