// Edges of the rules: values at which limits, turns and timers meet.
#include "props/generators/on_demand.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>

#include "model/airtime.hpp"
#include "model/fastdds/types.hpp"
#include "model/implementations.hpp"
#include "model/life.hpp"
#include "model/servers.hpp"

namespace stormproof::props {

using namespace model;

void draw_units(Dice& dice, WirelessProfile& w) {
  w.kind = ServiceKind::shared_channel;
  w.packet_delays.clear();
  w.stages = WirelessProfile{}.stages;
  w.order = ServiceOrder::fifo_uplink;
  w.fragment_request = FragmentRequest::at_admission;
  w.service = ServedBy::unit;
  w.aggregation.max_frames = dice.pick<std::uint32_t>({64, 64, 1, 2, 3, 5});
  w.aggregation.max_bytes = Bytes{dice.among({65'535, 65'535, 280, 420, 600, 1'500, 4'000})};
  w.aggregation.max_airtime =
      Nanoseconds{dice.among({5'484'000, 5'484'000, 20'000, 100'000, 1'000'000, 0, 15'512})};
  w.aggregation.overhead = Nanoseconds{dice.among({198'500, w.overhead_unicast.count(), 0})};
  w.queueing = dice.chance(60) ? Queueing::flows : Queueing::fifo;
  w.quantum = Bytes{dice.among({300, 300, 134, 1, 67, 1'514})};
  w.ap_queue = dice.choice<ApQueue>(2);
  const bool may_be_oldest = w.queueing == Queueing::fifo && w.ap_queue == ApQueue::oldest;
  if (may_be_oldest && dice.chance(50)) w.arbitration = Arbitration::oldest;
}

void draw_radio(Dice& dice, WirelessProfile& w) {
  if (dice.chance(70)) draw_units(dice, w);
  w.source_queue_bytes =
      Bytes{dice.among({212'992, 1, 1'000, 4'000, dice.between(100, 4'000), 20'000})};
  w.sender = dice.chance(75) ? Sender::stalls : Sender::backlog;
  w.count_at = dice.choice<CountAt>(2);
}

void draw_fleet(Dice& dice, Deployment& deployment) {
  std::uint32_t hosts = 0;
  for (const Participant& p : deployment.participants) hosts = std::max(hosts, p.host.value + 1);
  deployment.hosts.clear();
  deployment.access_points.clear();
  const std::uint32_t points = dice.count(0, 3);
  for (std::uint32_t k = 0; k < points; ++k) {
    deployment.access_points.push_back(
        {"point" + std::to_string(k), dice.pick<std::string>({"36", "36", "40", "44"})});
  }
  const Nanoseconds beacon{dice.among({1'000'000, 3'000'000, 102'400'000})};
  const std::uint32_t dtim = dice.count(1, 3);
  hosts += dice.count(0, 1);  // one without participants
  for (std::uint32_t k = 0; k < hosts; ++k) {
    Host host;
    host.name = "host" + std::to_string(k);
    if (dice.chance(30)) host.link = Link::wired;
    const bool is_station = host.link == Link::wireless;
    if (is_station && points > 0 && dice.chance(80)) {
      host.access_point = "point" + std::to_string(dice.count(0, points - 1));
    }
    if (is_station && dice.chance(40)) {
      host.rate = BitsPerSecond{dice.among({6'000'000, 54'000'000, 866'700'000})};
    }
    if (is_station && dice.chance(25)) host.power_save = PowerSave{beacon, dtim};
    deployment.hosts.push_back(std::move(host));
  }
  if (dice.chance(30)) deployment.wired_delay = Nanoseconds{dice.among({1, 200'000, 5'000'000})};
}

void draw_frame_loss(Dice& dice, WirelessProfile& w) {
  FrameLoss loss;
  loss.probability = dice.pick<Ratio>({{1, 10}, {1, 3}, {1, 100}, {1, 2}});
  loss.retries = dice.pick<std::uint32_t>({7, 0, 1, 2});
  loss.seed = dice.count(0, 1'000);
  if (dice.chance(50)) {
    loss.bursts = LossBursts{dice.pick<Ratio>({{1, 20}, {1, 4}, {1, 100}}),
                             dice.pick<Ratio>({{1, 5}, {1, 2}, {1, 50}}),
                             dice.pick<Ratio>({{9, 10}, {1, 1}, {1, 2}})};
  }
  w.loss = loss;
}

void draw_queue(Dice& dice, WirelessProfile& w) {
  constexpr std::int64_t us = 1'000;
  QueueManagement queue;
  const bool of_flows = w.queueing == Queueing::flows;
  const bool measures = of_flows || dice.chance(50);
  queue.discipline = of_flows   ? QueueDiscipline::fq_codel
                     : measures ? QueueDiscipline::codel
                                : QueueDiscipline::tail_drop;
  queue.of = dice.choice<QueuesOf>(3);
  queue.target = Nanoseconds{dice.among({5'000, 0, 500, 2'000, 20'000}) * us};
  queue.interval = Nanoseconds{dice.among({100'000, 1'000, 3'000, 10'000}) * us};
  if (!measures || dice.chance(60)) {
    queue.max_frames = dice.pick<std::uint32_t>({1, 2, 5, 20, 100, dice.count(1, 300)});
  }
  if (dice.chance(30)) {
    queue.max_bytes =
        Bytes{std::max(dice.among({2'000, 8'000, 60'000}), Fragmentation{w}.longest())};
  }
  w.queue = queue;
}

void draw_processor(Dice& dice, Scenario& scenario) {
  constexpr std::int64_t us = 1'000;
  Processor processor;
  processor.cores = dice.count(1, 3);
  processor.reception = Nanoseconds{dice.among({0, 10, 100, 1'000}) * us};
  processor.emission = Nanoseconds{dice.among({0, 10, 100, 500}) * us};
  processor.submessage = Nanoseconds{dice.among({0, 5, 20, 100}) * us};
  processor.timer = Nanoseconds{dice.among({0, 20, 300}) * us};
  if (dice.chance(40)) {
    processor.deaf_min = Nanoseconds{dice.among({0, 500}) * us};
    processor.deaf_max = processor.deaf_min + Nanoseconds{dice.among({0, 2'000, 50'000}) * us};
    processor.deaf_seed = dice.count(0, 100);
  }
  scenario.hosts = processor;
}

void draw_discovery(std::uint64_t seed, Discovery discovery, Scenario& scenario) {
  scenario.dds.discovery = discovery;
  scenario.dds.sedp.heartbeat_policy = HeartbeatPolicy::periodic;
  scenario.time_limit = std::max(scenario.time_limit, Nanoseconds{3'000'000'000});
  constexpr std::int64_t ms = 1'000'000;
  const auto pick = [&](std::uint64_t salt, std::initializer_list<std::int64_t> values) {
    const std::uint64_t k = (seed * 7919 + salt * 104'729) / 3 % values.size();
    return values.begin()[k];
  };
  scenario.dds.peer_ports = static_cast<std::uint32_t>(pick(1, {1, 2, 4, 7}));
  ServerProfile& server = scenario.dds.server;
  server.client_sync_period = Nanoseconds{pick(2, {450, 60, 10, 150}) * ms};
  server.server_routine_period = Nanoseconds{pick(3, {450, 50, 7}) * ms};
  server.pdp_heartbeat_period = Nanoseconds{pick(4, {350, 30, 90}) * ms};
  server.pdp_nack_response_delay = Nanoseconds{pick(5, {100, 0, 3}) * ms};
  server.pdp_nack_suppression_duration = Nanoseconds{pick(6, {11, 0, 2}) * ms};
  server.pdp_heartbeat_response_delay = Nanoseconds{pick(7, {11, 1, 0}) * ms};
  server.relay = seed % 3 == 1 ? Relay::once : Relay::repeat;
  server.rejoin = seed % 2 == 1 ? Rejoin::known : Rejoin::dropped;
  server.known = pick(9, {0, 1}) == 1 ? ServerKnown::locator : ServerKnown::guid;
  scenario.deployment.send_cost = Nanoseconds{pick(8, {50, 0, 400}) * 1'000};
}

void draw_servers(Dice& dice, Scenario& scenario) {
  Deployment& deployment = scenario.deployment;
  const bool links = scenario.dds.server.known == ServerKnown::guid;
  const std::uint32_t count = dice.count(2, 3);
  for (std::uint32_t k = 0; k < count; ++k) {
    DiscoveryServer& server = deployment.servers.emplace_back();
    server.host = deployment.participants[dice.count(0, deployment.size() - 1)].host;
    for (std::uint32_t other = 0; links && other < count; ++other) {
      if (other != k && dice.chance(50)) server.servers.push_back(other);
    }
  }
  for (Participant& participant : deployment.participants) {
    for (std::uint32_t k = 0; k < count; ++k) {
      if (dice.chance(60)) participant.servers.push_back(k);
    }
  }
}

void draw_version(Dice& dice, DdsProfile& dds) {
  constexpr std::int64_t ms = 1'000'000;
  VersionProfile& version = dds.version;
  version.match_order = dice.choice<MatchOrder>(2);
  version.builtin_response_delay = Nanoseconds{dice.among({5, 11, 0, 1}) * ms};
  version.type_lookup = dice.chance(70) ? Whether::yes : Whether::no;
  version.sizes = dice.choice<SizesSince>(3);
  version.descriptor_extra_bytes = Bytes{dice.among({0, 92, 188, dice.between(1, 2'000)})};
  version.statistics_bytes = Bytes{dice.among({0, 60, 28, 1'000})};
  version.max_data_per_message = dice.pick<std::uint32_t>({0, 31, 1, 2, dice.count(1, 12)});
  if (dice.chance(60)) dds.sedp.piggyback = Piggyback::group;
}

void draw_types(Dice& dice, Scenario& scenario) {
  constexpr std::int64_t ms = 1'000'000;
  std::uint64_t most = Deployment::max_endpoints;
  for (const Participant& p : scenario.deployment.participants) {
    most = std::min(most, fastdds::endpoints_with_own_types(p));
  }
  const auto all = static_cast<std::uint32_t>(most);
  scenario.deployment.types =
      EndpointTypes{dice.pick<std::uint32_t>({0, 1, 2, std::min(12U, all), dice.count(0, all)})};
  VersionProfile& version = scenario.dds.version;
  if (dice.chance(60)) version.type_lookup = Whether::yes;
  version.typelookup_heartbeat_period = Nanoseconds{dice.among({350, 50, 10, 3}) * ms};
  version.type_object_bytes = Bytes{dice.among({300, 300, 1'400, dice.between(1, 9'000)})};
  if (dice.chance(50)) version.typelookup_filter = dice.choice<LookupFilter>(3);
  if (dice.chance(50)) version.typelookup_unit = dice.choice<LookupUnit>(3);
  if (version.typelookup_unit == LookupUnit::participant) {  // an answer is one message
    version.type_object_bytes = Bytes{dice.among({300, 900, dice.between(1, 900)})};
  }
  scenario.dds.sedp.piggyback_threshold_bytes =
      Bytes{dice.among({1'000, 3'000, 20'000, 106'496, 106'496})};
  scenario.wireless.lost_packets.clear();
  scenario.wireless.loss.reset();
  scenario.wireless.queue.reset();
  scenario.time_limit = std::max(scenario.time_limit, Nanoseconds{3'000 * ms});
}

namespace {
void draw_rules(Dice& dice, Amendments& rules) {
  const auto whether = [&] { return dice.choice<Whether>(2); };
  constexpr std::int64_t ms = 1'000'000;
  rules.initial_acknack_resets = whether();
  rules.initial_acknack_arms = whether();
  rules.initial_acknack_repeat = dice.choice<InitialAckNackRepeat>(4);
  rules.initial_acknack_stop = dice.choice<InitialAckNackStop>(2);
  rules.late_initial = dice.choice<LateInitial>(2);
  rules.acked_request = dice.choice<AckedRequest>(3);
  rules.heartbeat_condition = dice.choice<HeartbeatCondition>(2);
  rules.heartbeat_policy = dice.choice<AmendedPolicy>(2);
  rules.suppression_end_arms = whether();
  rules.repair_heartbeat = dice.choice<RepairHeartbeat>(3);
  rules.acknack_reply = dice.choice<AckNackReply>(3);
  rules.stale_acknack = dice.choice<StaleAckNack>(5);
  rules.count_filter = dice.pick<std::uint32_t>({0, 1, 3});
  rules.on_reannounce = dice.choice<OnReannounce>(3);
  rules.reader_retry = dice.choice<ReaderRetry>(3);
  rules.reader_retry_period = Nanoseconds{dice.among({3'000, 20, 1}) * ms};
  rules.reader_nack_delay = Nanoseconds{dice.among({0, 100, 5}) * ms};
  rules.resend_copies = dice.count(1, 4);
  rules.resend_copy_period = Nanoseconds{dice.among({1'000, 50, 1}) * ms};
  rules.piggyback_account = dice.choice<PiggybackAccount>(2);
  // A clock that is ahead ends the run if the initial ACKNACK is repeated at once until then.
  if (rules.initial_acknack_repeat == InitialAckNackRepeat::age_based_zero) return;
  rules.match_clock_skew = Nanoseconds{dice.among({0, 1'000, 100 * ms})};
}

/// Participants that are forgotten, and such as come back.
void draw_returns(Dice& dice, const std::vector<Participant>& all, Life& life) {
  constexpr std::int64_t ms = 1'000'000;
  if (dice.chance(50)) life.lease = Nanoseconds{dice.among({50, 700, 4'000}) * ms};
  for (std::uint32_t i = 0; i < all.size() && life.restarts.size() < 3; ++i) {
    if (dice.chance(20)) {
      life.leases.push_back({i, Nanoseconds{dice.among({30, 1'000, 9'000}) * ms}});
    }
    if (!dice.chance(25)) continue;
    const Nanoseconds stop = all[i].start + Nanoseconds{dice.among({0, 5, 90, 600}) * ms};
    const Nanoseconds start = stop + Nanoseconds{dice.among({1, 40, 800}) * ms};
    life.restarts.push_back({i, stop, start, dice.choice<Identity>(2)});
  }
}

/// Endpoints that are created while their participant is there, and some deleted.
void draw_endpoints(Dice& dice, const std::vector<Participant>& all, Life& life) {
  constexpr std::int64_t ms = 1'000'000;
  for (std::uint32_t i = 0; i < all.size() && life.endpoints.size() < 3; ++i) {
    if (!dice.chance(30)) continue;
    LateEndpoints late{i, dice.count(0, 2), dice.count(0, 2), all[i].start, {}};
    late.at += Nanoseconds{dice.among({0, 1, 60, 900}) * ms};
    if (dice.chance(40)) late.until = late.at + Nanoseconds{dice.among({1, 30, 700}) * ms};
    const auto is_there = [&](Nanoseconds time) { return !is_away(life, i, time); };
    if (is_there(late.at) && is_there(late.until.value_or(late.at))) {
      life.endpoints.push_back(late);
    }
  }
}

Life drawn_life(Dice& dice, const std::vector<Participant>& all) {
  constexpr std::int64_t ms = 1'000'000;
  const auto participants = static_cast<std::uint32_t>(all.size());
  // Of another host; there is one.
  const auto elsewhere = [&](std::uint32_t one) {
    std::uint32_t other = dice.count(0, participants - 1);
    while (all[other].host == all[one].host) other = (other + 1) % participants;
    return other;
  };
  Life life;
  for (std::uint32_t i = 0; i < participants && life.stale.size() < 3; ++i) {
    if (dice.chance(30)) life.stale.push_back({i, elsewhere(i)});
  }
  if (dice.chance(40)) {
    life.mute.push_back({dice.count(0, participants - 1),
                         Nanoseconds{dice.among({0, 10, 500}) * ms + dice.between(0, 3)}});
  }
  for (std::uint32_t k = dice.count(0, 2); k > 0; --k) {
    const std::uint32_t from = dice.count(0, participants - 1);
    const Nanoseconds start{dice.among({0, 3, 70, 400}) * ms};
    life.outages.push_back(
        {from, elsewhere(from), start, start + Nanoseconds{dice.among({1, 50, 2'000}) * ms}});
  }
  draw_returns(dice, all, life);
  return life;
}
}  // namespace

void draw_disturbances(Dice& dice, Scenario& scenario) {
  constexpr std::uint64_t first_packets = 60;
  WirelessProfile& wireless = scenario.wireless;
  wireless.one_way = Nanoseconds{dice.among({0, 1'000, 1'000'000, 1'000'000})};
  wireless.lost_packets.clear();
  wireless.packet_delays.clear();
  const int lost = static_cast<int>(dice.among({0, 10, 30, 60}));
  const int late = static_cast<int>(dice.among({0, 10, 30}));
  for (std::uint64_t packet = 0; packet < first_packets; ++packet) {
    if (dice.chance(lost)) {
      wireless.lost_packets.push_back(packet);
    } else if (dice.chance(late)) {
      wireless.packet_delays.push_back(
          {packet, Nanoseconds{0}, Nanoseconds{dice.magnitude(1'000, 4'000'000'000)}});
    }
  }
  if (!traits_of(scenario.dds).creates_endpoints_over_time) return;
  for (Participant& one : scenario.deployment.participants) {
    one.endpoints_done = one.start + Nanoseconds{dice.among({0, 100, 1'000, 3'000}) * 1'000'000};
  }
}

void draw_amendments(Dice& dice, Scenario& scenario) {
  Amendments rules;
  draw_rules(dice, rules);
  // HEARTBEATs in DATA have no number.
  if (dice.chance(50)) scenario.dds.sedp.piggyback = Piggyback::off;
  if (scenario.dds.sedp.piggyback != Piggyback::off) rules.stale_acknack = StaleAckNack::process;
  const SedpProfile& sedp = scenario.dds.sedp;
  if (sedp.heartbeat_policy == HeartbeatPolicy::adaptive ||
      sedp.heartbeat_timer == HeartbeatTimerKind::additive) {
    rules.heartbeat_policy = AmendedPolicy::of_the_profile;
  }
  scenario.dds.amendments = rules;
  draw_life(dice, scenario);
  if (dice.chance(15)) scenario.run_until = RunUntil::quiescence;
}

namespace {
/// A Discovery Server comes back under its name.
void draw_server(Dice& dice, std::uint32_t server, Life& life) {
  constexpr std::int64_t ms = 1'000'000;
  if (dice.chance(40)) {
    const Nanoseconds stop{dice.among({0, 100, 700, 1'500}) * ms};
    const Nanoseconds start = stop + Nanoseconds{dice.among({1, 300, 2'000}) * ms};
    life.restarts.push_back({server, stop, start, Identity::same});
  } else if (dice.chance(20)) {
    life.mute.push_back({server, Nanoseconds{dice.among({500, 2'000}) * ms}});
  }
  if (dice.chance(30)) life.leases.push_back({server, Nanoseconds{dice.among({300, 900}) * ms}});
  if (!life.lease && dice.chance(70)) life.lease = Nanoseconds{dice.among({200, 600, 1'500}) * ms};
}
/// Participants begin knowing nobody, and come back as somebody new.
void draw_with_servers(Dice& dice, const Deployment& deployment, Life& life) {
  life.stale.clear();
  for (Restart& restart : life.restarts) restart.identity = Identity::fresh;
  for (std::uint32_t k = 0; k < server_count(deployment); ++k) {
    draw_server(dice, deployment.size() + k, life);
  }
}
}  // namespace

void draw_life(Dice& dice, Scenario& scenario) {
  const std::vector<Participant>& all = scenario.deployment.participants;
  Life& life = scenario.deployment.life.emplace(drawn_life(dice, all));
  if (traits_of(scenario.dds).has_server) draw_with_servers(dice, scenario.deployment, life);
  if (scenario.dds.amendments) draw_endpoints(dice, all, life);
  if (!traits_of(scenario.dds).has_living_composition) return;
  for (Participant& one : scenario.deployment.participants) {
    if (dice.chance(20)) one.ready = one.start + Nanoseconds{dice.among({1, 30'000, 3'000'000})};
  }
}

}  // namespace stormproof::props
