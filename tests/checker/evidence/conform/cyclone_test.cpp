// Captures of Cyclone DDS and of its simulated runs conform to their profile, with losses, too; a
// knob that acts in a run is noticed when it is changed; and each rule has a message that breaks
// it.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/composition_of.hpp"
#include "props/generators/scenarios.hpp"
#include "tests/checker/evidence/conform/captures.hpp"
#include "tests/checker/evidence/conform/edits.hpp"
#include "tests/vectors/cyclone_vectors.hpp"

namespace stormproof::conform::testing {
namespace cyclone_test {

constexpr std::int64_t ms = 1'000'000;

struct Shipped {
  const char* name;
  const char* profile;
};
std::ostream& operator<<(std::ostream& out, const Shipped& one) { return out << one.name; }

class CycloneCapture : public ::testing::TestWithParam<Shipped> {};

TEST_P(CycloneCapture, ConformsToItsProfileOnly) {
  const auto conversation = shipped(GetParam().name);
  for (const char* name : {"cyclonedds-0.10", "cyclonedds-0.10-multicast"}) {
    const Conformance result = conformance(conversation, profile(name));
    if (name == std::string{GetParam().profile}) {
      EXPECT_TRUE(is_explained(result)) << name << " " << description(result);
    } else {
      EXPECT_EQ(result.verdict, Verdict::does_not_conform) << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shipped, CycloneCapture,
    ::testing::Values(Shipped{"cyclone0102_veth_np2_ne20_r0", "cyclonedds-0.10-multicast"},
                      Shipped{"cyclone0102uni_veth_np2_ne20_r0", "cyclonedds-0.10"},
                      Shipped{"cyclone0102uni_ap_np5_ne20_r0", "cyclonedds-0.10"}),
    [](const auto& one) { return std::string{one.param.name}; });

/// The packets of a participant's thread leave one after the other.
Bounds bounds_of(const model::Scenario& scenario, const Simulated& run) {
  Bounds bounds = exact_bounds(scenario, run);
  bounds.most_send_lag_ns = 5 * ms;
  bounds.most_lateness_ns = 20 * ms;
  bounds.most_queueing_ns = 500 * ms;
  return bounds;
}

void expect_conforming(const model::Scenario& scenario) {
  const Simulated run = simulated(scenario);
  const Conformance result = conformance(run.conversation, scenario.dds, bounds_of(scenario, run));
  EXPECT_TRUE(is_explained(result)) << description(result);
}

class CycloneVector : public ::testing::TestWithParam<vectors::Vector> {};
TEST_P(CycloneVector, Conforms) { expect_conforming(GetParam().scenario); }
std::vector<vectors::Vector> short_vectors() {
  std::vector<vectors::Vector> list = vectors::cyclone_vectors();
  std::erase_if(list, [](const auto& one) { return one.expected.heartbeat > 1'000; });
  return list;
}
INSTANTIATE_TEST_SUITE_P(Vector, CycloneVector, ::testing::ValuesIn(short_vectors()),
                         [](const auto& one) { return one.param.name; });

void check_random(bool losses) {
  props::ScenarioSpace space;
  space.implementation = model::ImplementationKind::cyclone;
  space.max_time_limit = model::Nanoseconds{2'000 * ms};
  space.losses = losses;
  model::Scenario scenario = *props::scenarios(space);
  scenario.wireless.packet_delays.clear();
  scenario.wireless.fragment_request = model::FragmentRequest::at_admission;
  scenario.wireless.order = model::ServiceOrder::fifo;
  scenario.wireless.mtu_payload_bytes = model::Bytes{65'535};
  scenario.deployment.send_time = model::Nanoseconds{50'000};
  model::RunOptions options;
  options.max_events = 20'000;
  const Simulated run = simulated(scenario, options);
  if (run.is_empty || run.conversation.topology.hosts < 2) return;
  const Bounds bounds = bounds_of(scenario, run);
  const Conformance result = conformance(run.conversation, scenario.dds, bounds);
  if (result.verdict == Verdict::does_not_conform) RC_FAIL(description(result));
}

RC_GTEST_PROP(CycloneRandom, Conforms, ()) { check_random(false); }
RC_GTEST_PROP(CycloneRandom, ConformsWithLosses, ()) { check_random(true); }

/// Two hosts with one or more participants each, some seconds long.
model::Scenario long_run(std::uint32_t participants, const char* dds,
                         std::vector<std::uint64_t> lost = {}) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, participants, 3);
  std::int64_t start = 0;
  for (model::Participant& one : scenario.deployment.participants) {
    one.start = model::Nanoseconds{start += 3 * ms};
    one.endpoints_done = model::Nanoseconds{start + 15 * ms};
  }
  scenario.dds = profile(dds);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = model::Nanoseconds{ms};
  scenario.wireless.lost_packets = std::move(lost);
  scenario.time_limit = model::Nanoseconds{17'000 * ms};
  scenario.run_until = model::RunUntil::time_limit;
  return scenario;
}
std::vector<std::uint64_t> every(std::uint64_t step, std::uint64_t from, std::uint64_t to) {
  std::vector<std::uint64_t> list;
  for (std::uint64_t k = from; k < to; k += step) list.push_back(k);
  return list;
}

model::Nanoseconds times(model::Nanoseconds timer, std::int64_t numerator,
                         std::int64_t denominator = 1) {
  return model::Nanoseconds{timer.count() * numerator / denominator};
}

/// What a long run is of.
struct Setting {
  std::uint32_t participants;
  const char* dds;
  std::vector<std::uint64_t> lost;
};

struct Knob {
  const char* name;
  Setting setting;
  void (*change)(model::DdsProfile&);
  Fault fault;
};
std::ostream& operator<<(std::ostream& out, const Knob& one) { return out << one.name; }

const std::vector<Knob>& knobs() {
  using Dds = model::DdsProfile;
  const char* const uc = "cyclonedds-0.10";
  const char* const mc = "cyclonedds-0.10-multicast";
  const auto lossy = every(2, 6, 400);
  static const std::vector<Knob> list{
      {"HeartbeatIntervalThreeTimes", Setting{2, uc, lossy},
       [](Dds& dds) { dds.sedp.heartbeat_interval = times(dds.sedp.heartbeat_interval, 3); },
       Fault::heartbeat_cause},
      {"HeartbeatIntervalHalf", Setting{1, uc, lossy},
       [](Dds& dds) { dds.sedp.heartbeat_interval = times(dds.sedp.heartbeat_interval, 1, 2); },
       Fault::heartbeat_due},
      {"MatchHeartbeatDelay", Setting{1, uc, {}},
       [](Dds& dds) { dds.sedp.match_heartbeat_delay = times(dds.sedp.match_heartbeat_delay, 30); },
       Fault::heartbeat_cause},
      {"NackDelayThreeTimes", Setting{2, uc, lossy},
       [](Dds& dds) { dds.sedp.nack_delay = times(dds.sedp.nack_delay, 3); }, Fault::acknack_early},
      {"PreEmptiveAckDelay", Setting{1, uc, lossy},
       [](Dds& dds) { dds.sedp.preemptive_ack_delay = times(dds.sedp.preemptive_ack_delay, 3); },
       Fault::initial_early},
      {"StartupPeriodThreeTimes", Setting{1, uc, {}},
       [](Dds& dds) { dds.spdp.startup_period = times(dds.spdp.startup_period, 3); },
       Fault::announcement_extra},
      {"PeriodThreeTimes", Setting{1, uc, {}},
       [](Dds& dds) { dds.spdp.period = times(dds.spdp.period, 3); }, Fault::announcement_extra},
      {"PeriodHalf", Setting{1, uc, {}},
       [](Dds& dds) { dds.spdp.period = times(dds.spdp.period, 1, 2); }, Fault::announcement_due},
      {"FewerReplies", Setting{1, uc, {}}, [](Dds& dds) { dds.spdp.directed_replies = 2; },
       Fault::announcement_extra},
      {"MoreReplies", Setting{1, uc, {}}, [](Dds& dds) { dds.spdp.directed_replies = 6; },
       Fault::announcement_due},
      {"ReplyIntervalThreeTimes", Setting{1, uc, {}},
       [](Dds& dds) {
         dds.spdp.directed_reply_interval = times(dds.spdp.directed_reply_interval, 3);
       },
       Fault::announcement_extra},
      {"ReplyIntervalThird", Setting{1, uc, {}},
       [](Dds& dds) {
         dds.spdp.directed_reply_interval = times(dds.spdp.directed_reply_interval, 1, 3);
       },
       Fault::announcement_due},
      {"WithMulticast", Setting{2, uc, {}},
       [](Dds& dds) { dds.allow_multicast = model::AllowMulticast::always; },
       Fault::announcement_extra},
      {"WithoutMulticast", Setting{2, mc, {}},
       [](Dds& dds) { dds.allow_multicast = model::AllowMulticast::spdp; }, Fault::no_such_rule}};
  return list;
}

class CycloneKnob : public ::testing::TestWithParam<Knob> {};

TEST_P(CycloneKnob, IsNoticedWhenItIsChanged) {
  const auto& [participants, dds, lost] = GetParam().setting;
  const model::Scenario scenario = long_run(participants, dds, lost);
  const Simulated run = simulated(scenario);
  const Bounds bounds = bounds_of(scenario, run);
  const Conformance own = conformance(run.conversation, scenario.dds, bounds);
  EXPECT_TRUE(is_explained(own)) << description(own);
  model::DdsProfile changed = scenario.dds;
  GetParam().change(changed);
  const Conformance other = conformance(run.conversation, changed, bounds);
  EXPECT_EQ(other.verdict, Verdict::does_not_conform);
  EXPECT_TRUE(std::ranges::any_of(other.unexplained, [](const Unexplained& one) {
    return one.fault == GetParam().fault;
  })) << description(other);
}
INSTANTIATE_TEST_SUITE_P(Changed, CycloneKnob, ::testing::ValuesIn(knobs()),
                         [](const auto& one) { return std::string{one.param.name}; });

/// Five participants each: what one asks for while it is queued for another goes to all.
TEST(CycloneMerging, IsNoticedWhenItIsSwitchedOff) {
  model::DdsProfile dds = profile("cyclonedds-0.10");
  dds.sedp.merge_queued_rexmit = model::MergeQueued::no;
  const Conformance result = conformance(shipped("cyclone0102uni_ap_np5_ne20_r0"), dds);
  ASSERT_EQ(result.verdict, Verdict::does_not_conform);
  EXPECT_EQ(result.unexplained.front().fault, Fault::data_cause);
}

/// What an event is put down to is in the composition of Cyclone DDS.
TEST(Cyclone, SendersAreRulesOfItsComposition) {
  const model::DdsProfile dds = profile("cyclonedds-0.10");
  const auto& composition = model::composition_of(dds);
  const Conformance result = conformance(shipped("cyclone0102uni_ap_np5_ne20_r0"), dds);
  EXPECT_GT(result.by_sender.size(), 6U);
  for (const auto& [sender, times] : result.by_sender) {
    const auto is_it = [&scope = sender.scope](const auto& rule) { return rule.id == scope; };
    EXPECT_TRUE(std::ranges::any_of(composition.rules, is_it) ||
                std::ranges::any_of(composition.procedures, is_it))
        << sender.scope;
  }
  for (std::size_t k = 0; k < rule_count; ++k) {
    const auto rule = static_cast<Rule>(k);
    EXPECT_TRUE(is_rule_of(rule, dds) || result.by_rule[k] == 0) << name_of(rule);
  }
}

TEST(Cyclone, NoCaptureOfFastDdsConforms) {
  for (const char* name : {"fastdds2611_ap150_np1_ne2_r0", "fastdds291_veth_np1_ne2_r0",
                           "fastdds2611_ap150_np2_ne20_r0"}) {
    for (const char* dds : {"cyclonedds-0.10", "cyclonedds-0.10-multicast"}) {
      EXPECT_EQ(conformance(shipped(name), profile(dds)).verdict, Verdict::does_not_conform)
          << name << " " << dds;
    }
  }
}

/// What no participant sends, in a run that conforms.
struct Wrong {
  const char* name;
  void (*edit)(Conversation&);
  Fault fault;
};
std::ostream& operator<<(std::ostream& out, const Wrong& one) { return out << one.name; }

bool is_sedp(const Event& event) { return event.traffic() == capture::Traffic::sedp; }
bool asks(const Event& event) {
  return is_sedp(event) && event.acknack() != nullptr && event.acknack()->missing.size() > 0;
}
void repeat(Conversation& conversation, const Matches& matches, std::int64_t later) {
  const Event event = conversation.events[find(conversation, matches)];
  add(conversation, event, event.time_ns + later);
}

const std::vector<Wrong>& mistakes() {
  static const std::vector<Wrong> list{
      {"RepliesTooOften",
       [](Conversation& c) {
         repeat(
             c,
             [](const Event& e) { return e.traffic() == capture::Traffic::spdp && e.has_info_dst; },
             20 * ms);
       },
       Fault::announcement_extra},
      {"HeartbeatAgain",
       [](Conversation& c) {
         repeat(
             c, [](const Event& e) { return is_sedp(e) && e.heartbeat() != nullptr; }, ms);
       },
       Fault::heartbeat_count},
      {"HeartbeatWithoutCause",
       [](Conversation& c) {
         Event event = c.events[find_last(c, [](const Event& e) {
           return is_sedp(e) && e.heartbeat() != nullptr && !e.has_info_dst;
         })];
         auto heartbeat = *event.heartbeat();
         heartbeat.count += 1'000;
         event.content = heartbeat;
         add(c, event, event.time_ns + 30 * ms);
       },
       Fault::heartbeat_cause},
      {"HeartbeatThatForgets",
       [](Conversation& c) {
         const std::size_t last = find_last(c, [](const Event& e) {
           return is_sedp(e) && e.heartbeat() != nullptr && e.heartbeat()->last > 1;
         });
         auto heartbeat = *c.events[last].heartbeat();
         heartbeat.last = 1;
         c.events[last].content = heartbeat;
       },
       Fault::heartbeat_range},
      {"DataThatNobodyAskedFor",
       [](Conversation& c) {
         repeat(
             c, [](const Event& e) { return is_sedp(e) && e.data() != nullptr && e.has_info_dst; },
             ms);
         repeat(
             c, [](const Event& e) { return is_sedp(e) && e.data() != nullptr && e.has_info_dst; },
             2 * ms);
       },
       Fault::data_cause},
      {"AcknackAgain", [](Conversation& c) { repeat(c, asks, 20'000); }, Fault::acknack_early},
      {"AcknackOfWhatIsNot",
       [](Conversation& c) {
         Event& event = c.events[find(c, asks)];
         auto acknack = *event.acknack();
         acknack.missing.base += 3;
         event.content = acknack;
       },
       Fault::acknack_content}};
  return list;
}

class CycloneMistake : public ::testing::TestWithParam<Wrong> {};
TEST_P(CycloneMistake, BreaksARule) {
  const model::Scenario scenario = long_run(1, "cyclonedds-0.10");
  Simulated run = simulated(scenario);
  GetParam().edit(run.conversation);
  Bounds bounds = bounds_of(scenario, run);
  bounds.least_delay_ns = ms;
  const Conformance result = conformance(run.conversation, scenario.dds, bounds);
  EXPECT_TRUE(std::ranges::any_of(result.unexplained, [](const Unexplained& one) {
    return one.fault == GetParam().fault;
  })) << description(result);
}
INSTANTIATE_TEST_SUITE_P(Edited, CycloneMistake, ::testing::ValuesIn(mistakes()),
                         [](const auto& one) { return std::string{one.param.name}; });

/// Readers that ask before the writer's first HEARTBEAT has come.
TEST(CycloneCounts, PreEmptiveAcknacksHaveNone) {
  model::Scenario scenario = long_run(1, "cyclonedds-0.10");
  scenario.dds.sedp.preemptive_ack_delay = model::Nanoseconds{ms / 10};
  Simulated run = simulated(scenario);
  const Bounds bounds = bounds_of(scenario, run);
  const Conformance before = conformance(run.conversation, scenario.dds, bounds);
  EXPECT_TRUE(is_explained(before)) << description(before);
  const std::size_t first = find(run.conversation, [](const Event& event) {
    return is_sedp(event) && event.acknack() != nullptr && event.acknack()->is_initial();
  });
  auto acknack = *run.conversation.events[first].acknack();
  acknack.count = 1;
  run.conversation.events[first].content = acknack;
  const Conformance result = conformance(run.conversation, scenario.dds, bounds);
  ASSERT_EQ(result.unexplained.size(), 1U) << description(result);
  EXPECT_EQ(result.unexplained.front().event, first);
  EXPECT_EQ(result.unexplained.front().fault, Fault::acknack_count);
}

}  // namespace cyclone_test
}  // namespace stormproof::conform::testing
