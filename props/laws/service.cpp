// Laws of the wireless service: an order that has nothing to decide, a queue that never fills, and
// losses.
#include <algorithm>

#include "model/airtime.hpp"
#include "props/laws/families.hpp"
#include "props/laws/run_log.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;
using model::Scenario;
using model::ServiceKind;
using Broken = std::optional<std::string>;

bool has_constant_losses(const Scenario& scenario) {
  return !is_shared(scenario) && !scenario.wireless.lost_packets.empty();
}

/// Counts packets and their bytes.
class PacketCounter final : public model::Probe {
 public:
  explicit PacketCounter(const model::WirelessProfile& wireless) : fragmentation_{wireless} {}

  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    packets_ += packet.copies;
    const std::int64_t fragments = fragmentation_.count(packet.payload_bytes);
    bytes_ += packet.copies * fragmentation_.demand(packet.payload_bytes, fragments);
  }
  [[nodiscard]] std::uint64_t packets() const { return packets_; }
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }

 private:
  model::Fragmentation fragmentation_;
  std::uint64_t packets_ = 0;
  std::int64_t bytes_ = 0;
};

Broken single_stage(const Scenario& scenario, const Simulate& simulate) {
  Scenario one = scenario;
  one.wireless.stages.resize(1);
  one.wireless.order = model::ServiceOrder::fifo_uplink;
  Scenario other = one;
  for (const auto order : {model::ServiceOrder::fifo_downlink, model::ServiceOrder::fifo,
                           model::ServiceOrder::datagram_uplink}) {
    other.wireless.order = order;
    if (Broken difference = run_difference(one, other, simulate)) return difference;
  }
  return std::nullopt;
}

Broken unlimited_queue(const Scenario& scenario, const Simulate& simulate) {
  Scenario one = scenario;
  one.wireless.source_queue_bytes = model::WirelessProfile::unlimited;
  PacketCounter counter{one.wireless};
  static_cast<void>(simulate(one, &counter));
  Scenario other = one;
  other.wireless.source_queue_bytes = model::Bytes{std::max<std::int64_t>(1, counter.bytes())};
  return run_difference(one, other, simulate);
}

Broken unsent_losses(const Scenario& scenario, const Simulate& simulate) {
  PacketCounter counter{scenario.wireless};
  static_cast<void>(simulate(scenario, &counter));
  Scenario other = scenario;
  std::vector<std::uint64_t>& lost = other.wireless.lost_packets;
  std::erase_if(lost, [&](std::uint64_t number) { return number >= counter.packets(); });
  lost.push_back(counter.packets());
  lost.push_back(counter.packets() + 7);
  return run_difference(scenario, other, simulate);
}

/// Nothing that happens tells a lost packet from one that is still on its way.
Broken lost_is_late(const Scenario& scenario, const Simulate& simulate) {
  Scenario late = scenario;
  std::vector<model::PacketDelay>& delays = late.wireless.packet_delays;
  for (const std::uint64_t number : scenario.wireless.lost_packets) {
    auto place = std::ranges::lower_bound(delays, number, {}, &model::PacketDelay::packet);
    if (place == delays.end() || place->packet != number) {
      place = delays.insert(place, {number, Nanoseconds{0}, Nanoseconds{0}});
    }
    place->one_way = scenario.time_limit + Nanoseconds{1};
  }
  late.wireless.lost_packets.clear();
  Reading reading;
  reading.lost_arrivals = false;
  reading.schedule = false;
  reading.insertions = false;
  return run_difference(scenario, late, simulate, reading);
}

constexpr Law service_list[] = {
    {"law.single-stage-order", "With a single stage the service order does not matter.", is_shared,
     single_stage},
    {"law.unlimited-queue",
     "A source queue with room for every packet of the run is as good as an unlimited one.",
     is_shared, unlimited_queue},
    {"law.unsent-losses", "A lost packet that is never sent changes nothing.", always,
     unsent_losses},
    {"law.lost-is-late",
     "A lost packet has the effect of one that arrives after the end: none at its receiver.",
     has_constant_losses, lost_is_late},
};

}  // namespace

std::span<const Law> service_laws() { return service_list; }

}  // namespace stormproof::props
