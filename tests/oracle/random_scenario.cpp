// The generator of random scenarios. Sizes and the wireless profile come first; the open-loop
// airtime then gives the time scale of the scenario, and periods, starts and the time limit follow
// from that, so that neither all runs complete nor none, whatever the rates are.
#include "tests/oracle/random_scenario.hpp"

#include <algorithm>
#include <set>

#include "tests/oracle/oracle.hpp"
#include "tests/oracle/random_dice.hpp"

namespace stormproof::oracle {

namespace {

using model::Bytes;
using model::Nanoseconds;
using model::Scenario;

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t s = 1'000'000'000;

// So fast that the airtime of a fragment is its overhead alone, whatever its size.
constexpr model::BitsPerSecond lockstep_rate{100'000'000'000'000};

// Durations of one scenario: around a common scale, and multiples of a grid if ties are wanted. In
// lockstep everything, the airtimes included, takes a small multiple of the grid.
struct Clock {
  std::int64_t scale = 0;
  std::int64_t grid = 1;
  bool lockstep = false;

  [[nodiscard]] std::int64_t on_grid(std::int64_t t) const {
    return t == 0 ? 0 : std::max(grid, t / grid * grid);
  }
};

std::uint32_t random_endpoints(Dice& dice) {
  switch (dice.between(0, 3)) {
    case 0:
      return 0;
    case 1:
      return dice.count(1, 3);
    default:
      return dice.count(0, 20);
  }
}

void fill_deployment(Dice& dice, Scenario& scenario) {
  const std::uint32_t hosts = dice.count(2, 4);
  const std::uint32_t size = dice.pick<std::uint32_t>({dice.count(2, 7), dice.count(2, 7), 7});
  for (std::uint32_t i = 0; i < size; ++i) {
    model::Participant p;
    p.host.value = dice.count(0, hosts - 1);
    p.publications = random_endpoints(dice);
    p.subscriptions = random_endpoints(dice);
    scenario.deployment.participants.push_back(p);
  }
  if (!scenario.deployment.has_cross_host_pair()) {
    std::uint32_t& host = scenario.deployment.participants.back().host.value;
    host = host == 0 ? 1 : 0;
  }
}

void fill_descriptors(Dice& dice, Scenario& scenario) {
  model::DescriptorProfile& d = scenario.dds.descriptors;
  d.default_publications = dice.pick<std::uint32_t>({0, 1, 2, 9, 9, 9, 32, dice.count(0, 12)});
  d.default_subscriptions = dice.pick<std::uint32_t>({0, 1, 2, 8, 8, 8, 32, dice.count(0, 12)});
  if (dice.chance(50)) {
    const std::int64_t lo = dice.between(60, 1200);
    const std::int64_t hi = lo + dice.pick<std::int64_t>({0, 1, 7, 80, dice.between(0, 900)});
    d.default_bytes = {Bytes{lo}, Bytes{hi}};
    d.user_bytes =
        Bytes{dice.pick<std::int64_t>({lo, 60, 1472, 1480, 2000, dice.between(60, 1200)})};
  }
  for (const model::Participant& p : scenario.deployment.participants) {
    if (p.publications + p.subscriptions > 0) return;
  }
  if (d.default_publications + d.default_subscriptions == 0) d.default_publications = 1;
}

void fill_sizes(Dice& dice, Scenario& scenario) {
  model::SedpProfile& sedp = scenario.dds.sedp;
  sedp.grouping = dice.pick<model::Grouping>({model::Grouping::message, model::Grouping::message,
                                              model::Grouping::mtu, model::Grouping::single});
  sedp.grouping_limit_bytes =
      Bytes{dice.pick<std::int64_t>({65'500, 65'500, 1'472, 60, dice.between(500, 9'000)})};
  sedp.piggyback =
      dice.pick<model::Piggyback>({model::Piggyback::cumulative, model::Piggyback::cumulative,
                                   model::Piggyback::linear, model::Piggyback::off});
  sedp.piggyback_threshold_bytes = Bytes{dice.pick<std::int64_t>(
      {106'496, 106'496, 1, 5'000, 1'000'000'000'000, dice.magnitude(1, 100'000)})};
  if (dice.chance(70)) return;
  scenario.dds.spdp.payload_bytes = Bytes{dice.pick<std::int64_t>({1, 420, 1'472, 1'473, 3'000})};
  sedp.heartbeat_bytes = Bytes{dice.pick<std::int64_t>({1, 68, 100, dice.between(1, 2'000)})};
  sedp.acknack_bytes = Bytes{dice.pick<std::int64_t>({1, 64, 100, dice.between(1, 2'000)})};
  sedp.piggyback_heartbeat_bytes = Bytes{dice.pick<std::int64_t>({1, 32, 700})};
  sedp.shared_header_bytes = Bytes{dice.pick<std::int64_t>({0, 1, 36, 60})};
}

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
  const std::int64_t range = dice.pick<std::int64_t>({20, 100, 400, 400});
  for (std::int64_t k = dice.pick<std::int64_t>({1, 3, 12, 40}); k > 0; --k) {
    lost.insert(static_cast<std::uint64_t>(dice.between(0, range)));
  }
  wireless.lost_packets.assign(lost.begin(), lost.end());
}

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

void fill_protocol(Dice& dice, Scenario& scenario) {
  using Resend = model::SpdpResend;
  model::SedpProfile& p = scenario.dds.sedp;
  scenario.dds.spdp.resend = dice.pick<Resend>(
      {Resend::all_known, Resend::new_and_multicast, Resend::new_only, Resend::none});
  if (dice.chance(50)) p.relation_opening = model::RelationOpening::each_side;
  if (dice.chance(40)) p.initial_data = model::InitialData::pull;
  if (dice.chance(40)) p.unmatched = model::Unmatched::accept;
  p.initial_acknack = dice.pick<model::InitialAckNackReply>({model::InitialAckNackReply::bitmap,
                                                             model::InitialAckNackReply::heartbeat,
                                                             model::InitialAckNackReply::none});
  if (dice.chance(50)) p.acknowledge = model::Acknowledge::prefix;
  if (dice.chance(40)) p.heartbeat_timer = model::HeartbeatTimerKind::additive;
  if (dice.chance(40)) p.heartbeat_recipients = model::HeartbeatRecipients::matched;
  if (dice.chance(40)) p.heartbeat_policy = model::HeartbeatPolicy::adaptive;
}

// Gives every stage an airtime of one or two steps, so that service and timers meet all the time.
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

Clock make_clock(Dice& dice, Scenario& scenario) {
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

// A delay between cause and reaction: anything from nothing to a second, more often short.
Nanoseconds reaction(Dice& dice, const Clock& clock, std::int64_t usual) {
  if (clock.lockstep) {
    return Nanoseconds{clock.grid * dice.pick<std::int64_t>({0, 0, 1, 1, 2, 5})};
  }
  const std::int64_t t =
      dice.pick<std::int64_t>({usual, usual, 0, 1, dice.magnitude(1, 1 * s),
                               dice.magnitude(1, clock.scale), clock.scale / 16});
  return Nanoseconds{dice.chance(50) ? clock.on_grid(t) : t};
}

// A period: never so short that its events alone fill the run.
Nanoseconds period(Dice& dice, const Clock& clock) {
  const std::int64_t t = dice.pick<std::int64_t>(
      {clock.scale / 8, clock.scale, dice.magnitude(clock.scale / 10, 4 * clock.scale)});
  return Nanoseconds{clock.on_grid(t)};
}

void fill_timers(Dice& dice, const Clock& clock, model::DdsProfile& dds) {
  dds.spdp.period = period(dice, clock);
  dds.spdp.startup_period = period(dice, clock);
  dds.spdp.startup_announcements = dice.pick<std::uint32_t>({5, 5, 0, 1, 2});
  dds.sedp.heartbeat_period = period(dice, clock);
  dds.sedp.heartbeat_response_delay = reaction(dice, clock, 10 * us);
  dds.sedp.nack_response_delay = reaction(dice, clock, 100 * us);
  dds.sedp.nack_suppression_duration = reaction(dice, clock, 10 * us);
  dds.sedp.initial_acknack_delay = reaction(dice, clock, clock.scale / 4);
  model::AdaptiveProfile& adaptive = dds.sedp.adaptive;
  adaptive.min_period = period(dice, clock);
  adaptive.max_period = adaptive.min_period * dice.pick<std::int64_t>({1, 2, 10, 100});
  adaptive.epsilon_numerator = dice.pick<std::int64_t>({1, 1, 1, 2, 3});
  adaptive.epsilon_denominator = dice.pick<std::int64_t>({20, 20, 3, 4, 7, 1'000});
}

void fill_starts(Dice& dice, const Clock& clock, Scenario& scenario) {
  const std::vector<std::int64_t> starts{0, 0, clock.on_grid(clock.scale / 4),
                                         clock.on_grid(dice.magnitude(1, clock.scale)),
                                         clock.on_grid(clock.scale)};
  const bool together = dice.chance(40);
  std::int64_t latest = 0;
  for (model::Participant& p : scenario.deployment.participants) {
    if (!together) p.start = Nanoseconds{dice.pick(starts)};
    latest = std::max(latest, p.start.count());
  }
  const std::int64_t limit = latest + clock.scale * dice.pick<std::int64_t>({1, 2, 4, 8, 16}) / 2;
  scenario.time_limit = Nanoseconds{std::clamp(limit, 1 * ms, 20 * s)};
}

}  // namespace

Scenario random_scenario(std::uint64_t seed) {
  Dice dice{seed};
  Scenario scenario;
  fill_deployment(dice, scenario);
  fill_descriptors(dice, scenario);
  fill_sizes(dice, scenario);
  fill_wireless(dice, scenario.wireless);
  fill_protocol(dice, scenario);
  const Clock clock = make_clock(dice, scenario);
  fill_timers(dice, clock, scenario.dds);
  fill_starts(dice, clock, scenario);
  return scenario;
}

}  // namespace stormproof::oracle
