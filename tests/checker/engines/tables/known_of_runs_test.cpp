// What order.commutation takes as known of runs holds in runs: in every state of random walks
// through the rules, and of every packet that such a walk has sent. Each condition can fail: states
// that are not those of runs are refused.
#include "checker/engines/tables/known_of_runs.hpp"

#include <gtest/gtest.h>

#include "tests/fsm/composition/small_world.hpp"

namespace stormproof::tables {
namespace known_of_runs_test {

namespace comp = fsm::composition;

/// Whether the state, and all packets in it, are as it is known of runs.
template <class Known>
bool is_known(const comp::SmallState& state, const model::DdsProfile& dds) {
  using World = comp::SmallWorld<typename Known::Composition>;
  comp::SmallState copy = state;
  std::mt19937_64 dice{1};
  bool known = true;
  for (int s = 0; s < comp::small_streams; ++s) {
    World writer{copy, dds, dice, {.stream = s}};
    known = known && Known::of_writer(writer);
    for (int peer = 0; peer < comp::small_peers; ++peer) {
      World relation{copy, dds, dice, {.stream = s, .peer = peer}};
      known = known && Known::of_relation(relation);
    }
  }
  comp::for_each_type(typename Known::Composition::Packets{}, [&]<class P>() {
    for (const comp::SentPacket& packet : state.sent) {
      if (packet.name != fsm::name_of<P>()) continue;
      World w{copy, dds, dice, packet.place};
      w.receive(packet);
      known = known && Known::possible(comp::Received<P>{}, w) &&
              Known::consistent(comp::Received<P>{}, w);
    }
  });
  return known;
}

/// Descriptors are created in order, which is the host's doing, not that of the rules.
bool is_in_order(const comp::SmallState& state) {
  for (const auto& [key, value] : state.values) {
    if (key.first != "Exists" || value == 0 || key.second.descriptor == 0) continue;
    comp::Key lower = key;
    --lower.second.descriptor;
    const auto found = state.values.find(lower);
    if (found == state.values.end() || found->second == 0) return false;
  }
  return true;
}

/// The number of steps after which a walk leaves what is known; 0: it never does.
template <class Known>
unsigned leaves(const model::DdsProfile& dds, unsigned seed) {
  std::mt19937_64 dice{seed};
  comp::SmallState state;
  for (unsigned step = 1; step <= 1500; ++step) {
    const comp::SmallState before = state;
    comp::random_step<typename Known::Composition>(state, dds, dice, [](auto&&...) {});
    if (!is_in_order(state)) state = before;
    if (!is_known<Known>(state, dds)) return step;
  }
  return 0;
}

model::DdsProfile fastdds() {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  return dds;
}

TEST(KnownOfRuns, HoldsInThePapersRuns) {
  model::DdsProfile other;
  other.sedp.relation_opening = model::RelationOpening::each_side;
  other.sedp.initial_data = model::InitialData::pull;
  other.sedp.acknowledge = model::Acknowledge::prefix;
  other.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    EXPECT_EQ(leaves<KnownOfPaper>({}, seed), 0U);
    EXPECT_EQ(leaves<KnownOfPaper>(other, seed), 0U);
  }
}

TEST(KnownOfRuns, HoldsInFastDdssRuns) {
  for (unsigned seed = 1; seed <= 8; ++seed) EXPECT_EQ(leaves<KnownOfFastDds>(fastdds(), seed), 0U);
}

TEST(KnownOfRuns, RefusesWhatNoRunReaches) {
  const comp::Place ours;
  const auto state_with = [&](const char* name, std::int64_t value) {
    comp::SmallState state;
    state.values[{name, ours}] = value;
    return state;
  };
  EXPECT_TRUE(is_known<KnownOfPaper>({}, {}));
  EXPECT_FALSE(is_known<KnownOfPaper>(state_with("C", 1), {}));               // requested, unopened
  EXPECT_FALSE(is_known<KnownOfPaper>(state_with("HeartbeatClock", 1), {}));  // nothing pending
  EXPECT_FALSE(is_known<KnownOfFastDds>(state_with("X", 1), fastdds()));      // not known to exist
  EXPECT_FALSE(is_known<KnownOfFastDds>(state_with("Enqueued", 1), fastdds()));  // no run of it
}

}  // namespace known_of_runs_test
}  // namespace stormproof::tables
