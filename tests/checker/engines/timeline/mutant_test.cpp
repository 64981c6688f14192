// Mistakes in the rules are noticed: the boundary runs no longer do what was proved.
#include <gtest/gtest.h>

#include "fsm/machines.hpp"
#include "tests/checker/engines/timeline/requests.hpp"

namespace stormproof::timeline {
namespace mutant_test {

using model::EventKind;
using model::EventMutation;
using model::Nanoseconds;
using props::VerdictKind;

VerdictKind verdict(std::string_view property, const model::Mutation& rules) {
  checker::Mutant mutant;
  mutant.rules = rules;
  return finding_about(property, quiet_scenario(), &mutant).kind;
}

model::Mutation event(EventKind kind, EventMutation::Change change, Nanoseconds by = {}) {
  model::Mutation rules;
  rules.events.push_back({kind, change, by, {}});
  return rules;
}

/// The row of DescriptorRepair from `source` on `event`, retargeted.
model::Mutation retargeted(std::string_view source, std::string_view event_name,
                           std::string_view target) {
  for (const fsm::MachineInfo& machine : fsm::machines()) {
    if (machine.name != "DescriptorRepair") continue;
    const auto state = [&](std::string_view name) {
      return static_cast<std::uint8_t>(
          std::find(machine.states.begin(), machine.states.end(), name) - machine.states.begin());
    };
    for (std::size_t k = 0; k < machine.rows.size(); ++k) {
      if (machine.states[machine.rows[k].source] != source ||
          machine.events[machine.rows[k].event] != event_name) {
        continue;
      }
      model::Mutation rules;
      rules.tables.push_back(
          {std::string{machine.name}, k, fsm::TableMutation::Kind::retarget, 0, state(target)});
      return rules;
    }
  }
  ADD_FAILURE() << "no such row";
  return {};
}

TEST(TimelineMutants, TheCorrectRulesAreNotObjectedTo) {
  for (const char* property : {"live.completion", "storm.single-copy", "storm.free-threshold"}) {
    EXPECT_EQ(verdict(property, {}), VerdictKind::proved) << property;
  }
}

TEST(TimelineMutants, AckNackOneNanosecondLate) {
  const auto rules =
      event(EventKind::acknack_generation, EventMutation::Change::shift, Nanoseconds{1});
  for (const char* property : {"live.completion", "storm.free-threshold"}) {
    EXPECT_EQ(verdict(property, rules), VerdictKind::violated) << property;
  }
}

TEST(TimelineMutants, SuppressionOneNanosecondShort) {
  const auto rules =
      event(EventKind::suppression_end, EventMutation::Change::shift, Nanoseconds{-1});
  EXPECT_EQ(verdict("storm.single-copy", rules), VerdictKind::violated);
  EXPECT_EQ(verdict("live.completion", rules), VerdictKind::violated);
}

TEST(TimelineMutants, RepairOneNanosecondLate) {
  const auto rules =
      event(EventKind::repair_generation, EventMutation::Change::shift, Nanoseconds{1});
  EXPECT_EQ(verdict("live.completion", rules), VerdictKind::violated);
}

TEST(TimelineMutants, ForgottenExpiry) {
  const auto rules = event(EventKind::heartbeat_expiry, EventMutation::Change::forget);
  for (const char* property : {"live.completion", "storm.single-copy"}) {
    EXPECT_EQ(verdict(property, rules), VerdictKind::violated) << property;
  }
}

TEST(TimelineMutants, SuppressionThatEndsInAnotherState) {
  for (const char* target : {"S", "R", "A"}) {
    EXPECT_EQ(verdict("live.completion", retargeted("S", "SuppressionEnded", target)),
              VerdictKind::violated)
        << target;
  }
}

TEST(TimelineMutants, AdditiveTimers) {
  checker::Mutant mutant;
  mutant.knobs = [](model::Scenario& scenario) {
    scenario.dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  };
  EXPECT_EQ(finding_about("live.completion", quiet_scenario(), &mutant).kind,
            VerdictKind::violated);
}

TEST(TimelineMutants, FastDdsWithoutResponsesOrExpiries) {
  model::Scenario scenario = quiet_scenario();
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  checker::Mutant mutant;
  EXPECT_EQ(finding_about("live.completion", scenario, &mutant).kind, VerdictKind::proved);
  for (const EventKind kind :
       {EventKind::nack_response, EventKind::heartbeat_expiry, EventKind::suppression_end}) {
    mutant.rules = event(kind, EventMutation::Change::forget);
    EXPECT_EQ(finding_about("live.completion", scenario, &mutant).kind, VerdictKind::violated);
  }
}

TEST(TimelineMutants, LateReceptions) {
  model::Mutation rules;
  rules.events.push_back({EventKind::delayed_reception,
                          EventMutation::Change::reclass,
                          {},
                          model::EventClass::dispatch});
  EXPECT_EQ(verdict("storm.free-threshold", rules), VerdictKind::violated);
}

}  // namespace mutant_test
}  // namespace stormproof::timeline
