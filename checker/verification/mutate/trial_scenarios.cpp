// Builds the trial scenarios.
#include "checker/verification/mutate/trial_scenarios.hpp"

#include "model/implementations.hpp"

namespace stormproof::mutate {

namespace {

using model::Bytes;
using model::Nanoseconds;

constexpr Nanoseconds ms(std::int64_t count) { return Nanoseconds{count * 1'000'000}; }

/// Two hosts with one participant each, three descriptors one way and one the other, a constant
/// delay of 1 ms, and the packets with these numbers lost.
model::Scenario quiet(std::vector<std::uint64_t> lost) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 3);
  scenario.dds.descriptors.default_publications = 1;
  scenario.dds.descriptors.default_subscriptions = 0;
  scenario.dds.sedp.piggyback = model::Piggyback::off;
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = ms(1);
  scenario.wireless.lost_packets = std::move(lost);
  scenario.time_limit = ms(12'000);
  return scenario;
}

/// A shared channel with a source queue that takes two packets.
model::Scenario crowded() {
  model::Scenario scenario = quiet({});
  scenario.deployment = model::Deployment::homogeneous(2, 2, 4);
  scenario.dds.sedp.piggyback = model::Piggyback::cumulative;
  scenario.dds.sedp.grouping = model::Grouping::mtu;
  scenario.wireless.kind = model::ServiceKind::shared_channel;
  scenario.wireless.source_queue_bytes = Bytes{2'000};
  return scenario;
}

/// Rules that recover when somebody has forgotten somebody.
model::Amendments repaired() {
  model::Amendments rules;
  rules.initial_acknack_resets = model::Whether::yes;
  rules.initial_acknack_arms = model::Whether::yes;
  rules.initial_acknack_stop = model::InitialAckNackStop::complete;
  rules.match_clock_skew = ms(200);
  return rules;
}

/// Participants that may forget, fall silent or come back, each on its host, with one publication.
model::Scenario amended(std::uint32_t participants) {
  model::Scenario scenario = quiet({});
  scenario.deployment = model::Deployment::homogeneous(participants, 1, 0);
  scenario.dds.spdp.startup_announcements = 0;
  scenario.dds.spdp.resend = model::SpdpResend::new_only;
  model::SedpProfile& sedp = scenario.dds.sedp;
  sedp.relation_opening = model::RelationOpening::each_side;
  sedp.initial_data = model::InitialData::pull;
  sedp.unmatched = model::Unmatched::drop;
  sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  sedp.acknowledge = model::Acknowledge::prefix;
  sedp.heartbeat_recipients = model::HeartbeatRecipients::matched;
  scenario.dds.amendments = repaired();
  scenario.deployment.life.emplace();
  scenario.run_until = model::RunUntil::time_limit;
  return scenario;
}

/// Participant 1 has forgotten 0, and hears of everything from 2.
model::Scenario forgotten() {
  model::Scenario scenario = amended(3);
  scenario.deployment.life->stale = {{0, 1}, {1, 2}, {2, 1}};
  scenario.dds.sedp.piggyback = model::Piggyback::linear;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{400};
  return scenario;
}

/// 2 is dead when 1 joins, and the first DATA to 1 is lost if periods follow the slowest reader.
model::Scenario dead() {
  model::Scenario scenario = amended(3);
  scenario.dds.spdp.period = ms(200);
  scenario.deployment.participants[1].start = ms(7'300);
  scenario.deployment.participants[1].endpoints_done = ms(7'300);
  scenario.deployment.life->mute = {{2, Nanoseconds{500'000}}};
  scenario.wireless.lost_packets = {105};
  scenario.dds.amendments->late_initial = model::LateInitial::ignore_after_ack;
  scenario.time_limit = ms(20'000);
  return scenario;
}

/// An initial ACKNACK comes when the reader is complete.
model::Scenario late() {
  model::Scenario scenario = amended(2);
  scenario.wireless.packet_delays = {
      model::PacketDelay{.packet = 6, .leaves_after = {}, .one_way = ms(71)},
      model::PacketDelay{.packet = 12, .leaves_after = {}, .one_way = ms(1'050)}};
  scenario.dds.amendments->initial_acknack_stop = model::InitialAckNackStop::any_heartbeat;
  scenario.dds.amendments->late_initial = model::LateInitial::ignore_after_ack;
  return scenario;
}

/// So many descriptors that DATA fills the budget between two HEARTBEATs several times.
model::Scenario charged() {
  model::Scenario scenario = amended(2);
  scenario.deployment.participants[0].publications = 60;
  model::SedpProfile& sedp = scenario.dds.sedp;
  sedp.relation_opening = model::RelationOpening::receiver;
  sedp.initial_data = model::InitialData::push;
  sedp.grouping = model::Grouping::single;
  sedp.piggyback = model::Piggyback::linear;
  sedp.piggyback_threshold_bytes = Bytes{20'000};
  scenario.time_limit = ms(4'000);
  return scenario;
}

std::vector<Trial> trials_of(model::Of<fsm::composition::paper::Paper>) {
  std::vector<Trial> list;
  list.push_back({"one loss", quiet({6}), true});
  list.push_back({"many losses", quiet({4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 16, 18, 20}), false});
  model::Scenario pull = quiet({});
  pull.dds.sedp.initial_data = model::InitialData::pull;
  pull.dds.sedp.relation_opening = model::RelationOpening::each_side;
  pull.dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  pull.dds.sedp.acknowledge = model::Acknowledge::prefix;
  pull.dds.sedp.heartbeat_recipients = model::HeartbeatRecipients::matched;
  list.push_back({"pull", pull, false});
  model::Scenario adaptive = quiet({4, 5, 6, 7});
  adaptive.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  list.push_back({"adaptive", adaptive, false});
  list.push_back({"crowded", crowded(), false});
  model::Scenario lossless = quiet({});  // a repair after discovery is needless, too
  lossless.run_until = model::RunUntil::time_limit;
  list.push_back({"no loss", lossless, false});
  list.push_back({"forgotten", forgotten(), false});
  list.push_back({"dead", dead(), false});
  list.push_back({"late", late(), false});
  list.push_back({"charged", charged(), false});
  return list;
}

/// Endpoints come into being one after the other.
model::Scenario created_over_time(model::Scenario scenario) {
  scenario.dds.descriptors = {};
  scenario.dds.spdp.payload_bytes = Bytes{252};
  std::int64_t done = 20;
  for (model::Participant& participant : scenario.deployment.participants) {
    participant.endpoints_done = ms(done += 15);
  }
  return scenario;
}

std::vector<Trial> trials_of(model::Of<fsm::composition::fastdds::FastDds>) {
  std::vector<Trial> list;
  model::Scenario quiet_scenario = quiet({10, 25});
  model::Scenario lossy = quiet({8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 48, 52, 56, 60});
  model::Scenario crowd = crowded();
  crowd.dds.sedp.grouping = model::Grouping::message;
  list.push_back({"two losses", created_over_time(std::move(quiet_scenario)), true});
  list.push_back({"many losses", created_over_time(std::move(lossy)), false});
  list.push_back({"crowded", created_over_time(std::move(crowd)), false});
  return list;
}

/// Runs show its mistakes, and the more the shorter its timers are.
std::vector<Trial> trials_of(model::Of<fsm::composition::cyclone::Cyclone>) {
  model::Scenario hasty = quiet({4, 5, 6, 8, 9, 11, 14, 17, 20, 23, 26, 29, 35, 40, 45});
  model::SedpProfile& sedp = hasty.dds.sedp;
  sedp.heartbeat_interval = ms(5);
  sedp.heartbeat_interval_max = ms(40);
  sedp.nack_delay = ms(6);
  sedp.ack_delay = ms(2);
  sedp.auto_resched_nack_delay = ms(15);
  hasty.time_limit = ms(2'000);
  model::Scenario crowd = crowded();
  crowd.dds.allow_multicast = model::AllowMulticast::always;
  crowd.time_limit = ms(4'000);
  hasty = created_over_time(std::move(hasty));
  model::Participant& late = hasty.deployment.participants[1];  // the other one exists by then
  late.start = ms(60);
  late.endpoints_done = ms(90);
  std::vector<Trial> list;
  list.push_back({"two losses", created_over_time(quiet({6, 15})), true});
  list.push_back({"many losses", std::move(hasty), false});
  list.push_back({"crowded", created_over_time(std::move(crowd)), false});
  return list;
}

/// Clients of a server on the host of two of them, and super clients, with losses; and clients of
/// one server each, of which one looks for the other.
std::vector<Trial> trials_of(model::Of<fsm::composition::server::FastDdsServer>) {
  const auto with_server = [](model::Discovery discovery, model::Scenario scenario) {
    scenario.deployment.participants[1].start = ms(460);  // the others know the server then
    scenario = created_over_time(std::move(scenario));
    scenario.deployment.participants[1].endpoints_done = ms(500);
    scenario.dds.discovery = discovery;
    scenario.time_limit = ms(4'000);
    return scenario;
  };
  model::Scenario lossy = quiet({12, 25, 40, 41, 60, 80, 100, 101, 130, 160});
  lossy.deployment = model::Deployment::homogeneous(2, 2, 1);
  model::Scenario few = quiet({7, 30});
  model::Scenario linked = quiet({50, 90});
  linked.deployment.servers = {{model::HostId{0}, {}}, {model::HostId{1}, {0}}};
  linked.deployment.participants[0].servers = {0};
  linked.deployment.participants[1].servers = {1};
  return {{"clients", with_server(model::Discovery::server, std::move(lossy)), false},
          {"super clients", with_server(model::Discovery::super_client, std::move(few)), false},
          {"linked servers", with_server(model::Discovery::server, std::move(linked)), false}};
}

}  // namespace

std::vector<Trial> trials(model::ImplementationKind implementation) {
  std::vector<Trial> list = model::visit_composition(
      implementation, [](auto composition) { return trials_of(composition); });
  for (Trial& trial : list) {
    trial.scenario.dds.implementation = model::implementation_of(implementation);
  }
  return list;
}

}  // namespace stormproof::mutate
