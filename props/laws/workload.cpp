// Laws of the workload: what discovery has to deliver (the paper's eq. 1), its closed form for
// homogeneous deployments (eq. 2), and the closed forms of the failure-free reference (eq. 4).
#include <algorithm>

#include <fmt/core.h>

#include "model/airtime.hpp"
#include "model/descriptor_sizes.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/packet_sizes.hpp"
#include "model/reference.hpp"
#include "props/laws/families.hpp"
#include "props/laws/run_log.hpp"

namespace stormproof::props {

namespace {

namespace comp = fsm::composition;
using model::Nanoseconds;
using model::Participant;
using model::Scenario;
using model::Stream;
using Broken = std::optional<std::string>;

/// Eq. (1): F, the descriptors of every participant, once for each participant of another host.
std::uint64_t required(const Scenario& scenario) {
  const model::DescriptorProfile& defaults = scenario.dds.descriptors;
  std::uint64_t sum = 0;
  for (const Participant& i : scenario.deployment.participants) {
    for (const Participant& j : scenario.deployment.participants) {
      if (i.host == j.host) continue;
      sum += std::uint64_t{defaults.default_publications} + defaults.default_subscriptions +
             i.publications + i.subscriptions;
    }
  }
  return sum;
}

Broken workload(const Scenario& scenario, const Simulate& simulate) {
  const std::uint64_t all = required(scenario);
  const model::RunResult result = simulate(scenario, nullptr);
  if (result.useful_deliveries + result.missing_count != all) {
    return fmt::format("{} descriptors are delivered and {} missing, but eq. (1) asks for {}.",
                       result.useful_deliveries, result.missing_count, all);
  }
  if (result.completed() && result.counts.initial_data != all) {
    return fmt::format("Discovery is complete with {} initial DATA; eq. (1) asks for {}.",
                       result.counts.initial_data, all);
  }
  if (result.counts.initial_data > all) {
    return fmt::format("{} initial DATA are more than the {} of eq. (1).",
                       result.counts.initial_data, all);
  }
  return std::nullopt;
}

/// N_H equal hosts with N_P equal participants each.
struct Grid {
  std::int64_t hosts;
  std::int64_t per_host;
  std::int64_t endpoints;

