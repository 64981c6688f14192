// safety.snapshot in the explorer: an ACKNACK is held against what its reader lacks when it is
// emitted, and what the writer takes from it against what has been emitted.
#include <array>

#include <gtest/gtest.h>

#include "checker/engines/explorer/claims.hpp"
#include "checker/engines/explorer/explorer.hpp"
#include "fsm/composition/compositions.hpp"
#include "fsm/composition/effect_mutation.hpp"
#include "tests/checker/engines/explorer/tiny.hpp"

namespace stormproof::explorer {
namespace snapshot_test {

using fsm::composition::EffectMutation;
using model::Nanoseconds;
using props::Finding;
using props::VerdictKind;

/// About three descriptors, of which the reader has these.
bool objects(const Slot& acknack, Members received, std::optional<Members> announced = {}) {
  const Scope scope;
  const EventRules rules{{}, false};
  Frame frame{scope, rules};
  object_to_listed(frame, acknack, received, 3, announced);
  return (frame.objections() & bit(Claim::snapshot)) != 0;
}

TEST(ExploredSnapshot, IsWhatTheReaderLacksWhenItIsEmitted) {
  EXPECT_FALSE(objects({What::acknack, 0, 0b110, 1}, 0b001));
  EXPECT_TRUE(objects({What::acknack, 0, 0b111, 1}, 0b001));
  EXPECT_TRUE(objects({What::acknack, 0, 0b100, 1}, 0b001));
}

TEST(ExploredSnapshot, MayBeOfWhatIsAnnouncedOnlyAndHasABase) {
  EXPECT_FALSE(objects({What::acknack, 0, 0b010, 1}, 0b001, 0b011));
  EXPECT_TRUE(objects({What::acknack, 0, 0b110, 1}, 0b001, 0b011));
  EXPECT_TRUE(objects({What::acknack, 0, 0b010, 0}, 0b001, 0b011));
  EXPECT_FALSE(objects({What::acknack, Slot::initial, 0, 0}, 0b001, 0b011));
  EXPECT_TRUE(objects({What::acknack, Slot::initial, 0b010, 1}, 0b001, 0b011));
}

TEST(ExploredSnapshot, IsWhatTheWriterTakes) {
  const Scope scope;
  const EventRules rules{{}, false};
  const Slot emitted{What::acknack, 0, 0b010};
  for (const Members taken : {Members{0b010}, Members{0b011}}) {
    Frame frame{scope, rules};
    object_to_taken(frame, taken, emitted);
    EXPECT_EQ((frame.objections() & bit(Claim::snapshot)) != 0, taken != emitted.set);
  }
}

/// DATA may overtake each other, and ACKNACKs are due between them.
model::Scenario overtaking() {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{100'000};
  scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{50'000}}};  // any delay
  scenario.dds.sedp.nack_suppression_duration = Nanoseconds{40'000};
  scenario.dds.sedp.heartbeat_response_delay = Nanoseconds{30'000};
  return scenario;
}

TEST(ExploredSnapshot, OfAReaderThatDoesNotLearnFromDataIsWrong) {
  const model::Scenario scenario = overtaking();
  checker::Mutant mutant;
  for (const EffectMutation& each :
       fsm::composition::effect_mutations(fsm::composition::compositions().at(1))) {
    const bool is_it = each.effect.starts_with("DataArrives.") &&
                       each.what.starts_with("set each Known") &&
                       each.change == EffectMutation::Change::drop;
    if (is_it) mutant.rules.effects.push_back(each);
  }
  ASSERT_EQ(mutant.rules.effects.size(), 1U);
  const std::array<std::string_view, 1> ids{"safety.snapshot"};
  const checker::Mutant nothing;  // is searched as far as a mutant
  const Finding correct = explore(ids, {scenario, &nothing, {}}).at(0).second;
  EXPECT_EQ(correct.kind, VerdictKind::bounded) << correct.how;
  const Finding wrong = explore(ids, {scenario, &mutant, {}}).at(0).second;
  EXPECT_EQ(wrong.kind, VerdictKind::violated) << wrong.how;
}

}  // namespace snapshot_test
}  // namespace stormproof::explorer
