// Both writers of one participant: what is explored is what the simulator does, what they share
// couples them, and what is each one's own must not be taken for the other's.
#include <array>

#include <gtest/gtest.h>

#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/relation_world.hpp"
#include "tests/checker/engines/explorer/tiny.hpp"
#include "tests/checker/engines/explorer/walks.hpp"

namespace stormproof::explorer {
namespace both_writers_test {

using model::Nanoseconds;
using props::Finding;
using props::VerdictKind;

constexpr std::array implementations{model::ImplementationKind::paper,
                                     model::ImplementationKind::fastdds};

model::Scenario wired(model::ImplementationKind implementation) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.dds.implementation = implementation;
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{100'000};
  return scenario;
}

Finding find(const model::Scenario& scenario, std::string_view property, unsigned writers) {
  const std::array ids{property};
  return explore(ids, {scenario, nullptr, {}, 1, 1, {}, writers}).at(0).second;
}

TEST(BothWriters, AreNamedInTheVerdict) {
  for (const auto implementation : implementations) {
    const Finding one = find(wired(implementation), "live.no-stall", 1);
    EXPECT_EQ(one.how.find("writers"), std::string::npos) << one.how;
    const Finding two = find(wired(implementation), "live.no-stall", 2);
    EXPECT_EQ(two.kind, VerdictKind::bounded) << two.how;
    EXPECT_NE(two.how.find("k = 2, two writers, each packet 100 µs"), std::string::npos) << two.how;
    EXPECT_EQ(two.assumptions.front().find("One relation, or one of each writer"), 0U);
  }
}

TEST(BothWriters, KeepWhatOneKeeps) {
  for (const auto implementation : implementations) {
    const model::Scenario scenario = wired(implementation);
    for (const char* id : {"safety.ack-implies-received", "safety.repair-only-if-asked",
                           "safety.snapshot", "timer.single-heartbeat",
                           "timer.suppression-honoured", "live.completion", "live.quiescence"}) {
      const Finding one = find(scenario, id, 1);
      const Finding two = find(scenario, id, 2);
      EXPECT_EQ(two.kind, one.kind) << id << ": " << two.how;
    }
  }
}

TEST(BothWriters, OfThePaperDoWhatTheSimulatorDoes) {
  model::Scenario scenario = wired(model::ImplementationKind::paper);
  scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{1}}};  // any delay
  scenario.dds.sedp.piggyback_threshold_bytes = model::Bytes{500};
  scenario.dds.sedp.grouping = model::Grouping::single;
  for (const auto piggyback : {model::Piggyback::linear, model::Piggyback::cumulative}) {
    scenario.dds.sedp.piggyback = piggyback;
    for (Scope scope : shared_scopes(scenario, Nanoseconds{200'000'000}, 1, 2)) {
      scope.descriptors = 2;
      const Walks walks = walk<RelationWorld>(scenario, scope);
      EXPECT_EQ(walks.refused, 0U) << to_text(scope) << ": " << walks.why;
    }
  }
}

TEST(BothWriters, OfFastDdsDoWhatTheSimulatorDoes) {
  model::Scenario scenario = wired(model::ImplementationKind::fastdds);
  scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{1}}};
  for (const std::int64_t limit : {65'000, 2'400}) {
    scenario.dds.sedp.grouping_limit_bytes = model::Bytes{limit};
    for (const Scope& scope : shared_scopes(scenario, Nanoseconds{200'000'000}, 1, 2)) {
      const Walks walks = walk<RelationWorld>(scenario, scope);
      EXPECT_EQ(walks.refused, 0U) << to_text(scope) << ": " << walks.why;
    }
  }
}

/// The mistake of a participant: packets of one kind reach the other writer, or its reader.
template <class World, What what>
class Crossed : public World {
 public:
  using World::World;
  void fire(typename World::State& state, Frame& frame, Slot slot) {
    if (slot.what == what) slot.relation ^= 1U;
    World::fire(state, frame, slot);
  }
};

Scope tiny_scope(unsigned losses) {
  Scope scope;
  scope.writers = 2;
  scope.losses = losses;
  scope.least_delay = Nanoseconds{1};
  scope.largest_delay = Nanoseconds{1};
  scope.leaves_within = Nanoseconds{1};
  return scope;
}

model::Scenario tiny(model::ImplementationKind implementation) {
  model::Scenario scenario = tiny_scenario();
  scenario.dds.implementation = implementation;
  scenario.dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  return scenario;
}

template <class World>
bool takes_for_acknowledged(const model::Scenario& scenario) {
  World world{scenario, scenario, tiny_scope(1), {}};
  SearchOptions options;
  options.claims = bit(Claim::ack_implies_received);
  const SearchResult result = Search<World>{world, options}.run();
  return result.objections[static_cast<std::size_t>(Claim::ack_implies_received)].has_value();
}

TEST(BothWriters, AWriterThatIsFedWithTheOthersAckNackIsNoticed) {
  const model::Scenario paper = tiny(model::ImplementationKind::paper);
  EXPECT_FALSE(takes_for_acknowledged<RelationWorld>(paper));
  EXPECT_TRUE((takes_for_acknowledged<Crossed<RelationWorld, What::acknack>>(paper)));
  const model::Scenario fastdds = tiny(model::ImplementationKind::fastdds);
  EXPECT_FALSE(takes_for_acknowledged<RelationWorld>(fastdds));
  EXPECT_TRUE((takes_for_acknowledged<Crossed<RelationWorld, What::acknack>>(fastdds)));
}

/// Paths of the wrong world that no run takes.
template <class World, What what>
unsigned refused(const model::Scenario& scenario) {
  return walk<Crossed<World, what>>(scenario, tiny_scope(1)).refused;
}

TEST(BothWriters, WhoseEventsAreTakenForTheOthersDoWhatNoRunDoes) {
  const model::Scenario paper = tiny(model::ImplementationKind::paper);
  EXPECT_EQ(walk<RelationWorld>(paper, tiny_scope(1)).refused, 0U);
  EXPECT_GT((refused<RelationWorld, What::repair_generation>(paper)), 0U);
  EXPECT_GT((refused<RelationWorld, What::heartbeat>(paper)), 0U);
  const model::Scenario fastdds = tiny(model::ImplementationKind::fastdds);
  EXPECT_EQ(walk<RelationWorld>(fastdds, tiny_scope(1)).refused, 0U);
  EXPECT_GT((refused<RelationWorld, What::nack_response>(fastdds)), 0U);
}

}  // namespace both_writers_test
}  // namespace stormproof::explorer
