// The bit planes against a byte for each descriptor: the rules of ACKNACK reception, repair and
// suppression, written down here once more in the plainest way, and random sequences of events over
// numbers of descriptors around the borders of 64-bit words, with both readings of what an ACKNACK
// confirms.
#include "model/paper/descriptor_states.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model::paper {
namespace descriptor_states_test {

using Members = std::set<std::uint32_t>;

DescriptorSet to_set(const Members& members, std::uint32_t count) {
  std::vector<std::uint64_t> words(words_for(count));
  for (const std::uint32_t d : members) words[d / 64] |= std::uint64_t{1} << d % 64;
  return DescriptorSet{words};
}

Members to_members(const DescriptorSet& set) {
  Members members;
  set.for_each([&](std::uint32_t d) { members.insert(d); });
  return members;
}

/// One relation of `count` descriptors, one letter each.
struct Reference {
  explicit Reference(std::uint32_t count) : state(count, 'U'), received(count, false) {}

  std::pair<std::uint32_t, std::uint32_t> acknack(const Members& bitmap, bool prefix) {
    std::uint32_t requested = 0;
    std::uint32_t acknowledged = 0;
    for (std::uint32_t d = 0; d < state.size(); ++d) {
      if (bitmap.contains(d)) {
        if (state[d] == 'U') state[d] = 'R', ++requested;
      } else if (!prefix || bitmap.empty() || d < *bitmap.begin()) {
        if (state[d] != 'A') state[d] = 'A', ++acknowledged;
      }
    }
    return {requested, acknowledged};
  }

  Members move(char from, char to) {
    Members moved;
    for (std::uint32_t d = 0; d < state.size(); ++d) {
      if (state[d] == from) state[d] = to, moved.insert(d);
    }
    return moved;
  }

  std::string state;
  std::vector<bool> received;
};

/// Rebuilds the states from what the probe hears, and checks that each transition starts where the
/// last one ended.
class StateProbe final : public Probe {
 public:
  explicit StateProbe(std::uint32_t count) : states(count, 'U') {}

  void transition(const MachineRef& machine, std::string_view, std::string_view before,
                  std::string_view after, std::uint32_t word, std::uint64_t bits) override {
    consistent = consistent && machine.machine == "DescriptorRepair";
    for (; bits != 0; bits &= bits - 1) {
      char& state = states[64 * word + static_cast<std::uint32_t>(std::countr_zero(bits))];
      consistent = consistent && before[0] == state;
      state = after[0];
    }
  }

  std::string states;
  bool consistent = true;
};

/// Two participants on two hosts; relation 0 has `count` descriptors.
Scenario one_relation(std::uint32_t count) { return by_hand({{0, count}, {1, 0}}); }

Members random_members(std::uint32_t count) {
  return *rc::gen::container<Members>(rc::gen::inRange<std::uint32_t>(0, count));
}

RC_GTEST_PROP(DescriptorStates, TheWriterSideFollowsTheRules, ()) {
  const auto count = *rc::gen::element<std::uint32_t>(1, 5, 63, 64, 65, 128, 130, 200);
  const auto prefix = *rc::gen::arbitrary<bool>();
  const Scenario scenario = one_relation(count);
  StateProbe probe{count};
  RunState run{scenario, &probe};
  DescriptorStates states{run};
  Reference reference{count};
  for (const int action : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 6))) {
    if (action < 3) {
      const Members bitmap = random_members(count);
      const auto effect = states.acknack(0, to_set(bitmap, count), prefix);
      const auto [requested, acknowledged] = reference.acknack(bitmap, prefix);
      RC_ASSERT(effect.requested == requested);
      RC_ASSERT(effect.acknowledged == acknowledged);
    } else if (action == 3) {
      RC_ASSERT(to_members(states.repair_due(0)) == reference.move('R', 'Q'));
    } else if (action == 4) {
      const Members in_packet = random_members(count);
      states.repair_sent(0, to_set(in_packet, count));
      for (const std::uint32_t d : in_packet) {
        if (reference.state[d] == 'Q') reference.state[d] = 'S';
      }
    } else {
      RC_ASSERT(states.suppression_ended(0) == reference.move('S', 'U').size());
    }
    RC_ASSERT(probe.consistent);
    RC_ASSERT(probe.states == reference.state);
  }
}

TEST(DescriptorStates, ADescriptorTakesOneStepPerAckNackNotTwo) {
  const Scenario scenario = one_relation(3);
  RunState run{scenario, nullptr};
  DescriptorStates states{run};
  const auto first = states.acknack(0, to_set({0, 2}, 3), false);
  EXPECT_EQ(first.requested, 2U);
  EXPECT_EQ(first.acknowledged, 1U);
  const auto again = states.acknack(0, to_set({0, 2}, 3), false);
  EXPECT_EQ(again.requested, 0U);
  EXPECT_EQ(again.acknowledged, 0U);
}

TEST(DescriptorStates, WithThePrefixRuleWhatIsAboveTheFirstMissingOneStays) {
  const Scenario scenario = one_relation(130);
  RunState run{scenario, nullptr};
  DescriptorStates states{run};
  const auto effect = states.acknack(0, to_set({64, 129}, 130), true);
  EXPECT_EQ(effect.requested, 2U);
  EXPECT_EQ(effect.acknowledged, 64U);
  const auto clean = states.acknack(0, to_set({}, 130), true);
  EXPECT_EQ(clean.acknowledged, 66U);
}

TEST(DescriptorStates, RelationsDoNotTouchEachOther) {
  Scenario scenario = one_relation(70);
  scenario.deployment.participants[1].publications = 66;
  RunState run{scenario, nullptr};
  DescriptorStates states{run};
  ASSERT_EQ(run.topology.descriptor_count(2), 66U);
  states.receive(0, states.all(0));
  states.acknack(0, to_set({}, 70), false);
  EXPECT_TRUE(states.missing(0).empty());
  EXPECT_EQ(to_members(states.missing(2)).size(), 66U);
  EXPECT_EQ(states.acknack(2, states.all(2), false).requested, 66U);
}

}  // namespace descriptor_states_test
}  // namespace stormproof::model::paper
