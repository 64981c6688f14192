// Every simulated run conforms to its own profile, with exact bounds: nothing is late, and each
// delay is at most the run's length. And without admitting losses where the run has none.
#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "props/generators/scenarios.hpp"
#include "tests/checker/evidence/conform/captures.hpp"
#include "tests/vectors/fastdds_vectors.hpp"

namespace stormproof::conform::testing {
namespace simulated_test {

void expect_conforming(const model::Scenario& scenario) {
  const Simulated run = simulated(scenario);
  const Conformance result =
      conformance(run.conversation, scenario.dds, exact_bounds(scenario, run));
  EXPECT_TRUE(is_explained(result)) << description(result);
  EXPECT_EQ(result.used_lateness_ns, 0);
  EXPECT_EQ(result.used_send_lag_ns, 0);
}

std::vector<vectors::Vector> short_vectors() {
  std::vector<vectors::Vector> list = vectors::fastdds_vectors();
  std::erase_if(list, [](const auto& one) { return one.expected.heartbeat > 3'000; });
  return list;
}

class SimulatedVector : public ::testing::TestWithParam<vectors::Vector> {};
TEST_P(SimulatedVector, ConformsExactly) { expect_conforming(GetParam().scenario); }
INSTANTIATE_TEST_SUITE_P(Vector, SimulatedVector, ::testing::ValuesIn(short_vectors()),
                         [](const auto& one) { return one.param.name; });

/// Deployments, starts, losses and channels of any kind, with the timers of a version. Datagrams of
/// a participant do not overtake each other, which conformance assumes: every datagram is one
/// fragment, and the stages serve in order.
model::Scenario in_order(model::Scenario scenario) {
  model::WirelessProfile& wireless = scenario.wireless;
  wireless.packet_delays.clear();
  wireless.fragment_request = model::FragmentRequest::at_admission;
  wireless.order = model::ServiceOrder::fifo;
  wireless.mtu_payload_bytes = model::Bytes{65'535};
  return scenario;
}
model::Scenario in_order(model::Scenario scenario, const std::string& version) {
  scenario.dds = profile(version);
  return in_order(std::move(scenario));
}

TEST(SimulatedScenario, ShippedOnesConform) {
  expect_conforming(in_order(scenario("live-5x20"), "fastdds-2.6.11"));
  expect_conforming(in_order(scenario("three-hosts"), "fastdds-2.9.1"));
}

/// The same DATA to two readers and, 14 µs later, to two others: two messages, charged twice.
TEST(SimulatedScenario, MessagesThatSayTheSameAreNotCopies) {
  const model::Scenario alike =
      scenario(STORMPROOF_SOURCE_DIR "/tests/checker/evidence/conform/alike_messages.yaml");
  expect_conforming(alike);
  const Simulated run = simulated(alike);
  Bounds bounds = exact_bounds(alike, run);
  bounds.most_send_lag_ns = 50'000'000;
  EXPECT_NE(conformance(run.conversation, alike.dds, bounds).verdict, Verdict::does_not_conform);
}

/// A neighbour that asks again and again, sooner than an answer can come, uses up the budget of a
/// writer. The capture shows nothing of that but the count of the HEARTBEAT that follows.
TEST(SimulatedScenario, CountsWhatStaysOnAHost) {
  model::Scenario impatient;
  impatient.deployment = model::Deployment::homogeneous(2, 2, 0);
  impatient.deployment.participants.pop_back();
  impatient.deployment.loopback_delay = model::Nanoseconds{2'000'000};
  impatient.dds = profile("fastdds-2.6.11");
  model::SedpProfile& sedp = impatient.dds.sedp;
  sedp.heartbeat_period = model::Nanoseconds{1'000'000'000};
  sedp.heartbeat_response_delay = sedp.nack_suppression_duration = model::Nanoseconds{10'000};
  sedp.nack_response_delay = sedp.initial_acknack_delay = model::Nanoseconds{100'000};
  sedp.initial_acknack_interval = model::InitialAckNackInterval::doubling;
  sedp.piggyback = model::Piggyback::linear;
  sedp.piggyback_threshold_bytes = model::Bytes{10'000};
  impatient.time_limit = model::Nanoseconds{520'000'000};
  expect_conforming(in_order(impatient));
}

/// A HEARTBEAT to all readers names its reader while there is only one, though others come later.
TEST(SimulatedScenario, ALateReaderDoesNotDisturb) {
  model::Scenario late;
  late.deployment = model::Deployment::homogeneous(3, 1, 2);
  late.dds = profile("fastdds-2.6.11");
  late.wireless.kind = model::ServiceKind::constant_delay;
  late.wireless.one_way = model::Nanoseconds{1'000'000};
  late.deployment.participants.back().start = model::Nanoseconds{2'500'000'000};
  late.deployment.participants.back().endpoints_done = model::Nanoseconds{2'500'000'000};
  late.deployment.participants.front().endpoints_done = model::Nanoseconds{20'000'000};
  for (std::uint64_t k = 4; k < 60; k += 3) late.wireless.lost_packets.push_back(k);
  expect_conforming(late);
}

props::ScenarioSpace space(bool losses) {
  props::ScenarioSpace space;
  space.implementation = model::ImplementationKind::fastdds;
  space.max_time_limit = model::Nanoseconds{2'000'000'000};
  space.losses = losses;
  return space;
}

constexpr const char* versions[] = {"fastdds-2.6.11", "fastdds-2.9.1", "fastdds-2.14.5",
                                    STORMPROOF_SPECS_DIR "/findings/profiles/corrections.yaml"};

bool sends_descriptors(const capture::Conversation& conversation) {
  return std::ranges::any_of(conversation.events, [](const capture::Event& event) {
    return event.data() != nullptr && event.writer != capture::entity::spdp_writer;
  });
}

/// `is_certain`: the machines confirm every explanation, too.
void check_conforms(const model::Scenario& scenario, bool is_certain = true) {
  model::RunOptions options;
  options.max_events = 20'000;
  const Simulated run = simulated(scenario, options);
  if (run.is_empty || run.conversation.topology.hosts < 2) return;
  const Conformance result =
      conformance(run.conversation, scenario.dds, exact_bounds(scenario, run));
  if (!is_certain) {
    if (result.verdict == Verdict::does_not_conform) RC_FAIL(description(result));
  } else if (sends_descriptors(run.conversation)) {
    if (!is_explained(result)) RC_FAIL(description(result));
  } else if (result.verdict != Verdict::inconclusive || result.explained != result.checked) {
    RC_FAIL(description(result));  // announcements alone decide nothing
  }
}

void check_random(bool losses) {
  const model::Scenario drawn = *props::scenarios(space(losses));
  check_conforms(in_order(drawn, versions[*rc::gen::inRange<std::size_t>(0, std::size(versions))]));
}

model::Scenario with_static_peers(model::Scenario scenario, std::uint32_t ports) {
  scenario.dds.discovery = model::Discovery::static_peers;
  scenario.dds.peer_ports = ports;
  return scenario;
}

/// Whoever has no port of the first few is announced to once it is known.
void check_static_peers(bool losses) {
  const auto ports = *rc::gen::inRange<std::uint32_t>(1, 5);
  check_conforms(
      with_static_peers(in_order(*props::scenarios(space(losses)), "fastdds-2.6.11"), ports));
}

TEST(SimulatedScenario, StaticPeersConformWithTheirPortsOnly) {
  model::Scenario simple_one = in_order(scenario("live-5x20"), "fastdds-2.6.11");
  simple_one.deployment = model::Deployment::homogeneous(2, 5, 2);
  const model::Scenario four = with_static_peers(simple_one, 4);
  expect_conforming(four);
  const Simulated run = simulated(four);
  const Bounds bounds = exact_bounds(four, run);
  for (const std::uint32_t ports : {2U, 3U, 5U}) {
    const Conformance other =
        conformance(run.conversation, with_static_peers(four, ports).dds, bounds);
    EXPECT_EQ(other.verdict, Verdict::does_not_conform) << ports;
  }
  EXPECT_EQ(conformance(run.conversation, profile("fastdds-2.6.11"), bounds).verdict,
            Verdict::does_not_conform);
  const Simulated simple = simulated(simple_one);
  EXPECT_EQ(conformance(simple.conversation, four.dds, bounds).verdict, Verdict::does_not_conform);
}

/// With any timers that captures resolve, any resends and budgets no run is rejected. (Of some
/// hundred one is inconclusive, because the machines do not confirm the schedule of requests that
/// was found.)
void check_any_knobs(bool losses) {
  model::Scenario scenario = in_order(*props::scenarios(space(losses)));
  model::SedpProfile& sedp = scenario.dds.sedp;
  sedp.heartbeat_policy = model::HeartbeatPolicy::periodic;
  constexpr model::Nanoseconds resolution{1'000};  // of most captures
  for (model::Nanoseconds* timer : {&sedp.heartbeat_period, &sedp.heartbeat_response_delay,
                                    &sedp.nack_response_delay, &sedp.nack_suppression_duration}) {
    *timer = std::max(*timer, resolution);
  }
  if (!refuse_profile(scenario.dds)) check_conforms(scenario, false);
}

RC_GTEST_PROP(SimulatedRandom, ConformsWhateverTheKnobs, ()) { check_any_knobs(true); }
RC_GTEST_PROP(SimulatedRandom, ConformsWhateverTheKnobsWithoutLosses, ()) {
  check_any_knobs(false);
}
RC_GTEST_PROP(SimulatedRandom, ConformsWithStaticPeers, ()) { check_static_peers(true); }
RC_GTEST_PROP(SimulatedRandom, ConformsWithStaticPeersWithoutLosses, ()) {
  check_static_peers(false);
}
RC_GTEST_PROP(SimulatedRandom, ConformsExactly, ()) { check_random(true); }
RC_GTEST_PROP(SimulatedRandom, ConformsWithoutAdmittingLosses, ()) { check_random(false); }

}  // namespace simulated_test
}  // namespace stormproof::conform::testing
