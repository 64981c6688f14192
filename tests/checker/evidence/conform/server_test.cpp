// Captures of clients with a Discovery Server and of their simulated runs conform to their profile,
// with losses, too, and a knob that acts in a run is noticed when it is changed.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "checker/evidence/conform/changes.hpp"
#include "model/composition_of.hpp"
#include "props/generators/scenarios.hpp"
#include "tests/checker/evidence/conform/captures.hpp"
#include "tests/checker/evidence/conform/fault_cases.hpp"
#include "tests/vectors/discovery_vectors.hpp"

namespace stormproof::conform::testing {
namespace server_test {

constexpr std::int64_t ms = 1'000'000;

model::DdsProfile of_server(const std::string& name, bool is_super) {
  model::DdsProfile dds = profile(name);
  dds.discovery = is_super ? model::Discovery::super_client : model::Discovery::server;
  return dds;
}

model::Nanoseconds times(model::Nanoseconds timer, std::int64_t numerator,
                         std::int64_t denominator = 1) {
  return model::Nanoseconds{timer.count() * numerator / denominator};
}

struct Shipped {
  const char* name;
  const char* profile;
  bool is_super = false;
};
std::ostream& operator<<(std::ostream& out, const Shipped& one) { return out << one.name; }

class ServerCapture : public ::testing::TestWithParam<Shipped> {};

/// Not to the other kind of clients, nor to a tick or delays of another version.
TEST_P(ServerCapture, ConformsToItsProfile) {
  const auto& [name, preset, is_super] = GetParam();
  const auto conversation = shipped(std::string{"discovery-server/"} + name);
  const Conformance own = conformance(conversation, of_server(preset, is_super));
  EXPECT_TRUE(is_explained(own)) << description(own);
  EXPECT_GT(own.checked, 70U);
  EXPECT_EQ(own.lost, 0U);
  EXPECT_EQ(conformance(conversation, of_server(preset, !is_super)).verdict,
            Verdict::does_not_conform);
  EXPECT_EQ(conformance(conversation, profile("fastdds-2.6.11")).verdict,
            Verdict::does_not_conform);
  model::DdsProfile other = of_server(preset, is_super);
  other.server.client_sync_period = times(other.server.client_sync_period, 2);
  EXPECT_EQ(conformance(conversation, other).verdict, Verdict::does_not_conform);
  if (std::string_view{preset} != "fastdds-server-2.14.5") {
    const Conformance later =
        conformance(conversation, of_server("fastdds-server-2.14.5", is_super));
    EXPECT_EQ(later.verdict, Verdict::does_not_conform);
  }
}
INSTANTIATE_TEST_SUITE_P(
    Shipped, ServerCapture,
    ::testing::Values(Shipped{"fastdds2145_ap150_client_np1_ne2_r0", "fastdds-server-2.14.5"},
                      Shipped{"fastdds291_ap150_client_np1_ne2_r0", "fastdds-server-2.6.11"},
                      Shipped{"fastdds291_ap150_client_np3_ne20_r0", "fastdds-server-2.6.11"},
                      Shipped{"fastdds291_ap150_super_np1_ne2_r0", "fastdds-server-2.6.11", true}),
    [](const auto& one) { return std::string{one.param.name}; });

TEST(Server, NoCaptureWithoutOneConforms) {
  for (const char* name : {"fastdds2611_ap150_np1_ne2_r0", "cyclone0102_veth_np2_ne20_r0"}) {
    const Conformance result = conformance(shipped(name), profile("fastdds-server-2.6.11"));
    ASSERT_EQ(result.verdict, Verdict::does_not_conform) << name;
    EXPECT_EQ(result.unexplained.front().fault, Fault::no_such_rule) << name;
  }
}

std::vector<vectors::DiscoveryVector> vectors_with_server() {
  std::vector<vectors::DiscoveryVector> list = vectors::discovery_vectors();
  std::erase_if(list, [](const auto& one) {
    return one.scenario.dds.discovery == model::Discovery::static_peers;
  });
  return list;
}
class ServerVector : public ::testing::TestWithParam<vectors::DiscoveryVector> {};
TEST_P(ServerVector, ConformsExactly) {
  const model::Scenario& scenario = GetParam().scenario;
  const Simulated run = simulated(scenario);
  const Conformance result =
      conformance(run.conversation, scenario.dds, exact_bounds(scenario, run));
  EXPECT_TRUE(is_explained(result)) << description(result);
  EXPECT_EQ(result.used_lateness_ns, 0);
  EXPECT_EQ(result.used_send_lag_ns, 0);
}
INSTANTIATE_TEST_SUITE_P(Vector, ServerVector, ::testing::ValuesIn(vectors_with_server()),
                         [](const auto& one) { return one.param.name; });

/// Whether there are clients on the server's host that the capture does not know of, as the run
/// ended before the server told of them.
bool hides_somebody(const model::Scenario& scenario, const capture::Conversation& conversation) {
  const auto there = std::ranges::count_if(
      scenario.deployment.participants,
      [](const model::Participant& one) { return one.host == model::HostId{}; });
  const capture::Participant* server = conversation.topology.server();
  if (there == 0 || server == nullptr) return there > 0;
  const auto told = std::ranges::count_if(
      conversation.topology.participants,
      [&](const capture::Participant& one) { return one.host == server->host; });
  return told - 1 < there;
}

/// The last change leaves the history first, then all others: an empty history announces what the
/// one before it did not.
TEST(Server, AHistoryMayBecomeEmptyAfterItsLastChangeHasLeft) {
  model::Scenario scenario;
  scenario.deployment.participants = {
      {model::HostId{1}, 0, 0, model::Nanoseconds{0}, model::Nanoseconds{230 * ms}},
      {model::HostId{2}, 3, 0, model::Nanoseconds{0}, model::Nanoseconds{900 * ms}}};
  scenario.deployment.loopback_delay = model::Nanoseconds{2 * ms};
  scenario.dds = of_server("fastdds-server-2.14.5", false);
  scenario.dds.server.client_sync_period = model::Nanoseconds{160 * ms};
  scenario.dds.server.server_routine_period = model::Nanoseconds{40 * ms};
  scenario.wireless.lost_packets = {73, 90};
  scenario.wireless.fragment_request = model::FragmentRequest::at_admission;
  scenario.wireless.order = model::ServiceOrder::fifo;
  scenario.wireless.mtu_payload_bytes = model::Bytes{65'535};
  scenario.time_limit = model::Nanoseconds{1'800 * ms};
  model::RunOptions options;
  options.max_events = 20'000;
  const Simulated run = simulated(scenario, options);
  const Conformance result =
      conformance(run.conversation, scenario.dds, exact_bounds(scenario, run));
  EXPECT_TRUE(is_explained(result)) << description(result);
}

void check_random(bool losses) {
  props::ScenarioSpace space;
  space.implementation = model::ImplementationKind::fastdds;
  space.max_time_limit = model::Nanoseconds{4'000 * ms};
  space.losses = losses;
  model::Scenario scenario = *props::scenarios(space);
  scenario.dds =
      of_server(*rc::gen::arbitrary<bool>() ? "fastdds-server-2.6.11" : "fastdds-server-2.14.5",
                *rc::gen::arbitrary<bool>());
  if (*rc::gen::arbitrary<bool>()) scenario.dds.server.known = model::ServerKnown::locator;
  for (model::Nanoseconds* period :
       {&scenario.dds.server.client_sync_period, &scenario.dds.server.server_routine_period}) {
    *period = model::Nanoseconds{*rc::gen::inRange<std::int64_t>(1, 13) * 40 * ms};
  }
  const auto shift = *rc::gen::inRange<std::uint32_t>(0, 2);
  for (model::Participant& one : scenario.deployment.participants) one.host.value += shift;
  scenario.wireless.packet_delays.clear();
  scenario.wireless.fragment_request = model::FragmentRequest::at_admission;
  scenario.wireless.order = model::ServiceOrder::fifo;
  scenario.wireless.mtu_payload_bytes = model::Bytes{65'535};
  model::RunOptions options;
  options.max_events = 20'000;
  const Simulated run = simulated(scenario, options);
  if (run.is_empty || run.conversation.topology.hosts < 2) return;
  if (hides_somebody(scenario, run.conversation)) return;
  const Conformance result =
      conformance(run.conversation, scenario.dds, exact_bounds(scenario, run));
  if (result.verdict == Verdict::does_not_conform || result.explained != result.checked) {
    RC_FAIL(description(result));
  }
}
RC_GTEST_PROP(ServerRandom, Conforms, ()) { check_random(false); }
RC_GTEST_PROP(ServerRandom, ConformsWithLosses, ()) { check_random(true); }

Bounds bounds_of(const model::Scenario& scenario, const Simulated& run) {
  Bounds bounds = exact_bounds(scenario, run);
  bounds.most_delay_ns = 2 * ms;
  return bounds;
}

std::vector<std::uint64_t> every_fifth() {
  std::vector<std::uint64_t> list;
  for (std::uint64_t k = 4; k < 300; k += 5) list.push_back(k);
  return list;
}

struct Knob {
  const char* name;
  bool is_super;
  bool loses;
  void (*change)(model::DdsProfile&);
  Fault fault;
};
std::ostream& operator<<(std::ostream& out, const Knob& one) { return out << one.name; }

const std::vector<Knob>& knobs() {
  using Dds = model::DdsProfile;
  static const std::vector<Knob> list{
      {"TickThreeTimes", false, false,
       [](Dds& dds) { dds.server.client_sync_period = times(dds.server.client_sync_period, 3); },
       Fault::announcement_extra},
      {"TickHalf", false, false,
       [](Dds& dds) { dds.server.client_sync_period = times(dds.server.client_sync_period, 1, 2); },
       Fault::announcement_due},
      {"RoutineThreeTimes", false, false,
       [](Dds& dds) {
         dds.server.server_routine_period = times(dds.server.server_routine_period, 3);
       },
       Fault::data_early},
      {"RoutineThreeTimesOfSuperClients", true, false,
       [](Dds& dds) {
         dds.server.server_routine_period = times(dds.server.server_routine_period, 3);
       },
       Fault::data_early},
      {"AnnouncedHeartbeatThreeTimes", false, true,
       [](Dds& dds) {
         dds.server.pdp_heartbeat_period = times(dds.server.pdp_heartbeat_period, 3);
       },
       Fault::heartbeat_cause},
      {"AnnouncedHeartbeatHalf", false, true,
       [](Dds& dds) {
         dds.server.pdp_heartbeat_period = times(dds.server.pdp_heartbeat_period, 1, 2);
       },
       Fault::heartbeat_cause},
      {"AnnouncedNackResponse", false, false,
       [](Dds& dds) {
         dds.server.pdp_nack_response_delay = times(dds.server.pdp_nack_response_delay, 10);
       },
       Fault::data_early},
      {"AnnouncedSuppression", false, true,
       [](Dds& dds) {
         dds.server.pdp_nack_suppression_duration =
             times(dds.server.pdp_nack_suppression_duration, 100);
       },
       Fault::data_early},
      {"AnnouncedResponseThreeTimes", false, false,
       [](Dds& dds) {
         dds.server.pdp_heartbeat_response_delay =
             times(dds.server.pdp_heartbeat_response_delay, 3);
       },
       Fault::acknack_early},
      {"AnnouncedResponseTenth", false, false,
       [](Dds& dds) {
         dds.server.pdp_heartbeat_response_delay =
             times(dds.server.pdp_heartbeat_response_delay, 1, 10);
       },
       Fault::acknack_cause},
      {"HeartbeatThreeTimes", true, false,
       [](Dds& dds) { dds.sedp.heartbeat_period = times(dds.sedp.heartbeat_period, 3); },
       Fault::heartbeat_cause},
      {"NackResponse", false, false,
       [](Dds& dds) { dds.sedp.nack_response_delay = times(dds.sedp.nack_response_delay, 100); },
       Fault::data_early},
      {"Suppression", false, false,
       [](Dds& dds) {
         dds.sedp.nack_suppression_duration = times(dds.sedp.nack_suppression_duration, 1'000);
       },
       Fault::data_early},
      {"Response", false, false,
       [](Dds& dds) {
         dds.sedp.heartbeat_response_delay = times(dds.sedp.heartbeat_response_delay, 1'000);
       },
       Fault::acknack_early},
      {"InitialTwice", false, false,
       [](Dds& dds) { dds.sedp.initial_acknack_delay = times(dds.sedp.initial_acknack_delay, 2); },
       Fault::initial_early},
      {"InitialHalf", false, false,
       [](Dds& dds) {
         dds.sedp.initial_acknack_delay = times(dds.sedp.initial_acknack_delay, 1, 2);
       },
       Fault::initial_late},
      {"StartupPeriod", false, false,
       [](Dds& dds) { dds.spdp.startup_period = times(dds.spdp.startup_period, 3); },
       Fault::announcement_extra},
      {"RelayOnce", true, false, [](Dds& dds) { dds.server.relay = model::Relay::once; },
       Fault::data_cause},
      {"SuperClients", false, false,
       [](Dds& dds) { dds.discovery = model::Discovery::super_client; }, Fault::data_cause},
      {"ClientsOnly", true, false, [](Dds& dds) { dds.discovery = model::Discovery::server; },
       Fault::data_cause},
      {"Simple", false, false, [](Dds& dds) { dds.discovery = model::Discovery::simple; },
       Fault::no_such_rule}};
  return list;
}

class ServerKnob : public ::testing::TestWithParam<Knob> {};
TEST_P(ServerKnob, IsNoticedWhenItIsChanged) {
  const Knob& knob = GetParam();
  const model::Scenario scenario =
      served(knob.is_super ? model::Discovery::super_client : model::Discovery::server,
             knob.loses ? every_fifth() : std::vector<std::uint64_t>{});
  const Simulated run = simulated(scenario);
  const Bounds bounds = bounds_of(scenario, run);
  const Conformance own = conformance(run.conversation, scenario.dds, bounds);
  EXPECT_TRUE(is_explained(own)) << description(own);
  model::DdsProfile changed = scenario.dds;
  knob.change(changed);
  const Conformance other = conformance(run.conversation, changed, bounds);
  EXPECT_EQ(other.verdict, Verdict::does_not_conform);
  EXPECT_TRUE(std::ranges::any_of(other.unexplained, [&](const Unexplained& one) {
    return one.fault == knob.fault;
  })) << description(other);
}
INSTANTIATE_TEST_SUITE_P(Changed, ServerKnob, ::testing::ValuesIn(knobs()),
                         [](const auto& one) { return std::string{one.param.name}; });

/// What the shipped captures tell of the knobs of a server.
TEST(Server, ChangedKnobsAreNoticed) {
  std::set<std::string> rejected;
  std::set<std::string> acting;
  for (const Shipped& one :
       {Shipped{"fastdds291_ap150_client_np3_ne20_r0", "fastdds-server-2.6.11"},
        Shipped{"fastdds291_ap150_super_np1_ne2_r0", "fastdds-server-2.6.11", true}}) {
    const auto conversation = shipped(std::string{"discovery-server/"} + one.name);
    const auto tried =
        try_changes({conversation, one.name, one.profile, of_server(one.profile, one.is_super)});
    ASSERT_TRUE(tried) << to_string(tried.error());
    EXPECT_EQ(tried->verdict, Verdict::conforms);
    for (const Tried& change : tried->tried) {
      if (change.notice != Notice::does_not_act) acting.insert(change.change);
      if (change.notice == Notice::rejected) rejected.insert(change.change);
    }
  }
  for (const char* change :
       {"τ_T × 3", "τ_T / 2", "τ_A × 1000", "τ_S × 10000", "τ_I × 2", "τ_PA × 3", "relay once",
        "discovery server", "discovery super_client"}) {
    EXPECT_TRUE(rejected.contains(change)) << change;
  }
  // Clients on the server's host can have made its routine run at any time.
  EXPECT_TRUE(acting.contains("τ_R × 3"));
  EXPECT_FALSE(rejected.contains("τ_R × 3"));
}

/// What an event is put down to is in what a server adds, or with Fast DDS.
TEST(Server, SendersAreRulesOfTheCompositions) {
  const model::DdsProfile dds = of_server("fastdds-server-2.6.11", false);
  const Conformance result =
      conformance(shipped("discovery-server/fastdds291_ap150_client_np3_ne20_r0"), dds);
  EXPECT_GT(result.by_sender.size(), 15U);
  for (const auto& [sender, times] : result.by_sender) {
    bool is_there = false;
    for (const auto* composition :
         {&model::composition_of(dds), &model::composition_of(dds.implementation)}) {
      for (const auto* list : {&composition->rules, &composition->procedures}) {
        is_there =
            is_there || std::ranges::any_of(*list, [&scope = sender.scope](const auto& rule) {
              return rule.id == scope;
            });
      }
    }
    EXPECT_TRUE(is_there) << sender.scope;
  }
  for (std::size_t k = 0; k < rule_count; ++k) {
    const auto rule = static_cast<Rule>(k);
    EXPECT_TRUE(is_rule_of(rule, dds) || result.by_rule[k] == 0) << name_of(rule);
  }
}

}  // namespace server_test
}  // namespace stormproof::conform::testing
