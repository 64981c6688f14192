// The bridge between executing and proving: every step that an execution of the rules takes, seen
// by each descriptor of each relation, is a step of the derived system. What the derivation
// forgets, an effect that only another descriptor or reader causes, shows up here, and deliberate
// mistakes in it do. The states are compared as a whole; only what is watched besides is left open.
#include "tests/checker/engines/tables/bridge.hpp"

#include <gtest/gtest.h>

#include "fsm/composition/amended.hpp"
#include "fsm/composition/cyclone.hpp"

namespace stormproof::tables {
namespace bridge_test {

/// Random walks under this profile; every step is looked for in the system, from every place. A
/// derivation with a mistake is done with once a step is refused.
template <class Composition>
Crossing cross(const model::DdsProfile& dds, Unsound unsound, unsigned walks, unsigned seed) {
  z3::context context;
  const smt::SymbolicContext current{context};
  const model::Mutation correct;
  const DescriptorSystem derived{dds, correct, unsound};
  const TransitionSystem system = derived.whole();
  Bridge bridge{system};
  std::vector<comp::Place> places;
  for (int s = 0; s < comp::small_streams; ++s) {
    for (int d = 0; d < comp::small_descriptors; ++d) places.push_back({s, 0, d});
  }
  std::mt19937_64 dice{seed};
  for (unsigned walk = 0; walk < walks; ++walk) {
    comp::SmallState state;
    const auto look = [&](const comp::Place& place) {
      return seen_from<Composition>(state, place);
    };
    bridge.begin(places, look);
    for (unsigned k = 0; k < 400; ++k) {
      if (unsound != Unsound::none && !bridge.crossing().refused.empty()) break;
      comp::random_step<Composition>(
          state, dds, dice, [&](const std::string& rule, comp::Owner owner, comp::Place where) {
            bridge.cross(rule, owner, where, look);
          });
    }
  }
  return bridge.crossing();
}

model::DdsProfile paper() { return {}; }
model::DdsProfile fastdds() {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  return dds;
}

model::DdsProfile cyclone() {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::cyclone;
  return dds;
}

TEST(Bridge, EveryStepOfThePapersRulesIsDerived) {
  model::DdsProfile pull = paper();
  pull.sedp.relation_opening = model::RelationOpening::each_side;
  pull.sedp.initial_data = model::InitialData::pull;
  pull.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  pull.sedp.acknowledge = model::Acknowledge::prefix;
  pull.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  model::DdsProfile adaptive = paper();
  adaptive.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  adaptive.sedp.initial_acknack_delay = model::Nanoseconds{0};
  for (const model::DdsProfile& dds : {paper(), pull, adaptive}) {
    const Crossing crossing = cross<comp::paper::Paper>(dds, Unsound::none, 16, 1);
    EXPECT_GT(crossing.distinct, 400U);
    EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  }
}

TEST(Bridge, EveryStepOfFastDdssRulesIsDerived) {
  model::DdsProfile adaptive = fastdds();
  adaptive.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  for (const model::DdsProfile& dds : {fastdds(), adaptive}) {
    const Crossing crossing = cross<comp::fastdds::FastDds>(dds, Unsound::none, 4, 1);
    EXPECT_GT(crossing.distinct, 400U);
    EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  }
}

TEST(Bridge, EveryStepOfTheAmendedRulesIsDerived) {
  model::DdsProfile eager = paper();
  eager.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  model::Amendments& rules = eager.amendments.emplace();
  rules.initial_acknack_resets = model::Whether::yes;
  rules.initial_acknack_stop = model::InitialAckNackStop::complete;
  rules.acked_request = model::AckedRequest::reopen;
  rules.repair_heartbeat = model::RepairHeartbeat::after;
  rules.acknack_reply = model::AckNackReply::all;
  rules.stale_acknack = model::StaleAckNack::required_drop;
  rules.on_reannounce = model::OnReannounce::ack_missing;
  rules.reader_retry = model::ReaderRetry::whenever_missing;
  rules.reader_nack_delay = model::Nanoseconds{1};
  model::DdsProfile plain = paper();
  plain.amendments.emplace();
  for (const model::DdsProfile& dds : {plain, eager}) {
    const Crossing crossing = cross<comp::amended::Amended>(dds, Unsound::none, 16, 1);
    EXPECT_GT(crossing.distinct, 400U);
    EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  }
}

TEST(Bridge, EveryStepOfCycloneDdssRulesIsDerived) {
  model::DdsProfile each_for_itself = cyclone();
  each_for_itself.sedp.merge_queued_rexmit = model::MergeQueued::no;
  model::DdsProfile fresh = cyclone();
  fresh.sedp.notification = model::Notification::fresh_at_once;
  for (const model::DdsProfile& dds : {cyclone(), each_for_itself, fresh}) {
    const Crossing crossing = cross<comp::cyclone::Cyclone>(dds, Unsound::none, 16, 1);
    EXPECT_GT(crossing.distinct, 400U);
    EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  }
}

TEST(Bridge, RefusesADerivationThatForgetsOthers) {
  for (const Unsound mistake : {Unsound::others_never_ask, Unsound::rules_for_us_only,
                                Unsound::loops_for_us_only, Unsound::packets_arrive_once}) {
    const Crossing crossing = cross<comp::fastdds::FastDds>(fastdds(), mistake, 2, 1);
    EXPECT_FALSE(crossing.refused.empty()) << static_cast<int>(mistake);
    const Crossing other = cross<comp::cyclone::Cyclone>(cyclone(), mistake, 4, 1);
    EXPECT_FALSE(other.refused.empty()) << static_cast<int>(mistake);
  }
  for (const Unsound mistake :
       {Unsound::others_never_ask, Unsound::rules_for_us_only, Unsound::packets_arrive_once}) {
    Crossing crossing = cross<comp::paper::Paper>(paper(), mistake, 2, 1);
    EXPECT_FALSE(crossing.refused.empty()) << static_cast<int>(mistake);
    model::DdsProfile amended = paper();
    amended.amendments.emplace();
    crossing = cross<comp::amended::Amended>(amended, mistake, 2, 1);
    EXPECT_FALSE(crossing.refused.empty()) << static_cast<int>(mistake);
  }
}

}  // namespace bridge_test
}  // namespace stormproof::tables
