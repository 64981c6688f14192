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
  return list;
}

std::vector<Trial> trials_of(model::Of<fsm::composition::fastdds::FastDds>) {
  const auto created_over_time = [](model::Scenario scenario) {
    scenario.dds.spdp.payload_bytes = Bytes{252};
    std::int64_t done = 20;
    for (model::Participant& participant : scenario.deployment.participants) {
      participant.endpoints_done = ms(done += 15);
    }
    return scenario;
  };
  std::vector<Trial> list;
  model::Scenario quiet_scenario = quiet({10, 25});
  quiet_scenario.dds.descriptors = {};
  model::Scenario lossy = quiet({8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 48, 52, 56, 60});
  lossy.dds.descriptors = {};
  model::Scenario crowd = crowded();
  crowd.dds.descriptors = {};
  crowd.dds.sedp.grouping = model::Grouping::message;
  list.push_back({"two losses", created_over_time(std::move(quiet_scenario)), true});
  list.push_back({"many losses", created_over_time(std::move(lossy)), false});
  list.push_back({"crowded", created_over_time(std::move(crowd)), false});
  return list;
}

/// Their mistakes are not in the catalogue.
std::vector<Trial> trials_of(model::Of<fsm::composition::server::FastDdsServer>) { return {}; }
std::vector<Trial> trials_of(model::Of<fsm::composition::cyclone::Cyclone>) { return {}; }

}  // namespace

std::vector<Trial> trials(model::ImplementationKind implementation) {
  std::vector<Trial> list = model::visit_composition(
      implementation, [](auto composition) { return trials_of(composition); });
  for (Trial& trial : list) trial.scenario.dds.implementation = implementation;
  return list;
}

}  // namespace stormproof::mutate
