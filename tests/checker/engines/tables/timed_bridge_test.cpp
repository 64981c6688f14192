// The bridge in time: the steps of random executions with a clock
// (tests/checker/engines/tables/timed_walk.hpp) are steps of the timed derived system only.
#include <gtest/gtest.h>

#include "tests/checker/engines/tables/timed_walk.hpp"

namespace stormproof::tables {
namespace timed_bridge_test {

using timed_walk::delta;
using timed_walk::source;
using timed_walk::Walk;

/// By how much a system is told less than what is so, for tests that notice it.
struct Wrong {
  std::int64_t response = 0;
  std::int64_t delta = 0;
  std::int64_t source = 0;
  std::int64_t loss = 0;
  std::int64_t initial = 0;  ///< by how much more
  bool exact = false;        ///< the system takes every packet for one that takes Δ
  Unsound unsound = Unsound::none;

  [[nodiscard]] bool is() const {
    return exact || response + delta + source + loss + initial > 0 || unsound != Unsound::none;
  }
};

/// The system with the values of the profile in place of the unknowns.
TransitionSystem with_values(const TimedDescriptor& descriptor, const model::DdsProfile& dds,
                             const Wrong& wrong) {
  const auto number = [](std::int64_t value) { return smt::SymbolicInt{value}.expr(); };
  return with(descriptor.whole(), descriptor.unknowns(),
              {number(dds.sedp.heartbeat_period.count()),
               number(dds.sedp.heartbeat_response_delay.count() - wrong.response),
               number(dds.sedp.nack_response_delay.count()),
               number(dds.sedp.nack_suppression_duration.count()), number(delta - wrong.delta),
               number(source - wrong.source),
               number(dds.sedp.initial_acknack_delay.count() + wrong.initial)});
}

template <class Composition>
Crossing cross(const model::DdsProfile& dds, unsigned walks, const Wrong& wrong = {},
               bool exact = false, bool stale = false) {
  z3::context context;
  const smt::SymbolicContext current{context};
  const TimedDescriptor descriptor{
      dds,
      model::Mutation{},
      {.exact = exact || wrong.exact,
       .attempts = Walk<Composition>::attempts,
       .tighten = [&](auto& bound) { bound.loss = bound.loss - wrong.loss; },
       .unsound = wrong.unsound}};
  const TransitionSystem system = with_values(descriptor, dds, wrong);
  Bridge bridge{system};
  std::vector<comp::Place> places;
  for (int d = 0; d < comp::small_descriptors; ++d) places.push_back({0, 0, d});
  std::mt19937_64 dice{1};
  for (unsigned walk = 0; walk < walks; ++walk) {
    Walk<Composition> path{dds, dice, exact, stale};
    const auto look = [&](const comp::Place& place) { return path.seen(place); };
    bridge.begin(places, look);
    for (unsigned k = 0; k < 300; ++k) {
      path.step([&](const std::string& rule, comp::Owner owner, comp::Place where) {
        bridge.cross(rule, owner, where, look);
      });
      if (wrong.is() && !bridge.crossing().refused.empty()) return bridge.crossing();
    }
  }
  return bridge.crossing();
}

model::DdsProfile hasty(model::DdsProfile dds) {
  dds.sedp.heartbeat_period = model::Nanoseconds{11};
  dds.sedp.heartbeat_response_delay = model::Nanoseconds{2};
  dds.sedp.nack_response_delay = model::Nanoseconds{3};
  dds.sedp.nack_suppression_duration = model::Nanoseconds{4};
  dds.sedp.initial_acknack_delay = model::Nanoseconds{5};
  return dds;
}

TEST(TimedBridge, EveryTimedStepOfThePapersRulesIsDerived) {
  model::DdsProfile pull = hasty({});
  pull.sedp.relation_opening = model::RelationOpening::each_side;
  pull.sedp.initial_data = model::InitialData::pull;
  for (const model::DdsProfile& dds : {hasty({}), pull}) {
    const Crossing crossing = cross<comp::paper::Paper>(dds, 6);
    EXPECT_GT(crossing.distinct, 400U);
    EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  }
}

TEST(TimedBridge, EveryTimedStepOfFastDdssRulesIsDerived) {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  const Crossing crossing = cross<comp::fastdds::FastDds>(hasty(dds), 4);
  EXPECT_GT(crossing.distinct, 400U);
  EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
}

TEST(TimedBridge, EveryStepWithConstantDelaysIsDerived) {
  const Crossing crossing = cross<comp::paper::Paper>(hasty({}), 8, {}, true);
  EXPECT_GT(crossing.distinct, 200U);
  EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  EXPECT_NE(first_of(cross<comp::paper::Paper>(hasty({}), 4, {.exact = true})), "");
}

model::DdsProfile amended() {
  model::DdsProfile dds = hasty({});
  dds.sedp.relation_opening = model::RelationOpening::each_side;
  dds.sedp.initial_data = model::InitialData::pull;
  dds.sedp.unmatched = model::Unmatched::drop;
  dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  model::Amendments& rules = dds.amendments.emplace();
  rules.initial_acknack_resets = model::Whether::yes;
  rules.initial_acknack_arms = model::Whether::yes;
  rules.initial_acknack_stop = model::InitialAckNackStop::complete;
  return dds;
}

TEST(TimedBridge, EveryTimedStepOfTheAmendedRulesIsDerived) {
  model::DdsProfile constant = amended();
  constant.sedp.initial_acknack_interval = model::InitialAckNackInterval::constant;
  constant.amendments->acked_request = model::AckedRequest::reopen;
  constant.amendments->reader_retry = model::ReaderRetry::after_nack;
  for (const auto& [dds, stale] :
       {std::pair{amended(), false}, std::pair{amended(), true}, std::pair{constant, true}}) {
    const Crossing crossing = cross<comp::amended::Amended>(dds, 7, {}, false, stale);
    EXPECT_GT(crossing.distinct, 300U);
    EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  }
}

TEST(TimedBridge, RefusesOtherAmendedRulesAndTimes) {
  const auto refused = [](const Wrong& wrong) {
    return first_of(cross<comp::amended::Amended>(amended(), 4, wrong));
  };
  for (const Wrong& wrong : {Wrong{.response = 1}, Wrong{.delta = 1}, Wrong{.source = 1},
                             Wrong{.loss = 1}, Wrong{.initial = 1}}) {
    EXPECT_NE(refused(wrong), "");
  }
  for (const Unsound mistake : {Unsound::others_never_ask, Unsound::packets_arrive_once}) {
    EXPECT_NE(refused({.unsound = mistake}), "");
  }
}

TEST(TimedBridge, RefusesADerivationThatForgetsOthers) {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  for (const Unsound mistake : {Unsound::others_never_ask, Unsound::loops_for_us_only}) {
    EXPECT_NE(first_of(cross<comp::fastdds::FastDds>(hasty(dds), 2, {.unsound = mistake})), "");
  }
}

TEST(TimedBridge, RefusesASystemInWhichThingsTakeLess) {
  for (const Wrong& wrong : {Wrong{.response = 1}, Wrong{.delta = 1}, Wrong{.source = 1},
                             Wrong{.loss = 1}, Wrong{.initial = 1}}) {
    EXPECT_NE(first_of(cross<comp::paper::Paper>(hasty({}), 4, wrong)), "");
  }
}

}  // namespace timed_bridge_test
}  // namespace stormproof::tables
