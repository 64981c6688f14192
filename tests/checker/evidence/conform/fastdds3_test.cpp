// What Fast DDS 3 has and earlier versions have not: endpoints that look up types, 31 DATA in a
// message, and HEARTBEATs that ride when the messages of a participant have filled a group.
#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/config/spec_path.hpp"
#include "props/generators/scenarios.hpp"
#include "tests/checker/evidence/conform/captures.hpp"
#include "tests/checker/evidence/conform/edits.hpp"

namespace stormproof::conform::testing {
namespace fastdds3_test {

struct Shipped {
  std::string name;
  std::string profile;
  bool looks_up = true;  ///< the capture shows it, not only that the version does
};

std::ostream& operator<<(std::ostream& out, const Shipped& one) { return out << one.name; }

const std::vector<Shipped>& captures() {
  static const std::vector<Shipped> list{
      {"fastdds325_ap150_simple_np3_ne2_r0", "fastdds-3.2"},
      {"fastdds362_ap150_simple_np1_ne2_r0", "fastdds-3.6", false},
      {"fastdds362_ap150_simple_pre_np2_ne80_r0", "fastdds-3.6"},
      {"fastdds362_ap150_simple_xtypes_np3_ne20_r2", "fastdds-3.6"},
      {"fastdds362_ap150_simple_xtypes_unknown_np1_ne2_r1", "fastdds-3.6"}};
  return list;
}

class Fastdds3Capture : public ::testing::TestWithParam<Shipped> {};

TEST_P(Fastdds3Capture, ConformsToItsVersion) {
  const auto conversation = shipped("fastdds-3/" + GetParam().name);
  const Conformance result = conformance(conversation, profile(GetParam().profile));
  EXPECT_TRUE(is_explained(result)) << description(result);
  EXPECT_GT(result.checked, 50U);
  EXPECT_EQ(result.lost, 0U);
}

/// Version 2.14.5 has the same timers, and neither such endpoints nor such announcements.
TEST_P(Fastdds3Capture, DoesNotConformToAVersionThatLooksUpNothing) {
  const auto conversation = shipped("fastdds-3/" + GetParam().name);
  const Conformance result = conformance(conversation, profile("fastdds-2.14.5"));
  EXPECT_EQ(result.verdict, Verdict::does_not_conform);
  std::set<Fault> faults;
  for (const Unexplained& one : result.unexplained) {
    faults.insert(one.fault);
    if (one.fault == Fault::no_such_rule) {
      EXPECT_EQ(one.what, "a lookup of types");
    }
  }
  std::set<Fault> expected{Fault::other_version};
  if (GetParam().looks_up) expected.insert(Fault::no_such_rule);
  EXPECT_EQ(faults, expected) << description(result);
}

/// Of two versions of Fast DDS 3 at most one is meant, and nobody takes it for a version before 3.
TEST_P(Fastdds3Capture, ConformsToNoOtherVersion) {
  const auto conversation = shipped("fastdds-3/" + GetParam().name);
  for (const char* name : {"fastdds-2.6.11", "fastdds-2.14.5", "fastdds-3.2", "fastdds-3.6"}) {
    const Conformance result = conformance(conversation, profile(name));
    EXPECT_EQ(result.verdict == Verdict::conforms, name == GetParam().profile) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, Fastdds3Capture, ::testing::ValuesIn(captures()),
                         [](const auto& one) { return one.param.name; });

/// Each capture conforms to its own preset, and fewer than one in four of the others explain it.
TEST(Presets, OthersSeldomExplainACapture) {
  const model::config::SpecPath specs{{STORMPROOF_SPECS_DIR}};
  std::size_t held = 0;
  std::size_t explain = 0;
  for (const Shipped& one : captures()) {
    const auto conversation = shipped("fastdds-3/" + one.name);
    for (const std::string& name : specs.names(model::config::SpecKind::dds)) {
      const model::DdsProfile dds = profile(name);
      if (name == one.profile || refuse_profile(dds)) continue;
      ++held;
      if (conformance(conversation, dds).verdict == Verdict::conforms) ++explain;
    }
  }
  EXPECT_GT(held, 50U);
  EXPECT_LT(explain * 4, held);
}

/// Announcements alone decide nothing, whoever sent them.
TEST(SameMachineId, DecidesNothing) {
  const auto conversation = shipped("fastdds-3/fastdds362_same_machine_id_np2_ne10_r0");
  EXPECT_EQ(conformance(conversation, profile("fastdds-3.6")).verdict, Verdict::inconclusive);
}

/// 49 descriptors leave as 31 and 18; one more in the first message is one too many.
TEST(MaxDataPerMessage, OneMoreIsRefused) {
  auto conversation = shipped("fastdds-3/fastdds362_ap150_simple_pre_np2_ne80_r0");
  std::map<std::uint32_t, std::size_t> data;
  std::size_t last = 0;
  for (std::size_t k = 0; k < conversation.events.size() && last == 0; ++k) {
    const Event& event = conversation.events[k];
    if (event.traffic() != capture::Traffic::sedp || event.data() == nullptr) continue;
    if (++data[event.datagram] == 31) last = k;
  }
  ASSERT_GT(last, 0U);
  const Event one = conversation.events[last];
  conversation.events.insert(conversation.events.begin() + static_cast<std::ptrdiff_t>(last), one);
  const Conformance result = conformance(conversation, profile("fastdds-3.6"));
  ASSERT_EQ(result.verdict, Verdict::does_not_conform);
  const auto found =
      std::ranges::find(result.unexplained, Fault::no_such_rule, &Unexplained::fault);
  ASSERT_NE(found, result.unexplained.end()) << description(result);
  EXPECT_EQ(found->what, "DATA number 32 of a message");
  EXPECT_EQ(found->event, last + 1);
}

/// One participant on each host, so that nothing is hidden, with a small threshold.
model::Scenario in_groups(std::int64_t threshold, std::uint32_t hosts = 2) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(hosts, 1, 20);
  for (model::Participant& one : scenario.deployment.participants) {
    one.start = one.endpoints_done = model::Nanoseconds{3'000'000};
  }
  scenario.dds = profile("fastdds-3.6");
  scenario.dds.sedp.piggyback_threshold_bytes = model::Bytes{threshold};
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = model::Nanoseconds{1'000'000};
  scenario.time_limit = model::Nanoseconds{2'000'000'000};
  scenario.run_until = model::RunUntil::time_limit;
  return scenario;
}

std::uint64_t riding(const Conformance& result) {
  return result.by_rule[static_cast<std::size_t>(Rule::heartbeat_piggyback)];
}

TEST(Group, HeartbeatsRideAsTheSimulatorSays) {
  for (const std::int64_t threshold : {1'500, 2'000, 5'000}) {
    for (const std::uint32_t hosts : {2U, 3U}) {
      const model::Scenario scenario = in_groups(threshold, hosts);
      const Simulated run = simulated(scenario);
      const Conformance result =
          conformance(run.conversation, scenario.dds, exact_bounds(scenario, run));
      EXPECT_TRUE(is_explained(result)) << description(result);
      EXPECT_GT(riding(result), 0U) << threshold << " " << hosts;
    }
  }
}

/// What publications take fills a group of 5,000 bytes, so a HEARTBEAT rides in the message of the
/// subscriptions; that message, which would fill a larger group, has not left by then.
TEST(Group, ALargerThresholdDoesNotExplainThem) {
  const model::Scenario scenario = in_groups(5'000);
  const Simulated run = simulated(scenario);
  for (const std::int64_t threshold : {6'000, 10'000, 40'000}) {
    model::DdsProfile larger = scenario.dds;
    larger.sedp.piggyback_threshold_bytes = model::Bytes{threshold};
    const Conformance result = conformance(run.conversation, larger, exact_bounds(scenario, run));
    ASSERT_EQ(result.verdict, Verdict::does_not_conform) << threshold;
    EXPECT_EQ(result.unexplained.front().fault, Fault::heartbeat_cause) << description(result);
  }
}

/// The first HEARTBEAT that rides, again at once: nothing has been sent in between.
TEST(Group, OneMoreHeartbeatIsNotExplained) {
  const model::Scenario scenario = in_groups(5'000);
  Simulated run = simulated(scenario);
  auto& conversation = run.conversation;
  const std::size_t rides = find(conversation, [&](const Event& event) {
    const auto* heartbeat = event.heartbeat();
    if (heartbeat == nullptr || event.traffic() != capture::Traffic::sedp) return false;
    return std::ranges::any_of(conversation.events, [&](const Event& other) {
      return other.datagram == event.datagram && other.data() != nullptr;
    });
  });
  Event again = conversation.events[rides];
  std::get<capture::HeartbeatEvent>(again.content).count += 1;
  for (Event& event : conversation.events) {
    auto* later = std::get_if<capture::HeartbeatEvent>(&event.content);
    if (later != nullptr && event.source == again.source && event.writer == again.writer &&
        event.time_ns > again.time_ns) {
      ++later->count;
    }
  }
  const std::size_t added = add(conversation, again, again.time_ns + 100'000);
  const Conformance result = conformance(conversation, scenario.dds, exact_bounds(scenario, run));
  ASSERT_EQ(result.verdict, Verdict::does_not_conform);
  EXPECT_EQ(result.unexplained.front().event, added) << description(result);
  EXPECT_EQ(result.unexplained.front().fault, Fault::heartbeat_cause);
}

/// Whatever starts when, on however many hosts, with or without neighbours.
RC_GTEST_PROP(Group, AnyRunConforms, ()) {
  props::ScenarioSpace space;
  space.implementation = model::ImplementationKind::fastdds;
  space.max_time_limit = model::Nanoseconds{2'000'000'000};
  model::Scenario scenario = *props::scenarios(space);
  scenario.dds = profile("fastdds-3.6");
  scenario.dds.sedp.piggyback_threshold_bytes =
      model::Bytes{*rc::gen::elementOf(std::vector<std::int64_t>{1'500, 3'000, 20'000, 106'496})};
  scenario.wireless.packet_delays.clear();
  scenario.wireless.fragment_request = model::FragmentRequest::at_admission;
  scenario.wireless.order = model::ServiceOrder::fifo;
  scenario.wireless.mtu_payload_bytes = model::Bytes{65'535};
  model::RunOptions options;
  options.max_events = 20'000;
  const Simulated run = simulated(scenario, options);
  if (run.is_empty || run.conversation.topology.hosts < 2) return;
  const Conformance result =
      conformance(run.conversation, scenario.dds, exact_bounds(scenario, run));
  if (result.verdict == Verdict::does_not_conform) RC_FAIL(description(result));
}

}  // namespace fastdds3_test
}  // namespace stormproof::conform::testing
