// The wireless profile of a random scenario: rates and overheads, routes of one to four stages on
// one to three channels, queues smaller than a packet, losses, delays of single packets.
#include <set>
#include <string>

#include "props/generators/draw.hpp"

namespace stormproof::props {

namespace {

using model::Bytes;
using model::Nanoseconds;
using model::WirelessProfile;

model::BitsPerSecond draw_rate(Dice& dice) {
  if (dice.chance(3)) return model::BitsPerSecond{dice.magnitude(1, 1'000'000'000'000'000)};
  return model::BitsPerSecond{
      dice.among({144'400'000, 6'000'000, 8'000'000, 8'000'000'000, 1'000'000'000'000,
                  dice.magnitude(1'000'000, 1'000'000'000)})};
}

Nanoseconds draw_overhead(Dice& dice) {
  return Nanoseconds{dice.among({194'500, 130'500, 0, 10 * microsecond, 100 * microsecond,
                                 100 * microsecond, dice.magnitude(1, millisecond)})};
}

model::Stage draw_stage(Dice& dice, std::uint32_t number, std::uint32_t channels) {
  model::Stage stage;
  stage.name = "stage" + std::to_string(number);
  stage.channel = "channel" + std::to_string(dice.between(1, channels));
  stage.multicast_as = dice.choice<model::MulticastAs>(2);
  if (dice.chance(25)) stage.overhead_unicast = draw_overhead(dice);
  if (dice.chance(25)) stage.overhead_multicast = draw_overhead(dice);
  if (dice.chance(25)) stage.rate_unicast = draw_rate(dice);
  if (dice.chance(25)) stage.rate_multicast = draw_rate(dice);
  return stage;
}

void draw_route(Dice& dice, WirelessProfile& w) {
  if (dice.chance(30)) return;
  const std::uint32_t stages = dice.count(1, 4);
  const std::uint32_t channels = dice.count(1, 3);
  w.stages.clear();
  for (std::uint32_t k = 1; k <= stages; ++k) w.stages.push_back(draw_stage(dice, k, channels));
}

/// Some packet numbers, ascending; mostly of packets that a run has.
std::vector<std::uint64_t> draw_packets(Dice& dice) {
  std::set<std::uint64_t> packets;
  const std::int64_t range = dice.among({20, 100, 400, 400});
  for (std::int64_t k = dice.among({1, 3, 12, 40}); k > 0; --k) {
    packets.insert(static_cast<std::uint64_t>(dice.between(0, range)));
  }
  return {packets.begin(), packets.end()};
}

}  // namespace

void draw_wireless(Dice& dice, const ScenarioSpace& space, WirelessProfile& w) {
  const bool is_delay = dice.chance(20);
  w.kind = space.service.value_or(is_delay ? model::ServiceKind::constant_delay
                                           : model::ServiceKind::shared_channel);
  w.one_way =
      Nanoseconds{dice.among({0, 1, 100 * microsecond, millisecond, dice.magnitude(1, second)})};
  if (dice.chance(60)) {
    w.overhead_unicast = draw_overhead(dice);
    w.overhead_multicast = draw_overhead(dice);
    w.rate_unicast = draw_rate(dice);
    w.rate_multicast = draw_rate(dice);
  }
  w.order = dice.choice<model::ServiceOrder>(4);
  w.fragment_request = dice.choice<model::FragmentRequest>(2);
  w.link_overhead_bytes = Bytes{dice.among({38, 38, 0, 1, 100})};
  w.mtu_payload_bytes =
      Bytes{dice.among({1'480, 1'480, 1'479, 577, 1'001, 65'535, 100, dice.between(200, 3'000)})};
  w.source_queue_bytes = Bytes{dice.among({212'992, 212'992, WirelessProfile::unlimited.count(), 1,
                                           dice.between(100, 4'000), dice.between(4'000, 40'000)})};
  draw_route(dice, w);
  if (space.losses && dice.chance(60)) w.lost_packets = draw_packets(dice);
}

void draw_packet_delays(Dice& dice, const Clock& clock, WirelessProfile& w) {
  if (w.kind != model::ServiceKind::constant_delay || dice.chance(50)) return;
  for (const std::uint64_t packet : draw_packets(dice)) {
    const std::int64_t usual = w.one_way.count();
    const std::int64_t one_way =
        std::max(draw_reaction(dice, clock, usual).count(), dice.among({0, usual, usual + 1}));
    const std::int64_t leaves_after = dice.among({0, one_way, dice.between(0, one_way)});
    w.packet_delays.push_back({packet, Nanoseconds{leaves_after}, Nanoseconds{one_way}});
  }
}

}  // namespace stormproof::props
