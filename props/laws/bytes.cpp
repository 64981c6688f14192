// The law of bytes: with all sizes on the channel × c and all rates × c every airtime is the same,
// exactly (round(8·10⁹·cB/(cR)) = round(8·10⁹·B/R), with R/2 rounded down on both sides). A payload
// b is b + 8 bytes of IP payload, so it becomes c·(b + 8) − 8; likewise link overhead and limits.
// What has a constant in it does not scale and is left out: `grouping: mtu` (1472 B), the charge of
// the piggyback budget (it counts payloads, not bytes on the channel), and the 4 bytes of an
// ACKNACK's bitmap for every 32 descriptors. So on a shared channel runs are the same up to the
// first ACKNACK with a bitmap, with a constant delay to the end. Fast DDS's sizes are constants.
#include "model/airtime.hpp"
#include "props/laws/families.hpp"
#include "props/laws/run_log.hpp"

namespace stormproof::props {

namespace {

using model::BitsPerSecond;
using model::Bytes;
using model::Scenario;
using Broken = std::optional<std::string>;

constexpr std::int64_t size_factor = 3;

bool can_scale(const Scenario& scenario) { return traits_of(scenario).has_size_knobs; }

/// The scenario with values that scale exactly.
Scenario with_scalable_bytes(Scenario scenario) {
  model::SedpProfile& sedp = scenario.dds.sedp;
  sedp.piggyback = model::Piggyback::off;
  if (sedp.grouping == model::Grouping::mtu) sedp.grouping = model::Grouping::message;
  // The sizes of default descriptors are spread evenly, in whole steps.
  model::DescriptorProfile& descriptors = scenario.dds.descriptors;
  std::int64_t steps = 1;
  for (const std::int64_t count :
       {descriptors.default_publications, descriptors.default_subscriptions}) {
    if (count > 1) steps *= count - 1;
  }
  const std::int64_t range = (descriptors.default_bytes[1] - descriptors.default_bytes[0]).count();
  descriptors.default_bytes[1] = descriptors.default_bytes[0] + Bytes{range / steps * steps};
  return scenario;
}

Bytes scaled_payload(Bytes payload) {
  constexpr Bytes header{model::udp_header_bytes};
  return (payload + header) * size_factor - header;
}

Scenario with_scaled_bytes(Scenario scenario) {
  model::SedpProfile& sedp = scenario.dds.sedp;
  model::DescriptorProfile& descriptors = scenario.dds.descriptors;
  for (Bytes* payload :
       {&scenario.dds.spdp.payload_bytes, &sedp.heartbeat_bytes, &sedp.acknack_bytes,
        &sedp.shared_header_bytes, &sedp.grouping_limit_bytes, &descriptors.default_bytes[0],
        &descriptors.default_bytes[1], &descriptors.user_bytes}) {
    *payload = scaled_payload(*payload);
  }
  model::WirelessProfile& wireless = scenario.wireless;
  constexpr Bytes ip_header{model::ip_header_bytes};
  wireless.link_overhead_bytes =
      (wireless.link_overhead_bytes + ip_header) * size_factor - ip_header;
  wireless.mtu_payload_bytes = wireless.mtu_payload_bytes * size_factor;
  if (wireless.source_queue_bytes != model::WirelessProfile::unlimited) {
    wireless.source_queue_bytes = wireless.source_queue_bytes * size_factor;
  }
  const auto faster = [](BitsPerSecond& rate) { rate = rate * size_factor; };
  faster(wireless.rate_unicast);
  faster(wireless.rate_multicast);
  for (model::Stage& stage : wireless.stages) {
    if (stage.rate_unicast) faster(*stage.rate_unicast);
    if (stage.rate_multicast) faster(*stage.rate_multicast);
  }
  return scenario;
}

Broken byte_scaling(const Scenario& scenario, const Simulate& simulate) {
  const Scenario one = with_scalable_bytes(scenario);
  RunLog first{{.sizes = false}};
  RunLog second{{.sizes = false}};
  const model::RunResult a = simulate(one, &first);
  const model::RunResult b = simulate(with_scaled_bytes(one), &second);
  const bool to_the_end = one.wireless.kind == model::ServiceKind::constant_delay ||
                          first.first_bitmap() == first.entries().size();
  if (Broken difference =
          first_difference(first, second, to_the_end ? SIZE_MAX : first.first_bitmap())) {
    return difference;
  }
  return to_the_end ? result_difference(a, b) : std::nullopt;
}

constexpr Law bytes_list[] = {
    {"law.byte-scaling",
     "With all sizes × c and rates × c the run is the same (no piggyback; up to the first ACKNACK "
     "with a bitmap).",
     can_scale, byte_scaling},
};

}  // namespace

std::span<const Law> byte_laws() { return bytes_list; }

}  // namespace stormproof::props
