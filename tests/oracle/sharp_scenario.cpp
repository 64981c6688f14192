// The edges, one function each.
#include "tests/oracle/sharp_scenario.hpp"

#include <algorithm>

#include "props/generators/dice.hpp"
#include "props/generators/on_demand.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof::oracle {

namespace {

using model::Bytes;
using model::Nanoseconds;
using model::Scenario;
using props::Dice;

constexpr std::int64_t ms = 1'000'000;

void lose(Dice& dice, Scenario& s, int percent, std::uint64_t packets) {
  s.wireless.lost_packets.clear();
  for (std::uint64_t k = 0; k < packets; ++k) {
    if (dice.chance(percent)) s.wireless.lost_packets.push_back(k);
  }
}

// A constant delay without losses, short timers around it, and a run that goes on.
std::int64_t calm_down(Dice& dice, Scenario& s) {
  const std::int64_t delay = dice.between(1, 3) * ms;
  s.wireless.kind = model::ServiceKind::constant_delay;
  s.wireless.one_way = Nanoseconds{delay};
  s.wireless.lost_packets.clear();
  s.wireless.packet_delays.clear();
  s.dds.sedp.heartbeat_response_delay = Nanoseconds{dice.between(0, 2) * 10'000};
  s.dds.sedp.heartbeat_period = Nanoseconds{delay * dice.between(2, 5)};
  s.run_until = model::RunUntil::time_limit;
  s.time_limit = Nanoseconds{120 * delay};
  for (model::Participant& p : s.deployment.participants) {
    const std::int64_t start = std::min(p.start.count(), 10 * delay);
    p.start = Nanoseconds{start};
    p.endpoints_done = Nanoseconds{start + delay * dice.between(0, 10)};
  }
  return delay;
}

// Single packets take longer than the ones after them, or leave later: an old ACKNACK comes after a
// new one, an initial one after both.
void overtake(Dice& dice, Scenario& s) {
  const std::int64_t delay = calm_down(dice, s);
  const int percent = dice.pick<int>({20, 40, 60});
  for (std::uint64_t packet = 0; packet < 1'500; ++packet) {
    if (!dice.chance(percent)) continue;
    const std::int64_t one_way = delay * dice.between(0, 32) / 2;
    const Nanoseconds leaves{dice.pick<std::int64_t>({0, one_way, one_way / 2})};
    s.wireless.packet_delays.push_back({packet, leaves, Nanoseconds{one_way}});
  }
  s.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::periodic;
  s.dds.sedp.initial_acknack_delay = Nanoseconds{dice.between(1, 3) * delay};
}

// The HEARTBEAT's answer is there in the very instant in which the cycle ends.
void answer_at_the_end(Dice& dice, Scenario& s) {
  const std::int64_t delay = calm_down(dice, s);
  s.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  s.dds.sedp.heartbeat_period = Nanoseconds{2 * delay} + s.dds.sedp.heartbeat_response_delay;
  s.dds.sedp.adaptive.min_period = Nanoseconds{1};
  lose(dice, s, 40, 80);
}

// Periods that the number of answers does not divide, stretched without a bound.
void odd_periods(Dice& dice, Scenario& s) {
  while (s.deployment.participants.size() < 6) {
    model::Participant another = s.deployment.participants.front();
    another.host.value += 1;
    s.deployment.participants.push_back(another);
  }
  const std::int64_t delay = calm_down(dice, s);
  s.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  s.dds.sedp.heartbeat_period = Nanoseconds{4 * delay + 1};
  s.dds.sedp.adaptive.min_period = Nanoseconds{1};
  s.dds.sedp.adaptive.max_period = Nanoseconds{1'000 * delay};
  lose(dice, s, 40, 300);
}

// The budget is exactly used up by one descriptor or by two.
void exact_budget(Dice& dice, Scenario& s) {
  s.dds.sedp.piggyback =
      dice.pick<model::Piggyback>({model::Piggyback::cumulative, model::Piggyback::linear});
  const Bytes first = s.dds.descriptors.default_bytes[0];
  s.dds.descriptors.default_bytes[1] = first;
  s.dds.descriptors.user_bytes = first;
  s.dds.sedp.shared_header_bytes = Bytes{0};
  s.dds.sedp.piggyback_threshold_bytes = first * dice.between(1, 4);
}

// An ACKNACK with a bitmap has two fragments, one without has one and overtakes it.
void two_fragments(Dice& dice, Scenario& s) {
  s.wireless.kind = model::ServiceKind::shared_channel;
  s.wireless.fragment_request = model::FragmentRequest::sequential;
  s.wireless.mtu_payload_bytes = s.dds.sedp.acknack_bytes + Bytes{dice.between(8, 11)};
  s.dds.sedp.heartbeat_response_delay = Nanoseconds{dice.between(0, 1)};
}

}  // namespace

Scenario sharpened(Scenario scenario, std::uint64_t seed) {
  constexpr void (*edges[])(Dice&, Scenario&) = {overtake,    overtake,     answer_at_the_end,
                                                 odd_periods, exact_budget, two_fragments};
  Dice dice{seed};
  edges[dice.between(0, static_cast<std::int64_t>(std::size(edges)) - 1)](dice, scenario);
  return scenario;
}

namespace {
Scenario varied(Scenario scenario, std::uint64_t seed) {
  if (seed % 2 == 1) scenario = sharpened(std::move(scenario), seed);
  if (seed % 4 == 3) scenario.run_until = model::RunUntil::time_limit;
  return scenario;
}
}  // namespace

Scenario varied_scenario(std::uint64_t seed) { return varied(random_scenario(seed), seed); }

Scenario varied_fastdds_scenario(std::uint64_t seed) {
  return varied(random_fastdds_scenario(seed), seed);
}

Scenario random_version_scenario(std::uint64_t seed) {
  using enum model::Discovery;
  constexpr model::Discovery ways[] = {static_peers, server, super_client};
  Scenario scenario = random_fastdds_scenario(seed);
  Dice dice{seed};
  if (seed % 3 == 0) props::draw_discovery(seed, ways[dice.count(0, 2)], scenario);
  props::draw_version(dice, scenario.dds);
  return scenario;
}

Scenario random_lookup_scenario(std::uint64_t seed) {
  Scenario scenario = random_fastdds_scenario(seed);
  Dice dice{seed};
  if (seed % 3 == 0) props::draw_discovery(seed, model::Discovery::static_peers, scenario);
  if (dice.chance(70)) props::draw_version(dice, scenario.dds);
  props::draw_types(dice, scenario);
  if (dice.chance(30)) scenario.run_until = model::RunUntil::time_limit;
  return scenario;
}

Scenario random_mixed_scenario(std::uint64_t seed) {
  Scenario scenario = random_fastdds_scenario(seed);
  Dice dice{seed + 77};
  if (seed % 4 == 0) scenario = random_lookup_scenario(seed);
  if (seed % 4 == 1) props::draw_discovery(seed, model::Discovery::static_peers, scenario);
  if (seed % 4 == 3) props::draw_version(dice, scenario.dds);
  std::vector<model::DdsProfile> others;
  for (std::uint32_t k = 0; k < dice.count(1, 3); ++k) {
    model::DdsProfile& other = others.emplace_back(random_fastdds_scenario(dice.count(0, 999)).dds);
    if (dice.chance(80)) props::draw_version(dice, other);
    other.discovery = scenario.dds.discovery;
    other.peer_ports = dice.count(1, 6);
    other.version.typelookup_unit = scenario.dds.version.typelookup_unit;
  }
  for (model::Participant& participant : scenario.deployment.participants) {
    if (!dice.chance(60)) continue;
    const auto most = static_cast<std::uint32_t>(others.size()) - 1;
    participant.dds = others[dice.count(0, most)];
  }
  return scenario;
}

Scenario varied_version_scenario(std::uint64_t seed) {
  return varied(random_version_scenario(seed), seed);
}

Scenario varied_server_scenario(std::uint64_t seed) {
  using enum model::Discovery;
  Scenario scenario = random_fastdds_scenario(seed);
  props::draw_discovery(seed, seed % 3 == 0 ? super_client : server, scenario);
  if (seed % 5 == 4) draw_unlinked_servers(seed, scenario);
  return varied(std::move(scenario), seed);
}

void draw_unlinked_servers(std::uint64_t seed, Scenario& scenario) {
  Dice dice{seed};
  props::draw_servers(dice, scenario);
  for (model::DiscoveryServer& one : scenario.deployment.servers) one.servers.clear();
}

// Every other one is small, on a channel with short packets, and loses many: what is asked for
// again, refused or answered twice happens then.
Scenario varied_cyclone_scenario(std::uint64_t seed) {
  Scenario scenario = random_cyclone_scenario(seed);
  if (seed % 2 == 1) {
    Dice dice{seed};
    constexpr std::int64_t us = 1'000;
    scenario.wireless.kind = model::ServiceKind::constant_delay;
    scenario.wireless.one_way = Nanoseconds{dice.between(1, 3) * 100 * us};
    scenario.wireless.packet_delays.clear();
    lose(dice, scenario, dice.pick<int>({0, 20, 50}), 400);
    scenario.dds.sedp = {};
    scenario.dds.sedp.heartbeat_interval = Nanoseconds{dice.between(1, 6) * ms};
    scenario.dds.sedp.heartbeat_interval_max = Nanoseconds{dice.among({4, 8, 40}) * ms};
    scenario.dds.sedp.nack_delay = Nanoseconds{dice.between(0, 6) * ms};
    scenario.dds.sedp.ack_delay = Nanoseconds{dice.between(0, 3) * ms};
    scenario.dds.sedp.auto_resched_nack_delay = Nanoseconds{dice.between(5, 30) * ms};
    scenario.dds.sedp.max_queued_rexmit_messages = dice.pick<std::uint32_t>({200, 2, 5});
    scenario.deployment.send_time = Nanoseconds{dice.among({0, 20, 200}) * us};
    scenario.time_limit =
        Nanoseconds{std::max<std::int64_t>(scenario.time_limit.count(), 200 * ms)};
  }
  if (seed % 5 == 2) {
    Dice dice{seed + 1};
    props::draw_processor(dice, scenario);
  }
  if (seed % 4 == 3) scenario.run_until = model::RunUntil::time_limit;
  return scenario;
}

Scenario varied_wifi_scenario(std::uint64_t seed) {
  Scenario scenario = random_fastdds_scenario(seed);
  Dice dice{seed + 1};
  model::WirelessProfile& w = scenario.wireless;
  w.kind = model::ServiceKind::shared_channel;
  w.packet_delays.clear();
  props::draw_radio(dice, w);
  if (dice.chance(50)) scenario.run_until = model::RunUntil::time_limit;
  if (dice.chance(50)) {
    for (model::Participant& p : scenario.deployment.participants) {
      p.endpoints_done = p.start + Nanoseconds{dice.between(0, 40) * ms};
    }
    scenario.dds.sedp.piggyback_threshold_bytes = Bytes{dice.among({500, 2'000, 10'000})};
    scenario.time_limit = Nanoseconds{std::max(scenario.time_limit.count(), 500 * ms)};
  }
  return scenario;
}

Scenario varied_fleet_scenario(std::uint64_t seed) {
  Scenario scenario = varied_wifi_scenario(seed);
  Dice dice{seed + 2};
  model::WirelessProfile& w = scenario.wireless;
  if (dice.chance(50)) {
    w.service = model::ServedBy::frame;
    w.fragment_request = dice.choice<model::FragmentRequest>(2);
  }
  if (w.service == model::ServedBy::frame) {
    w.stages = model::WirelessProfile{}.stages;
    w.order = dice.choice<model::ServiceOrder>(4);
    if (dice.chance(30)) w.stages.back().channel = "another";
    if (dice.chance(30)) w.stages.back().rate_unicast = model::BitsPerSecond{8'000'000};
    if (dice.chance(20)) w.stages.back().multicast_as = model::MulticastAs::unicast;
    if (dice.chance(20)) w.stages.front().multicast_as = model::MulticastAs::multicast;
  }
  const auto drawn = dice.between(1, 7);
  if ((drawn & 1) != 0) props::draw_fleet(dice, scenario.deployment);
  if ((drawn & 2) != 0) props::draw_frame_loss(dice, w);
  if ((drawn & 4) != 0) props::draw_processor(dice, scenario);
  return scenario;
}

Scenario varied_queue_scenario(std::uint64_t seed) {
  Scenario scenario = varied_fleet_scenario(seed);
  Dice dice{seed + 3};
  if (scenario.wireless.service == model::ServedBy::frame) {
    scenario.wireless.arbitration = model::Arbitration::round_robin;
    props::draw_units(dice, scenario.wireless);
  }
  props::draw_queue(dice, scenario.wireless);
  return scenario;
}

namespace {

/// Packets between hosts, of which `together` of a hundred come at the time of the one before.
void draw_packets(Dice& dice, std::int64_t count, int together, std::int64_t pause,
                  PacketList& list) {
  std::int64_t time = 0;
  for (std::int64_t k = count; k > 0; --k) {
    if (dice.chance(100 - together)) time += dice.between(0, pause);
    vectors::ChannelPacket packet;
    packet.time_ns = time;
    packet.source = dice.count(0, list.hosts - 1);
    if (dice.chance(85)) {
      packet.destination = (packet.source + dice.count(1, list.hosts - 1)) % list.hosts;
    }
    packet.payload_bytes = static_cast<std::uint32_t>(
        dice.among({68, 68, 52, 69, 71, 252, 420, 1'472, 1'473, 5'000, dice.between(1, 9'000)}));
    if (packet.destination) packet.port = static_cast<std::uint8_t>(dice.between(0, 3));
    list.packets.push_back(packet);
  }
}

}  // namespace

PacketList random_packet_list(std::uint64_t seed) {
  Dice dice{seed};
  PacketList list;
  props::draw_units(dice, list.wireless);
  list.wireless.source_queue_bytes = Bytes{dice.among({212'992, 212'992, 1, 300, 2'000})};
  list.hosts = dice.count(2, 4);
  draw_packets(dice, dice.between(1, 40), 60, 400'000, list);
  return list;
}

PacketList random_queue_list(std::uint64_t seed) {
  Dice dice{seed};
  PacketList list;
  props::draw_units(dice, list.wireless);
  props::draw_queue(dice, list.wireless);
  list.wireless.source_queue_bytes = Bytes{dice.among({212'992, 212'992, 1, 2'000, 20'000})};
  list.hosts = dice.count(2, 4);
  const std::int64_t pause = dice.among({400'000, 1'500'000});
  draw_packets(dice, dice.between(20, 200), 70, pause, list);
  return list;
}

}  // namespace stormproof::oracle
