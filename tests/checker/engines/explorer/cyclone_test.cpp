// The explorer and Cyclone DDS: what holds in the scopes that it exhausts, mistakes in tables,
// events and between the machines that break each claim in a run of the simulator, and paths at
// random, which are runs of the simulator as well.
#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "checker/engines/explorer/cyclone_messages.hpp"
#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/relation_world.hpp"
#include "fsm/composition/compositions.hpp"
#include "fsm/composition/effect_mutation.hpp"
#include "fsm/matched_reader.hpp"
#include "fsm/movable_timer.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/cyclone/endpoints.hpp"
#include "tests/checker/engines/explorer/mistakes.hpp"
#include "tests/checker/engines/explorer/walks.hpp"

namespace stormproof::explorer {
namespace cyclone_test {

using fsm::TableMutation;
using fsm::composition::EffectMutation;
using model::EventKind;
using model::EventMutation;
using model::Nanoseconds;
using props::Finding;
using props::VerdictKind;

constexpr std::array<std::string_view, 3> claims{"safety.ack-implies-received",
                                                 "safety.repair-only-if-asked", "live.no-stall"};

/// Every packet takes this long.
model::Scenario punctual(std::int64_t delay_ns) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.dds.implementation = model::ImplementationKind::cyclone;
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{delay_ns};
  return scenario;
}
/// One packet is faster, so the explorer takes every delay up to the largest that it can.
model::Scenario cyclone() {
  model::Scenario scenario = punctual(100'000);
  scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{50'000}}};
  return scenario;
}

Finding find(const Request& request, std::string_view property) {
  const std::array ids{property};
  checker::Findings findings = explore(ids, request);
  EXPECT_EQ(findings.size(), 1U) << property;
  return findings.empty() ? Finding{} : findings.front().second;
}

TEST(CycloneExplored, KeepsWhatItsRulesPromise) {
  for (const model::Scenario& scenario : {cyclone(), punctual(100'000)}) {
    for (const auto& [id, finding] : explore(claims, {scenario, nullptr, {}})) {
      EXPECT_EQ(finding.kind, VerdictKind::bounded) << id << ": " << finding.how;
      for (const char* const scope : {"D = 2, k = 2", "D = 2, k = 0, 1 created later"}) {
        EXPECT_NE(finding.how.find(scope), std::string::npos) << finding.how;
      }
      EXPECT_EQ(finding.how.find("not decided"), std::string::npos) << finding.how;
    }
  }
}

TEST(CycloneExplored, IsNotAskedForWhatHasNoMeaningOrMonitor) {
  const std::array<std::string_view, 3> others{"safety.snapshot", "timer.single-heartbeat",
                                               "live.completion"};
  const model::Scenario scenario = cyclone();
  EXPECT_TRUE(explore(others, {scenario, nullptr, {}}).empty());
}

TEST(CycloneExplored, IsOneRelationWhoeverAsksForMore) {
  const model::Scenario scenario = punctual(100'000);
  const Request several{scenario, nullptr, {}, 2, 1, {}, 2};
  const Finding finding = find(several, "live.no-stall");
  EXPECT_EQ(finding.kind, VerdictKind::bounded) << finding.how;
  EXPECT_EQ(finding.how.find("readers"), std::string::npos) << finding.how;
  EXPECT_EQ(finding.how, find({scenario, nullptr, {}}, "live.no-stall").how);
}

TEST(CycloneExplored, HoldsNothingWithoutAnExhaustedScope) {
  const model::Scenario scenario = cyclone();
  const Finding finding = find({scenario, nullptr, {}, 1, 0}, "live.no-stall");
  EXPECT_EQ(finding.kind, VerdictKind::inconclusive) << finding.how;
}

// Mistakes. --------------------------------------------------------------------------------------

struct Case {
  const char* name;
  const char* property;
  checker::Mutant mutant;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

checker::Mutant event(EventKind kind, EventMutation::Change change, Nanoseconds by = {}) {
  return explorer::event({kind, change, by, {}});
}
checker::Mutant effect(std::string_view name, EffectMutation::Change change) {
  checker::Mutant mutant;
  for (const EffectMutation& each :
       fsm::composition::effect_mutations(fsm::composition::compositions().at(2))) {
    if (each.effect == name && each.change == change) mutant.rules.effects.push_back(each);
  }
  EXPECT_EQ(mutant.rules.effects.size(), 1U) << name;
  return mutant;
}
checker::Mutant takes_requests_for_replies() {
  return table({"MatchedReader", row<fsm::MatchedReader>("Silent", "AckNackReceived", "Replied"),
                TableMutation::Kind::ignore_guard});
}

std::vector<Case> cases() {
  using Change = EventMutation::Change;
  return {
      {"a_request_counts_as_a_reply", "safety.ack-implies-received", takes_requests_for_replies()},
      {"a_sample_is_repeated_twice", "safety.repair-only-if-asked",
       effect("RepeatListed.4", EffectMutation::Change::twice)},
      {"acknacks_that_are_not_taken_are_answered", "safety.repair-only-if-asked",
       effect("AckNackArrives.2:if1", EffectMutation::Change::always)},
      {"a_timer_that_comes_does_not_join_the_list", "live.no-stall",
       table({"MovableTimer", row<fsm::MovableTimer>("Scheduled", "Came", "Listed"),
              TableMutation::Kind::drop_row})},
      {"the_heartbeat_timer_never_comes", "live.no-stall",
       event(EventKind::heartbeat_time, Change::forget)},
      {"the_heartbeat_timer_comes_late", "live.no-stall",
       event(EventKind::heartbeat_time, Change::shift, Nanoseconds{1})},
      {"the_ack_timer_never_comes", "live.no-stall", event(EventKind::ack_time, Change::forget)},
      {"threads_never_run", "live.no-stall", event(EventKind::thread_run, Change::forget)},
      {"requests_list_nothing", "live.no-stall", effect("Reply.3", EffectMutation::Change::drop)},
      {"requests_are_not_answered", "live.no-stall",
       effect("AckNackArrives.7", EffectMutation::Change::drop)},
      {"creations_do_not_hasten_heartbeats", "live.no-stall",
       effect("DescriptorIsCreated.5", EffectMutation::Change::drop)},
  };
}

class CycloneMutants : public testing::TestWithParam<Case> {};

TEST_P(CycloneMutants, AreCaught) {
  const Case& c = GetParam();
  const model::Scenario scenario = cyclone();
  const Finding finding = find({scenario, &c.mutant, {}}, c.property);
  ASSERT_EQ(finding.kind, VerdictKind::violated) << finding.how;
  ASSERT_TRUE(finding.counterexample);
  EXPECT_EQ(finding.counterexample->scenario.deployment.size(), 2U);
  EXPECT_TRUE(model::config::is_valid(finding.counterexample->scenario)) << "can be written";
}

INSTANTIATE_TEST_SUITE_P(Explorer, CycloneMutants, testing::ValuesIn(cases()),
                         [](const auto& test) { return std::string{test.param.name}; });

// The simulator. ---------------------------------------------------------------------------------

Scope scope_of(std::int64_t delay_ns, unsigned samples, unsigned losses, unsigned pushed) {
  Scope scope;
  scope.descriptors = samples;
  scope.losses = losses;
  scope.pushed = pushed;
  scope.least_delay = Nanoseconds{1};
  scope.largest_delay = Nanoseconds{delay_ns};
  scope.side_by_side = true;
  return scope;
}

TEST(CycloneExplored, IsWhatTheSimulatorRuns) {
  for (const unsigned samples : {1U, 2U}) {
    for (const unsigned losses : {0U, 1U, 2U}) {
      // What is created when a HEARTBEAT is due may share its packet, or not, because of others.
      for (const auto& [delay_ns, pushed] :
           {std::pair{20'000'000, 0U}, {100'000'000, 0U}, {100'000, 1U}}) {
        const model::Scenario scenario = cyclone();
        const Walks walks =
            walk<RelationWorld>(scenario, scope_of(delay_ns, samples, losses, pushed));
        EXPECT_EQ(walks.refused, 0U) << walks.why;
      }
    }
  }
}

TEST(CycloneExplored, ThatIsMisreadIsNot) {
  const model::Scenario scenario = cyclone();
  const Scope scope = scope_of(20'000'000, 2, 1, 0);
  for (const char* const name : {"MoveAckTimer.3", "RepeatListed.4", "Reply.3"}) {
    const model::Mutation misread = effect(name, EffectMutation::Change::drop).rules;
    EXPECT_GT(walk<RelationWorld>(scenario, scope, misread).refused, 0U) << name;
  }
  Request request{scenario, nullptr, {}};
  request.misread = takes_requests_for_replies().rules;
  const Finding finding = find(request, "safety.ack-implies-received");
  EXPECT_EQ(finding.kind, VerdictKind::disputed) << finding.how;
  EXPECT_FALSE(finding.counterexample);
}

TEST(CycloneExplored, SamplesFitIntoOnePacketWithWhatOthersSay) {
  std::int64_t bytes = model::cyclone::header_bytes + model::cyclone::destination_bytes;
  for (unsigned d = 0; d < most_samples; ++d) {
    bytes += message_of({What::data, Slot::from_repair, member(d)}).bytes;
    // Created before the next publication.
    if (d > 0) bytes += model::cyclone::data_bytes(model::cyclone::writer::subscriptions, d - 1);
  }
  bytes += model::cyclone::data_bytes(model::cyclone::writer::liveliness, 0);
  bytes += model::cyclone::writer::first_topic * model::cyclone::heartbeat_bytes;
  EXPECT_LE(bytes, model::SedpProfile{}.max_rexmit_message_size.count());
}

}  // namespace cyclone_test
}  // namespace stormproof::explorer
