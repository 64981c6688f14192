// Measures per-packet delays. Packets are numbered in the order of their emission, so those under
// way are a queue from which numbers drop out.
#include "props/monitors/delay_meter.hpp"

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/implementations.hpp"

namespace stormproof::props {

DelayMeter::DelayMeter(const model::Scenario& scenario)
    : lost_packets_{scenario.wireless.lost_packets},
      silent_loss_{model::traits_of(scenario.dds).receives_separately &&
                   scenario.wireless.kind == model::ServiceKind::constant_delay} {}

void DelayMeter::emitted(const model::Packet& packet, model::Nanoseconds now) {
  for (std::uint32_t copy = 0; copy < packet.copies; ++copy) {
    const bool gone = silent_loss_ && will_be_lost(packet.number + copy);
    if (gone) ++lost_;
    under_way_.push_back({now, gone || packet.to_nobody});
  }
}

void DelayMeter::arrived(const model::Packet& packet, bool lost) {
  if (!lost) return;
  ++lost_;
  leave(packet.number);
}

bool crosses_hosts(const model::Topology& topology, const model::Packet& packet,
                   std::uint32_t receiver) {
  if (!packet.multicast()) return topology.pair(packet.pair).cross_host;
  if (receiver == model::Probe::everybody) return true;
  return topology.pair(topology.pair_between(packet.pair, receiver)).cross_host;
}

void DelayMeter::received(const model::Topology& topology, const model::Packet& packet,
                          std::uint32_t receiver, model::Nanoseconds now) {
  if (!crosses_hosts(topology, packet, receiver)) return;
  const model::Nanoseconds delay = now - packet.emitted;
  largest_ = std::max(largest_, delay);
  if (packet.carries_initial) largest_initial_ = std::max(largest_initial_, delay);
  leave(packet.number);
}

void DelayMeter::leave(std::uint64_t number) {
  if (number < first_ || number - first_ >= under_way_.size()) return;
  under_way_[number - first_].left = true;
  while (!under_way_.empty() && under_way_.front().left) {
    under_way_.pop_front();
    ++first_;
  }
}

model::Nanoseconds DelayMeter::largest(model::Nanoseconds end) const {
  if (under_way_.empty()) return largest_;
  return std::max(largest_, end - under_way_.front().emitted);
}

bool takes_equal_times(const model::WirelessProfile& wireless) {
  return wireless.kind == model::ServiceKind::constant_delay && wireless.packet_delays.empty();
}

model::Nanoseconds loopback_of(const model::Scenario& scenario) {
  const bool same_host = model::traits_of(scenario.dds).discovers_same_host;
  return same_host ? scenario.deployment.loopback_delay : model::Nanoseconds{0};
}

}  // namespace stormproof::props
