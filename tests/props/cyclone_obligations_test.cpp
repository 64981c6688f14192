// What is observed of Cyclone DDS's writer besides its acknowledgments: correct runs keep it, and
// mistakes in its rules, tables and events are noticed.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "fsm/composition/compositions.hpp"
#include "model/mutation.hpp"
#include "model/simulator.hpp"
#include "props/monitor.hpp"
#include "tests/oracle/sharp_scenario.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::props {
namespace cyclone_obligations_test {

using Change = fsm::composition::EffectMutation::Change;
using EventChange = model::EventMutation::Change;

/// In how many random runs the property is violated.
int violated(std::string_view property, const model::Mutation* mistakes, int runs = 60) {
  int count = 0;
  for (int seed = 0; seed < runs; ++seed) {
    const model::Scenario scenario =
        oracle::varied_cyclone_scenario(static_cast<std::uint64_t>(seed));
    const auto monitor = make_monitor(property, scenario);
    model::RunOptions options;
    options.probe = monitor.get();
    options.mutation = mistakes;
    options.max_events = 10'000;
    const model::RunResult result = model::simulate(scenario, options);
    const bool is_over =
        result.end == model::RunEnd::time_limit || result.end == model::RunEnd::no_more_events;
    monitor->finish(is_over ? scenario.time_limit : result.end_time);
    if (mistakes == nullptr && monitor->violation()) {
      ADD_FAILURE() << "seed " << seed << ": " << monitor->violation()->reason;
    }
    count += monitor->violation() ? 1 : 0;
  }
  return count;
}

model::Mutation at_effect(std::string_view effect, Change change) {
  model::Mutation mistakes;
  for (const auto& composition : fsm::composition::compositions()) {
    if (composition.name != "cyclone") continue;
    for (const auto& mutation : fsm::composition::effect_mutations(composition)) {
      if (mutation.effect == effect && mutation.change == change) {
        mistakes.effects.push_back(mutation);
      }
    }
  }
  EXPECT_EQ(mistakes.effects.size(), 1U) << effect;
  return mistakes;
}
model::Mutation of_event(model::EventKind kind, EventChange change) {
  model::Mutation mistakes;
  mistakes.events.push_back({kind, change, {}, {}});
  return mistakes;
}

TEST(CycloneObligations, AreKeptByCorrectRuns) {
  for (const char* const property :
       {"safety.snapshot", "safety.repair-only-if-asked", "storm.feedback-gain", "live.no-stall"}) {
    EXPECT_EQ(violated(property, nullptr, 300), 0) << property;
  }
}

TEST(CycloneObligations, NoticeAckNacksThatAreNoSnapshots) {
  const std::vector<model::Mutation> mistakes{at_effect("DataArrives.3", Change::drop),
                                              at_effect("HeartbeatArrives.3", Change::drop),
                                              at_effect("DataArrives.2:if1", Change::always)};
  for (const model::Mutation& mistake : mistakes) {
    EXPECT_GT(violated("safety.snapshot", &mistake), 5) << mistake.effects.front().effect;
  }
}

TEST(CycloneObligations, NoticeRepairsThatNobodyAskedFor) {
  const model::Mutation twice = at_effect("RepeatListed.4", Change::twice);
  EXPECT_GT(violated("safety.repair-only-if-asked", &twice), 5);
  const model::Mutation pushed = at_effect("DescriptorIsCreated.6", Change::twice);
  EXPECT_GT(violated("safety.repair-only-if-asked", &pushed), 5);
}

TEST(CycloneObligations, NoticeAnswersToNothing) {
  const model::Mutation always = at_effect("RepeatListed.8:if1", Change::always);
  EXPECT_GT(violated("storm.feedback-gain", &always), 5);
}

TEST(CycloneObligations, NoticeThatNothingIsUnderWay) {
  const std::vector<model::Mutation> mistakes{
      of_event(model::EventKind::heartbeat_time, EventChange::forget),
      of_event(model::EventKind::thread_run, EventChange::forget),
      of_event(model::EventKind::spdp_time, EventChange::forget),
      at_effect("HeartbeatTimeHasCome.3", Change::drop),
      at_effect("HeartbeatTimerIsTaken.9", Change::drop)};
  for (const model::Mutation& mistake : mistakes) {
    EXPECT_GT(violated("live.no-stall", &mistake), 2)
        << (mistake.effects.empty() ? name_of(mistake.events.front().kind)
                                    : mistake.effects.front().effect);
  }
}

/// Two participants, some lost and late packets of a constant delay, and a minute.
model::Scenario troubled(model::Nanoseconds last_delay) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  for (model::Participant& participant : scenario.deployment.participants) {
    participant.endpoints_done = model::Nanoseconds{20'000'000};
  }
  scenario.dds.implementation = model::ImplementationKind::cyclone;
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = model::Nanoseconds{1'000'000};
  scenario.wireless.lost_packets = {4, 7, 8, 9, 12};
  scenario.wireless.packet_delays = {{5, model::Nanoseconds{0}, last_delay}};
  scenario.run_until = model::RunUntil::time_limit;
  scenario.time_limit = model::Nanoseconds{60'000'000'000};
  return scenario;
}
bool stalls(const model::Scenario& scenario, const model::Mutation* mistakes) {
  model::RunOptions options;
  options.mutation = mistakes;
  return run_monitored(scenario, scenario, options).violation("live.no-stall") != nullptr;
}

TEST(CycloneObligations, NoticeHeartbeatsThatBringNothing) {
  const model::Nanoseconds soon{3'000'000};
  EXPECT_FALSE(stalls(troubled(soon), nullptr));
  const model::Mutation unheard = at_effect("AckNackArrives.7", Change::drop);
  EXPECT_TRUE(stalls(troubled(soon), &unheard));
  const model::Nanoseconds not_long_ago{58'000'000'000};
  EXPECT_FALSE(stalls(troubled(not_long_ago), &unheard)) << "what is late may still bring it";
}

}  // namespace cyclone_obligations_test
}  // namespace stormproof::props
