// The parts of random scenarios that no implementation knob touches: the wireless profile with all
// of its knobs, and the clock that all durations of a scenario are taken from.
#include "tests/oracle/random_parts.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "tests/oracle/oracle.hpp"

namespace stormproof::oracle {

namespace {

using model::Bytes;
using model::Nanoseconds;

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t s = 1'000'000'000;

// So fast that the airtime of a fragment is its overhead alone, whatever its size.
constexpr model::BitsPerSecond lockstep_rate{100'000'000'000'000};

model::BitsPerSecond random_rate(Dice& dice) {
  return model::BitsPerSecond{
      dice.pick<std::int64_t>({144'400'000, 6'000'000, 8'000'000, 8'000'000'000, 1'000'000'000'000,
                               dice.magnitude(1'000'000, 1'000'000'000)})};
}

Nanoseconds random_overhead(Dice& dice) {
  return Nanoseconds{dice.pick<std::int64_t>(
      {194'500, 130'500, 0, 10 * us, 100 * us, 100 * us, dice.magnitude(1, 1 * ms)})};
}

model::Stage random_stage(Dice& dice, std::uint32_t number, std::uint32_t channels) {
  model::Stage stage;
  stage.name = "stage" + std::to_string(number);
  stage.channel = "channel" + std::to_string(dice.between(1, channels));
  stage.multicast_as =
      dice.pick<model::MulticastAs>({model::MulticastAs::unicast, model::MulticastAs::multicast});
  if (dice.chance(25)) stage.overhead_unicast = random_overhead(dice);
  if (dice.chance(25)) stage.overhead_multicast = random_overhead(dice);
  if (dice.chance(25)) stage.rate_unicast = random_rate(dice);
  if (dice.chance(25)) stage.rate_multicast = random_rate(dice);
  return stage;
}

void fill_route(Dice& dice, model::WirelessProfile& wireless) {
  if (dice.chance(30)) return;
  const std::uint32_t stages = dice.count(1, 4);
  const std::uint32_t channels = dice.count(1, 3);
  wireless.stages.clear();
  for (std::uint32_t k = 1; k <= stages; ++k) {
    wireless.stages.push_back(random_stage(dice, k, channels));
  }
}

void fill_losses(Dice& dice, model::WirelessProfile& wireless) {
  if (dice.chance(40)) return;
  std::set<std::uint64_t> lost;
  const auto range = dice.pick<std::int64_t>({20, 100, 400, 400});
  for (auto k = dice.pick<std::int64_t>({1, 3, 12, 40}); k > 0; --k) {
    lost.insert(static_cast<std::uint64_t>(dice.between(0, range)));
  }
  wireless.lost_packets.assign(lost.begin(), lost.end());
}

void fall_into_lockstep(Dice& dice, model::WirelessProfile& w, std::int64_t step) {
  w.overhead_unicast = Nanoseconds{step};
  w.overhead_multicast = Nanoseconds{step * dice.between(1, 2)};
  w.rate_unicast = lockstep_rate;
  w.rate_multicast = lockstep_rate;
  w.one_way = Nanoseconds{step * dice.between(0, 3)};
  for (model::Stage& stage : w.stages) {
    if (stage.overhead_unicast) stage.overhead_unicast = Nanoseconds{step * dice.between(1, 2)};
    if (stage.overhead_multicast) stage.overhead_multicast = Nanoseconds{step};
    if (stage.rate_unicast) stage.rate_unicast = lockstep_rate;
    if (stage.rate_multicast) stage.rate_multicast = lockstep_rate;
  }
}

}  // namespace

void fill_wireless(Dice& dice, model::WirelessProfile& w) {
  using Order = model::ServiceOrder;
  using Request = model::FragmentRequest;
  if (dice.chance(15)) w.kind = model::ServiceKind::constant_delay;
  w.one_way =
      Nanoseconds{dice.pick<std::int64_t>({0, 1, 100 * us, 1 * ms, dice.magnitude(1, 1 * s)})};
  if (dice.chance(60)) {
    w.overhead_unicast = random_overhead(dice);
    w.overhead_multicast = random_overhead(dice);
    w.rate_unicast = random_rate(dice);
    w.rate_multicast = random_rate(dice);
  }
  w.order = dice.pick<Order>(
      {Order::fifo_uplink, Order::fifo_downlink, Order::fifo, Order::datagram_uplink});
  w.fragment_request = dice.pick<Request>({Request::sequential, Request::at_admission});
  w.link_overhead_bytes = Bytes{dice.pick<std::int64_t>({38, 38, 0, 1, 100})};
  w.mtu_payload_bytes = Bytes{
      dice.pick<std::int64_t>({1'480, 1'480, 1'479, 577, 1'001, 65'535, dice.between(200, 3'000)})};
  w.source_queue_bytes =
      dice.pick<Bytes>({Bytes{212'992}, Bytes{212'992}, model::WirelessProfile::unlimited, Bytes{1},
                        Bytes{dice.between(100, 4'000)}, Bytes{dice.between(4'000, 40'000)}});
  fill_route(dice, w);
  fill_losses(dice, w);
}

Clock make_clock(Dice& dice, model::Scenario& scenario) {
  Clock clock;
  clock.lockstep = dice.chance(25);
  if (clock.lockstep) {
    clock.grid = dice.pick<std::int64_t>({10 * us, 100 * us});
    fall_into_lockstep(dice, scenario.wireless, clock.grid);
  }
  const bool delay = scenario.wireless.kind == model::ServiceKind::constant_delay;
  const std::int64_t work = delay ? 6 * scenario.wireless.one_way.count() : open_loop_ns(scenario);
  clock.scale = std::clamp(work, 200 * us, 4 * s);
  if (!clock.lockstep) {
    clock.grid = dice.pick<std::int64_t>({1, 1, 10 * us, 100 * us, clock.scale / 16});
  }
  return clock;
}

Nanoseconds reaction(Dice& dice, const Clock& clock, std::int64_t usual) {
  if (clock.lockstep) {
    return Nanoseconds{clock.grid * dice.pick<std::int64_t>({0, 0, 1, 1, 2, 5})};
  }
  const auto t = dice.pick<std::int64_t>({usual, usual, 0, 1, dice.magnitude(1, 1 * s),
                                          dice.magnitude(1, clock.scale), clock.scale / 16});
  return Nanoseconds{dice.chance(50) ? clock.on_grid(t) : t};
}

Nanoseconds period(Dice& dice, const Clock& clock) {
  const auto t = dice.pick<std::int64_t>(
      {clock.scale / 8, clock.scale, dice.magnitude(clock.scale / 10, 4 * clock.scale)});
  return Nanoseconds{clock.on_grid(t)};
}

}  // namespace stormproof::oracle
