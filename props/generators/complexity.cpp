// See the header; the knobs are those of knob_access.hpp.
#include "props/generators/complexity.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "props/generators/knob_access.hpp"

namespace stormproof::props {

namespace {

using model::Scenario;

std::int64_t decimal_digits(std::int64_t value) {
  std::int64_t digits = 1;
  while (value >= 10) value /= 10, ++digits;
  return digits;
}

/// Packet numbers are at most 10^15 and there may be many of them; the sum stays below 2^64.
std::uint64_t bounded(std::uint64_t packet) { return std::min<std::uint64_t>(packet, 1U << 31U); }

void count_lost_packets(const Scenario& scenario, const Scenario& base, Complexity& sum) {
  std::vector<std::uint64_t> different;
  std::ranges::set_symmetric_difference(scenario.wireless.lost_packets, base.wireless.lost_packets,
                                        std::back_inserter(different));
  sum.packets += different.size();
  for (const std::uint64_t packet : different) sum.numbers += bounded(packet);
}

/// A delay of the base may have another value here; its knobs then count.
void count_packet_delays(const Scenario& scenario, const Scenario& base, Complexity& sum) {
  if (scenario.wireless.packet_delays == base.wireless.packet_delays) return;
  for (const model::PacketDelay& delay : scenario.wireless.packet_delays) {
    ++sum.packets;
    sum.numbers += bounded(delay.packet);
  }
  ++sum.packets;
}

std::uint64_t route_complexity(const model::WirelessProfile& wireless,
                               const model::WirelessProfile& base) {
  if (wireless.stages == base.stages) return 0;
  std::uint64_t sum = 1;
  for (const model::Stage& stage : wireless.stages) {
    const auto overrides = static_cast<unsigned>(stage.overhead_unicast.has_value()) +
                           static_cast<unsigned>(stage.overhead_multicast.has_value()) +
                           static_cast<unsigned>(stage.rate_unicast.has_value()) +
                           static_cast<unsigned>(stage.rate_multicast.has_value());
    const unsigned on_another_channel = stage.channel == wireless.stages.front().channel ? 0 : 10;
    sum += 100 + on_another_channel + overrides;
  }
  return sum;
}

}  // namespace

std::uint64_t number_cost(std::int64_t value, std::int64_t base) {
  if (value == base) return 0;
  if (value == 0) return 1;
  const std::int64_t distance = std::abs(decimal_digits(value) - decimal_digits(base));
  while (value % 10 == 0) value /= 10;
  const std::int64_t significant = decimal_digits(value);
  const std::int64_t first_digit = significant == 1 ? value : 1;
  return static_cast<std::uint64_t>(2 + 1000 * (significant - 1) + 20 * (first_digit - 1) +
                                    distance);
}

Complexity complexity(const Scenario& scenario, const Scenario& base) {
  Complexity sum;
  for (const model::Participant& p : scenario.deployment.participants) {
    sum.hosts += std::uint64_t{p.host.value} * (scenario.deployment.size() - sum.participants);
    ++sum.participants;
    sum.endpoints += std::uint64_t{p.publications} + p.subscriptions;
  }
  if (const auto& life = scenario.deployment.life) {
    sum.failures = 1 + life->stale.size() + life->mute.size() + life->outages.size() +
                   life->restarts.size() + life->leases.size() + life->endpoints.size() +
                   (life->lease ? 1 : 0);
  }
  count_lost_packets(scenario, base, sum);
  count_packet_delays(scenario, base, sum);
  sum.route = route_complexity(scenario.wireless, base.wireless);
  if (scenario.dds.implementation != base.dds.implementation) ++sum.changed;
  Scenario copy = scenario;
  for (const Knob& knob : knobs_of(copy, base)) {
    if (!knob.is_changed()) continue;
    ++sum.changed;
    sum.digits += knob.kind == Knob::Kind::choice ? 1 : number_cost(knob.get(), knob.base);
  }
  return sum;
}

}  // namespace stormproof::props
