// composition.total and composition.live: what they say of correct rules, and what they notice.
#include <algorithm>
#include <set>

#include "checker/engines/tables/effect_system.hpp"
#include "model/composition_of.hpp"
#include "tests/checker/engines/tables/effect_mistake.hpp"
#include "tests/checker/engines/tables/table_check.hpp"

namespace stormproof::tables {
namespace composition_live_test {

using Kind = fsm::TableMutation::Kind;
using model::EventKind;

checker::Mutant forgets(EventKind event) {
  checker::Mutant mutant;
  mutant.rules.events.push_back({event, model::EventMutation::Change::forget, {}, {}});
  return mutant;
}
model::Scenario adaptive(model::Scenario scenario) {
  scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  return scenario;
}
model::Scenario without_initial_acknacks(model::Scenario scenario) {
  scenario.dds.sedp.initial_acknack_delay = model::Nanoseconds{0};
  return scenario;
}
/// The line of the finding that begins so, or "".
std::string line(const Finding& finding, const std::string& begin) {
  for (const std::string& each : finding.details) {
    if (each.starts_with(begin)) return each;
  }
  return "";
}

TEST(Total, HoldsWithoutASolver) {
  for (const model::Scenario& scenario : {paper(), fastdds()}) {
    const Finding finding = decide("composition.total", scenario);
    EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
    EXPECT_EQ(finding.solver, "");
  }
}

TEST(Total, NoticesATimerThatIsNeverStarted) {
  expect_violated("composition.total", paper(), forgets(EventKind::repair_generation),
                  "timer RepairGeneration is started by nothing (rule RepairIsDue)");
  expect_violated("composition.total", fastdds(), forgets(EventKind::nack_response),
                  "timer NackResponseDue is started by nothing (rule NackResponds)");
}

TEST(Live, EachEffectHappensOrAKnobRulesItOut) {
  for (const model::Scenario& scenario :
       {paper(), fastdds(), adaptive(paper()), adaptive(fastdds()),
        without_initial_acknacks(paper()), without_initial_acknacks(fastdds())}) {
    expect_proved("composition.live", scenario);
  }
}

TEST(Live, NamesTheKnob) {
  const Finding periodic = decide("composition.live", paper());
  EXPECT_NE(
      line(periodic, "ruled out by dds.sedp.heartbeat_policy: periodic").find("CycleGoesOn.1-14"),
      std::string::npos);
  EXPECT_EQ(line(periodic, "ruled out by dds.sedp.relation_opening"),
            "ruled out by dds.sedp.relation_opening: receiver: Hear.9");
  const Finding without = decide("composition.live", without_initial_acknacks(fastdds()));
  EXPECT_NE(
      line(without, "ruled out by dds.sedp.initial_acknack_delay: 0s").find("AckNackArrives.1-6"),
      std::string::npos);
}

/// What one profile rules out happens under another: nothing in the rules is dead.
TEST(Live, EveryEffectHappensUnderSomeProfile) {
  model::Scenario each_side = paper();
  each_side.dds.sedp.relation_opening = model::RelationOpening::each_side;
  each_side.dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  each_side.dds.spdp.resend = model::SpdpResend::new_only;
  model::Scenario multicast = paper();
  multicast.dds.spdp.resend = model::SpdpResend::new_and_multicast;
  const std::vector<model::Scenario> all{paper(), each_side, multicast, adaptive(paper())};
  std::set<std::string> never;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Finding finding = decide("composition.live", all[k]);
    EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
    std::set<std::string> here;
    for (const std::string& each : finding.details) {
      const std::size_t ids =
          each.starts_with("ruled out by ") ? each.rfind(": ") : std::string::npos;
      for (std::size_t at = ids; at != std::string::npos; at = each.find(", ", at + 1)) {
        here.insert(each.substr(at + 2, each.find(", ", at + 1) - at - 2));
      }
    }
    if (k == 0) never = here;
    std::erase_if(never, [&](const std::string& ids) { return !here.contains(ids); });
  }
  EXPECT_TRUE(never.empty()) << *never.begin();
}

TEST(Live, NoticesWhatNoKnobAllows) {
  expect_violated("composition.live", paper(), forgets(EventKind::suppression_end),
                  "no knobs let it happen: feed each C (SuppressionEnds.1 at "
                  "fsm/composition/paper.hpp:");
  const std::size_t asked = row_of("SingleShot", "Idle", "Requested", "Pending");
  expect_violated("composition.live", fastdds(), with_row("SingleShot", asked, Kind::drop_action),
                  "no knobs let it happen: feed NackResponse (NackResponds.1 at");
}

/// The derivation counts effects as the recorder does, so that ids mean the same.
TEST(EffectSystem, HasEveryEffectThatIsRecordedAndNoOther) {
  for (const model::Scenario& scenario : {paper(), fastdds()}) {
    z3::context context;
    const smt::SymbolicContext current{context};
    const auto& recorded = model::composition_of(scenario.dds);
    const EffectSystem effects = effect_system(scenario.dds, {}, recorded);
    for (std::size_t e = 0; e < effects.effects.size(); ++e) {
      const Expr& mark = effects.system.variables[e];
      EXPECT_EQ(mark.decl().name().str(), mark_of(effects.effects[e]));
      EXPECT_TRUE(std::ranges::any_of(effects.system.steps, [&](const SystemStep& step) {
        return !z3::eq(step.next[e], mark);
      })) << effects.effects[e];
    }
  }
}

TEST(LiveOfCycloneDds, EachEffectHappensInARun) {
  const Finding finding = decide("composition.live", cyclone());
  EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
  EXPECT_NE(line(finding, "for the first time in run 1: "), "");
}

/// It has to happen with other knobs.
TEST(LiveOfCycloneDds, WhatAKnobExcludesIsNamed) {
  model::Scenario scenario = cyclone();
  scenario.dds.sedp.merge_queued_rexmit = model::MergeQueued::no;
  const Finding finding = decide("composition.live", scenario);
  EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
  EXPECT_EQ(line(finding, "excluded by "),
            "excluded by dds.sedp.merge_queued_rexmit: false: RepeatListed.3");
  const auto shows = [](const std::string& each) {
    return each.starts_with("for the first time in run ") &&
           each.ends_with(" with other knobs: RepeatListed.3");
  };
  EXPECT_EQ(std::ranges::count_if(finding.details, shows), 1);
}

TEST(LiveOfCycloneDds, WhatNoRunShowsIsNamed) {
  const checker::Mutant mutant = forgets(EventKind::heartbeat_time);
  const Finding finding = decide("composition.live", cyclone(), &mutant);
  EXPECT_EQ(finding.kind, VerdictKind::inconclusive) << finding.how;
  EXPECT_NE(finding.how.find("no run shows HeartbeatTimerIsTaken.1-9"), std::string::npos)
      << finding.how;
}

TEST(LiveOfADiscoveryServer, EachEffectHappensInARun) {
  using enum model::ServerKnown;
  for (const auto discovery : {model::Discovery::server, model::Discovery::super_client}) {
    for (const auto& [relay, known] :
         {std::pair{model::Relay::repeat, guid}, std::pair{model::Relay::once, guid},
          std::pair{model::Relay::once, locator}}) {
      model::Scenario scenario = with_server();
      scenario.dds.discovery = discovery;
      scenario.dds.server.relay = relay;
      scenario.dds.server.known = known;
      const Finding finding = decide("composition.live", scenario);
      EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
      EXPECT_NE(line(finding, "for the first time in run 1: "), "");
      const bool by_guid = known == guid;
      EXPECT_EQ(line(finding, "excluded by dds.server_known: guid: ") != "", by_guid);
      EXPECT_EQ(line(finding, "excluded by dds.server_known: locator: ") != "", !by_guid);
    }
  }
}

TEST(LiveOfADiscoveryServer, WhatHappensWithOtherKnobsOnlyIsNotProved) {
  model::Scenario scenario = with_server();
  scenario.dds.server.client_sync_period = model::Nanoseconds{100'000'000'000};  // beyond each run
  const Finding finding = decide("composition.live", scenario);
  EXPECT_EQ(finding.kind, VerdictKind::sampled) << finding.how;
  const std::string other = line(finding, "for the first time in run 1 with other knobs: ");
  EXPECT_NE(other.find("ClientSyncIsDue.4-7"), std::string::npos) << other;
}

/// An event that never comes, a row whose action is forgotten, an effect that somebody left out.
TEST(LiveOfADiscoveryServer, WhatNoRunShowsIsNamed) {
  const std::size_t asked = row_of("SingleShot", "Idle", "Requested", "Pending");
  const std::vector<std::pair<checker::Mutant, std::string>> dead{
      {forgets(EventKind::server_routine), "RoutineRuns.1"},
      {with_row("SingleShot", asked, Kind::drop_action), "RegistrationExpires.1"},
      {at_effect(with_server(), "ClientSyncIsDue", "raise LearnerOpens",
                 fsm::composition::EffectMutation::Change::drop),
       "ClientSyncIsDue.1"}};
  for (const auto& [mutant, effect] : dead) {
    const Finding finding = decide("composition.live", with_server(), &mutant);
    EXPECT_EQ(finding.kind, VerdictKind::inconclusive) << finding.how;
    EXPECT_NE(finding.how.find("no run shows "), std::string::npos) << finding.how;
    EXPECT_NE(finding.how.find(effect), std::string::npos) << finding.how;
  }
}

}  // namespace composition_live_test
}  // namespace stormproof::tables
