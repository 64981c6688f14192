// Every claim of the explorer can fail: plausible mistakes in the tables, in the scheduling of
// events and in the knobs break the property that is about them, with a counterexample that the
// simulator, run with the same mistake, confirms.
#include <array>

#include <gtest/gtest.h>

#include "checker/engines/explorer/explorer.hpp"
#include "fsm/descriptor_repair.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/heartbeat_timer.hpp"
#include "fsm/reflect.hpp"
#include "tests/checker/engines/explorer/mistakes.hpp"

namespace stormproof::explorer {
namespace mutant_test {

using fsm::TableMutation;
using model::EventKind;
using model::EventMutation;
using model::Nanoseconds;
using props::VerdictKind;

struct Case {
  const char* name;
  const char* property;
  checker::Mutant mutant;
  bool partial = false;  ///< one descriptor a packet, `acknowledge: prefix`
};

/// As a test is named in messages.
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

checker::Mutant knob(std::function<void(model::SedpProfile&)> change) {
  checker::Mutant mutant;
  mutant.knobs = [change](model::Scenario& scenario) { change(scenario.dds.sedp); };
  return mutant;
}

constexpr fsm::StateId state_u = fsm::Reflect<fsm::DescriptorRepair>::id<fsm::descriptor_repair::U>;
constexpr fsm::StateId state_q = fsm::Reflect<fsm::DescriptorRepair>::id<fsm::descriptor_repair::Q>;

std::vector<Case> cases() {
  using Repair = fsm::DescriptorRepair;
  using Kind = TableMutation::Kind;
  checker::Mutant live;
  live.rules.live_bitmaps = true;
  checker::Mutant forever =
      table({"HeartbeatTimer", row<fsm::HeartbeatTimer>("Armed", "Expired", "Armed"),
             Kind::ignore_guard});
  forever.rules.tables.push_back(
      {"HeartbeatTimer", row<fsm::HeartbeatTimer>("Armed", "Expired", "Idle"), Kind::drop_row});
  return {
      {"acknowledges_what_is_listed", "safety.ack-implies-received",
       table({"DescriptorRepair", row<Repair>("U", "AckNackReceived", "A"), Kind::ignore_guard})},
      {"acknowledges_instead_of_requesting", "live.no-stall",
       table({"DescriptorRepair", row<Repair>("U", "AckNackReceived", "A"), Kind::ignore_guard})},
      {"repairs_are_never_due", "live.no-stall",
       table({"DescriptorRepair", row<Repair>("R", "RepairDue", "Q"), Kind::drop_row})},
      {"repairs_are_not_generated", "live.no-stall",
       table({"DescriptorRepair", row<Repair>("R", "RepairDue", "Q"), Kind::drop_action})},
      {"heartbeats_end", "live.no-stall",
       event({EventKind::heartbeat_expiry, EventMutation::Change::forget, {}, {}})},
      {"acknacks_are_never_due", "live.completion",
       event({EventKind::acknack_generation, EventMutation::Change::forget, {}, {}})},
      {"repairs_what_nobody_asked_for", "safety.repair-only-if-asked",
       table({"DescriptorRepair", row<Repair>("R", "RepairDue", "Q"), Kind::copy_row, state_u,
              state_q}),
       true},
      {"bitmaps_are_live", "safety.snapshot", std::move(live)},
      {"two_expiries", "timer.single-heartbeat",
       event({EventKind::heartbeat_expiry, EventMutation::Change::duplicate, {}, {}})},
      {"additive_timers", "timer.single-heartbeat", knob([](model::SedpProfile& sedp) {
         sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
       })},
      {"suppression_a_nanosecond_short", "timer.suppression-honoured",
       event({EventKind::suppression_end, EventMutation::Change::shift, Nanoseconds{-1}, {}})},
      {"no_suppression", "timer.suppression-honoured",
       knob([](model::SedpProfile& sedp) { sedp.nack_suppression_duration = Nanoseconds{0}; })},
      {"repairs_late", "live.completion",
       event({EventKind::repair_generation, EventMutation::Change::shift, Nanoseconds{1}, {}})},
      {"acknacks_late", "live.completion",
       knob([](model::SedpProfile& sedp) { sedp.heartbeat_response_delay += Nanoseconds{1}; })},
      {"heartbeats_to_everybody_forever", "live.quiescence", std::move(forever)},
  };
}

class Mutants : public testing::TestWithParam<Case> {};

TEST_P(Mutants, AreCaught) {
  const Case& c = GetParam();
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{100'000};
  // One packet is faster: then the explorer takes every delay up to the largest.
  scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{50'000}}};
  // Without initial ACKNACKs nothing but HEARTBEATs can help, and traffic does stop.
  scenario.dds.sedp.initial_acknack_delay = Nanoseconds{0};
  scenario.dds.sedp.heartbeat_recipients = model::HeartbeatRecipients::matched;
  if (c.partial) {
    scenario.dds.sedp.grouping = model::Grouping::single;
    scenario.dds.sedp.acknowledge = model::Acknowledge::prefix;
  }
  const std::array<std::string_view, 1> ids{c.property};

  const auto correct = explore(ids, {scenario, nullptr, {}});
  ASSERT_EQ(correct.size(), 1U);
  EXPECT_EQ(correct[0].second.kind, VerdictKind::bounded) << correct[0].second.how;

  const auto broken = explore(ids, {scenario, &c.mutant, {}});
  ASSERT_EQ(broken.size(), 1U);
  EXPECT_EQ(broken[0].second.kind, VerdictKind::violated) << broken[0].second.how;
}

INSTANTIATE_TEST_SUITE_P(Explorer, Mutants, testing::ValuesIn(cases()),
                         [](const auto& test) { return std::string{test.param.name}; });

}  // namespace mutant_test
}  // namespace stormproof::explorer