  [[nodiscard]] std::int64_t participants() const { return hosts * per_host; }
  [[nodiscard]] std::int64_t peers() const { return (hosts - 1) * per_host; }
};

/// As many hosts as the scenario has, with as many participants as its smallest host.
Grid grid_of(const Scenario& scenario) {
  std::vector<std::int64_t> on_host;
  for (const Participant& p : scenario.deployment.participants) {
    if (p.host.value >= on_host.size()) on_host.resize(p.host.value + 1);
    ++on_host[p.host.value];
  }
  std::erase(on_host, 0);
  const Participant& first = scenario.deployment.participants.front();
  return {static_cast<std::int64_t>(on_host.size()), *std::ranges::min_element(on_host),
          std::int64_t{first.publications} + first.subscriptions};
}

Scenario homogeneous(Scenario scenario, const Grid& grid) {
  scenario.deployment = model::Deployment::homogeneous(static_cast<std::uint32_t>(grid.hosts),
                                                       static_cast<std::uint32_t>(grid.per_host),
                                                       static_cast<std::uint32_t>(grid.endpoints));
  return scenario;
}

/// Airtime of one packet over all stages.
std::int64_t on_air(const model::WirelessProfile& wireless, std::int64_t payload, bool multicast) {
  const std::int64_t mtu = wireless.mtu_payload_bytes.count();
  const std::int64_t headers = 20 + wireless.link_overhead_bytes.count();
  std::int64_t sum = 0;
  for (const model::Stage& stage : wireless.stages) {
    const model::ServiceRate rate = model::service_rate(wireless, stage, multicast);
    for (std::int64_t rest = payload + 8; rest > 0; rest -= mtu) {
      sum += rate.airtime_ns(std::min(rest, mtu) + headers);
    }
  }
  return sum;
}

/// What packets weigh, said once more.
model::PacketSizes weights(model::Of<comp::paper::Paper>, const model::DdsProfile& dds) {
  const std::int64_t header = dds.sedp.shared_header_bytes.count();
  return {
      .announcement = dds.spdp.payload_bytes.count(),
      .heartbeat = dds.sedp.heartbeat_bytes.count(),
      .acknack = dds.sedp.acknack_bytes.count() + 4,
      .header = header,
      .descriptor =
          [&dds, header](Stream stream, std::uint32_t d) {
            return model::DescriptorSizes{dds.descriptors}.bytes(stream, d) - header;
          },
      .is_full = [&dds](std::int64_t payload,
                        std::int64_t added) { return packet_is_full(dds.sedp, payload, added); }};
}
model::PacketSizes weights(model::Of<comp::fastdds::FastDds>, const model::DdsProfile& dds) {
  const std::int64_t statistics = dds.version.statistics_bytes.count();
  return {.announcement = model::fastdds::sizes_of(dds).announcement + statistics,
          .heartbeat = 68 + statistics,
          .acknack = 68 + statistics,
          .header = 36 + statistics,
          .descriptor =
              [&dds](Stream stream, std::uint32_t d) {
                return 12 + model::fastdds::submessage_bytes(dds, stream, d);
              },
          .is_full =
              [&dds](std::int64_t payload, std::int64_t added) {
                return payload - dds.version.statistics_bytes.count() + added >
                       dds.sedp.grouping_limit_bytes.count();
              }};
}

/// Airtime of one stream's descriptors, grouped.
std::int64_t stream_on_air(const Scenario& scenario, const model::PacketSizes& sizes, Stream stream,
                           std::int64_t count) {
  std::vector<std::int64_t> packets;
  for (std::uint32_t d = 0; d < count; ++d) {
    const std::int64_t added = sizes.descriptor(stream, d);
    if (packets.empty() || sizes.is_full(packets.back(), added)) packets.push_back(sizes.header);
    packets.back() += added;
  }
  std::int64_t sum = 0;
  for (const std::int64_t payload : packets) sum += on_air(scenario.wireless, payload, false);
  return sum;
}

/// The open-loop baseline of a homogeneous deployment, in closed form.
std::int64_t open_loop(const Scenario& scenario, const Grid& grid) {
  const model::WirelessProfile& wireless = scenario.wireless;
  const model::DescriptorProfile& defaults = scenario.dds.descriptors;
  const model::DdsProfile dds = model::fastdds::deployed_profile(scenario);
  const model::PacketSizes sizes = model::visit_engine_composition(
      dds, [&](auto composition) { return weights(composition, dds); });
  const std::int64_t spdp = sizes.announcement;
  const std::int64_t control =
      on_air(wireless, sizes.heartbeat, false) + on_air(wireless, sizes.acknack, false);
  const std::int64_t data =
      stream_on_air(scenario, sizes, Stream::pub,
                    defaults.default_publications + (grid.endpoints + 1) / 2) +
      stream_on_air(scenario, sizes, Stream::sub,
                    defaults.default_subscriptions + grid.endpoints / 2);
  const std::int64_t p = grid.peers();
  return grid.participants() *
         ((1 + p) * on_air(wireless, spdp, true) + p * (p + 1) / 2 * on_air(wireless, spdp, false) +
          p * (2 * control + data));
}

/// Eq. (2) and (4) in closed form.
model::Counts closed_form(const Scenario& scenario, const Grid& grid) {
  const model::DescriptorProfile& defaults = scenario.dds.descriptors;
  const std::int64_t n = grid.participants();
  const std::int64_t p = grid.peers();
  const std::int64_t descriptors =
      std::int64_t{defaults.default_publications} + defaults.default_subscriptions + grid.endpoints;
  const std::int64_t recognised = traits_of(scenario).discovers_same_host ? n - 1 : p;
  std::int64_t multicast = 1;
  std::int64_t unicast = 0;
  switch (scenario.dds.spdp.resend) {
    case model::SpdpResend::all_known:
      multicast = 1 + recognised;
      unicast = p * (recognised + 1) / 2;
      break;
    case model::SpdpResend::new_and_multicast:
      multicast = 1 + recognised;
      unicast = p;
      break;
    case model::SpdpResend::new_only:
      unicast = p;
      break;
    case model::SpdpResend::none:
      break;
  }
  const auto count = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
  return {count(n * p * descriptors), 0, count(2 * n * p), count(2 * n * p), count(n * multicast),
          count(n * unicast)};
}

Broken count_difference(const model::Counts& expected, const model::Counts& found,
                        std::string_view of_what) {
  for (std::size_t k = 0; k < expected.entries().size(); ++k) {
    const auto [name, value] = expected.entries()[k];
    if (found.entries()[k].value == value) continue;
    return fmt::format("{}: {} should be {} and is {}.", of_what, name, value,
                       found.entries()[k].value);
  }
  return std::nullopt;
}

Broken homogeneous_forms(const Scenario& scenario, const Simulate& simulate) {
  const Grid grid = grid_of(scenario);
  const Scenario regular = homogeneous(scenario, grid);
  const model::Counts expected = closed_form(regular, grid);
  if (const Broken difference = count_difference(expected, failure_free_reference(regular),
                                                 "The failure-free reference")) {
    return difference;
  }
  if (expected.initial_data != required(regular)) {
    return fmt::format("Eq. (1) asks for {} descriptors, eq. (2) for {}.", required(regular),
                       expected.initial_data);
  }
  if (expected.initial_data == 0) return std::nullopt;
  const model::RunResult result = simulate(regular, nullptr);
  if (result.useful_deliveries + result.missing_count != expected.initial_data) {
    return fmt::format("{} descriptors are delivered and {} missing; eq. (2) asks for {}.",
                       result.useful_deliveries, result.missing_count, expected.initial_data);
  }
  const std::optional<Nanoseconds> airtime = open_loop_airtime(regular);
  if (!airtime || airtime->count() == open_loop(regular, grid)) return std::nullopt;
  return fmt::format("The open-loop airtime is {} ns, its closed form {} ns.", airtime->count(),
                     open_loop(regular, grid));
}

/// What waits for its type is delivered and missing.
bool is_missing_or_delivered(const Scenario& scenario) {
  return is_sent_to_each(scenario) && !scenario.deployment.types;
}

constexpr Law workload_list[] = {
    {"law.workload",
     "Delivered and missing descriptors are F of eq. (1) together, and initial DATA = F at "
     "completion.",
     is_missing_or_delivered, workload},
    {"law.homogeneous-forms",
     "On homogeneous deployments eq. (1) and (2), the reference and the open-loop airtime agree "
     "with their closed forms.",
     is_of_two_writers, homogeneous_forms},
};

}  // namespace

std::span<const Law> workload_laws() { return workload_list; }

}  // namespace stormproof::props
