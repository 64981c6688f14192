// Several readers of one writer: what couples them shows, mistakes that concern others than the one
// reader are found, and what is explored is what the simulator does.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/relation_world.hpp"
#include "fsm/composition/compositions.hpp"
#include "fsm/composition/effect_mutation.hpp"
#include "tests/checker/engines/explorer/walks.hpp"

namespace stormproof::explorer {
namespace several_readers_test {

using fsm::composition::EffectMutation;
using model::Nanoseconds;
using props::Finding;
using props::VerdictKind;

model::Scenario wired(model::ImplementationKind implementation) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.dds.implementation = implementation;
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{100'000};
  return scenario;
}

Finding find(const model::Scenario& scenario, std::string_view property, unsigned readers,
             const checker::Mutant* mutant = nullptr) {
  const std::array ids{property};
  return explore(ids, {scenario, mutant, {}, readers}).at(0).second;
}

TEST(SeveralReaders, AreExploredOnlyOnDemandAndNamedInTheVerdict) {
  const model::Scenario scenario = wired(model::ImplementationKind::paper);
  const Finding one = find(scenario, "live.no-stall", 1);
  EXPECT_EQ(one.how.find("readers"), std::string::npos) << one.how;
  EXPECT_EQ(one.assumptions.front().find("One relation;"), 0U);
  const Finding two = find(scenario, "live.no-stall", 2);
  EXPECT_EQ(two.kind, VerdictKind::bounded) << two.how;
  EXPECT_NE(two.how.find("k = 2, 2 readers, each packet 100 µs"), std::string::npos) << two.how;
  EXPECT_EQ(two.assumptions.front().find("One relation, or 2 of one writer;"), 0U);
}

TEST(SeveralReaders, MayBeThree) {
  for (const auto implementation :
       {model::ImplementationKind::paper, model::ImplementationKind::fastdds}) {
    const Finding three = find(wired(implementation), "live.no-stall", 3);
    EXPECT_EQ(three.kind, VerdictKind::bounded) << three.how;
    EXPECT_NE(three.how.find("k = 2, 3 readers, each packet 100 µs"), std::string::npos)
        << three.how;
    EXPECT_EQ(three.assumptions.front().find("One relation, or 3 of one writer;"), 0U);
  }
}

TEST(SeveralReaders, CorrectRulesKeepWhatTheyKeepForOne) {
  for (const auto implementation :
       {model::ImplementationKind::paper, model::ImplementationKind::fastdds}) {
    const model::Scenario scenario = wired(implementation);
    for (const char* id : {"safety.ack-implies-received", "safety.repair-only-if-asked",
                           "safety.snapshot", "timer.single-heartbeat", "live.no-stall",
                           "timer.suppression-honoured", "live.completion", "live.quiescence"}) {
      const Finding one = find(scenario, id, 1);
      const Finding two = find(scenario, id, 2);
      EXPECT_EQ(two.kind, one.kind) << id << ": " << two.how;
    }
  }
}

struct Mistake {
  const char* name;
  model::ImplementationKind implementation;
  const char* effect;  ///< the id of the effect, or of the first one in the loop
  EffectMutation::Change change;
  const char* property;
};
void PrintTo(const Mistake& m, std::ostream* out) { *out << m.name; }

checker::Mutant mutant_of(const Mistake& mistake) {
  const bool fastdds = mistake.implementation == model::ImplementationKind::fastdds;
  const auto& composition = fsm::composition::compositions().at(fastdds ? 1 : 0);
  checker::Mutant mutant;
  for (const EffectMutation& each : fsm::composition::effect_mutations(composition)) {
    const bool is_it = each.effect == mistake.effect && each.change == mistake.change;
    if (is_it) mutant.rules.effects.push_back(each);
  }
  EXPECT_EQ(mutant.rules.effects.size(), 1U) << "no such effect";
  return mutant;
}

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, ThatConcernOtherReadersShowWithTwoAndNotWithOne) {
  const Mistake& mistake = GetParam();
  const model::Scenario scenario = wired(mistake.implementation);
  const checker::Mutant mutant = mutant_of(mistake);
  EXPECT_EQ(find(scenario, mistake.property, 1, &mutant).kind, VerdictKind::bounded);
  EXPECT_EQ(find(scenario, mistake.property, 2).kind, VerdictKind::bounded);
  const Finding found = find(scenario, mistake.property, 2, &mutant);
  ASSERT_EQ(found.kind, VerdictKind::violated) << found.how;
  EXPECT_EQ(found.counterexample->scenario.deployment.size(), 3U);
  EXPECT_NE(found.counterexample->steps.front().find("(reader 0)"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    SeveralReaders, Mistakes,
    testing::Values(Mistake{"an_acknack_counts_for_everybody", model::ImplementationKind::paper,
                            "AckNackArrives.3", EffectMutation::Change::every_reader,
                            "safety.ack-implies-received"},
                    Mistake{"only_one_reader_is_answered", model::ImplementationKind::fastdds,
                            "NackResponds.2:if2", EffectMutation::Change::first_only,
                            "live.completion"}),
    [](const auto& test) { return std::string{test.param.name}; });

TEST(SeveralReaders, ThePapersWorldDoesWhatTheSimulatorDoes) {
  model::Scenario scenario = wired(model::ImplementationKind::paper);
  scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{1}}};  // any delay
  for (const auto piggyback : {model::Piggyback::linear, model::Piggyback::cumulative}) {
    scenario.dds.sedp.piggyback = piggyback;
    scenario.dds.sedp.piggyback_threshold_bytes = model::Bytes{500};
    scenario.dds.sedp.grouping = model::Grouping::single;
    for (Scope scope : shared_scopes(scenario, Nanoseconds{200'000'000}, 2)) {
      scope.descriptors = 2;
      const Walks walks = walk<RelationWorld>(scenario, scope);
      EXPECT_EQ(walks.refused, 0U) << to_text(scope) << ": " << walks.why;
    }
  }
}

TEST(SeveralReaders, FastDdssWorldDoesWhatTheSimulatorDoes) {
  model::Scenario scenario = wired(model::ImplementationKind::fastdds);
  scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{1}}};
  for (const Scope& scope : shared_scopes(scenario, Nanoseconds{200'000'000}, 2)) {
    const Walks walks = walk<RelationWorld>(scenario, scope);
    EXPECT_EQ(walks.refused, 0U) << to_text(scope) << ": " << walks.why;
  }
}

}  // namespace several_readers_test
}  // namespace stormproof::explorer
