// The bit planes against a letter for each descriptor: the writer's rules about the descriptors of
// one relation, written down here once more in the plainest way, and random sequences of events
// over numbers of descriptors around the borders of 64-bit words.
#include "model/fastdds/change_states.hpp"

#include <bit>
#include <optional>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/fastdds/endpoints.hpp"
#include "tests/model/fastdds/fastdds_run.hpp"

namespace stormproof::model::fastdds {
namespace change_states_test {

using Members = std::set<std::uint32_t>;
constexpr std::uint32_t relation = 0;

DescriptorSet to_set(const Members& members) {
  std::vector<std::uint64_t> words(4);
  for (const std::uint32_t d : members) words[d / 64] |= std::uint64_t{1} << d % 64;
  return DescriptorSet{words};
}

/// Rebuilds the states from what the probe hears; '-' is a descriptor that does not exist.
class StateProbe final : public Probe {
 public:
  explicit StateProbe(std::uint32_t count) : states(count, '-') {}

  void transition(const MachineRef&, std::string_view, std::string_view before,
                  std::string_view after, std::uint32_t word, std::uint64_t bits) override {
    for (; bits != 0; bits &= bits - 1) {
      char& state = states.at(64 * word + static_cast<std::uint32_t>(std::countr_zero(bits)));
      consistent = consistent && state == letter(before);
      state = letter(after);
    }
  }

  std::string states;
  bool consistent = true;

 private:
  static char letter(std::string_view name) { return name == "Absent" ? '-' : name[0]; }
};

/// The descriptors of one relation whose source has `count` of them.
struct Fixture {
  explicit Fixture(std::uint32_t count) : probe{count} {
    scenario.deployment.participants[0].publications = count - default_publications;
    run.emplace(scenario, &probe);
    changes.emplace(*run);
  }

  Scenario scenario = one_writer(0);
  StateProbe probe;
  std::optional<RunState> run;
  std::optional<ChangeStates> changes;
};

/// The same in letters.
struct Letters {
  bool acknack(std::uint32_t base, const Members& bitmap) {
    bool requested = false;
    for (std::uint32_t d = 0; d < state.size(); ++d) {
      if (state[d] == '-') continue;
      if (d < base) {
        state[d] = 'A';
      } else if (bitmap.contains(d) && state[d] == 'U') {
        state[d] = 'R';
        requested = true;
      }
    }
    return requested;
  }
  Members move(char from, char to) {
    Members moved;
    for (std::uint32_t d = 0; d < state.size(); ++d) {
      if (state[d] != from) continue;
      state[d] = to;
      moved.insert(d);
    }
    return moved;
  }
  std::string state;
};

TEST(ChangeStates, WhatExistsAtTheMatchIsUnacknowledgedAndTheRestIsAbsent) {
  Fixture f{12};
  f.changes->matched(relation, 5);
  EXPECT_EQ(f.probe.states, "UUUUU-------");
  EXPECT_TRUE(f.changes->has_unacknowledged(relation));
  f.changes->created(relation, 5);
  EXPECT_EQ(f.probe.states, "UUUUUQ------");
  EXPECT_TRUE(f.changes->is_queued(relation, 5));
  EXPECT_FALSE(f.changes->is_queued(relation, 4));
}

TEST(ChangeStates, AnAckNackAcknowledgesThePrefixAndRequestsWhatItLists) {
  Fixture f{9};
  f.changes->matched(relation, 6);
  EXPECT_TRUE(f.changes->acknack(relation, 2, to_set({3, 5})));
  EXPECT_EQ(f.probe.states, "AAURUR---");
  EXPECT_FALSE(f.changes->acknack(relation, 2, to_set({3, 5})));  // requested already
  EXPECT_FALSE(f.changes->acknack(relation, 4, to_set({5})));     // R acknowledged
  EXPECT_EQ(f.probe.states, "AAAAUR---");
}

TEST(ChangeStates, AcknowledgmentReachesWhatIsToBeSentAndWhatIsSuppressed) {
  Fixture f{9};
  f.changes->matched(relation, 4);
  f.changes->acknack(relation, 0, to_set({0, 1}));
  EXPECT_EQ(f.changes->nack_response(relation).count(), 2U);
  f.changes->serialized(relation, 0);
  EXPECT_EQ(f.probe.states, "SQUU-----");
  f.changes->acknack(relation, 2, DescriptorSet{});
  EXPECT_EQ(f.probe.states, "AAUU-----");
  EXPECT_FALSE(f.changes->is_queued(relation, 1));
}

TEST(ChangeStates, AnInitialAckNackTakesAcknowledgmentsBackAndLeavesTheRest) {
  Fixture f{9};
  f.changes->matched(relation, 5);
  f.changes->acknack(relation, 2, to_set({3, 4}));
  f.changes->created(relation, 5);
  f.changes->serialized(relation, 5);
  EXPECT_EQ(f.probe.states, "AAURRS---");
  f.changes->initial_acknack(relation);
  EXPECT_EQ(f.probe.states, "UUURRS---");
}

TEST(ChangeStates, OnlyUnacknowledgedIsAReasonForAHeartbeat) {
  Fixture f{9};
  f.changes->matched(relation, 2);
  f.changes->acknack(relation, 0, to_set({0, 1}));
  EXPECT_FALSE(f.changes->has_unacknowledged(relation));  // RR
  EXPECT_FALSE(f.changes->all_acknowledged(relation, 2));
  EXPECT_FALSE(f.changes->nack_response(relation).empty());
  f.changes->serialized(relation, 0);
  EXPECT_FALSE(f.changes->has_unacknowledged(relation));  // SQ
  f.changes->suppression_ended(relation);
  EXPECT_TRUE(f.changes->has_unacknowledged(relation));  // UQ
  f.changes->acknack(relation, 2, DescriptorSet{});
  EXPECT_FALSE(f.changes->has_unacknowledged(relation));
  EXPECT_TRUE(f.changes->all_acknowledged(relation, 2));
  EXPECT_FALSE(f.changes->all_acknowledged(relation, 3));
}

/// One random event on both; returns whether they agree on its result.
bool step(ChangeStates& changes, Letters& letters, std::uint32_t& created) {
  const auto count = static_cast<std::uint32_t>(letters.state.size());
  const auto below = [](std::uint32_t limit) { return *rc::gen::inRange<std::uint32_t>(0, limit); };
  switch (below(7)) {
    case 0: {
      const std::uint32_t base = below(created + 1);
      Members bitmap;
      for (std::uint32_t d = base; d < created; ++d) {
        if (*rc::gen::arbitrary<bool>()) bitmap.insert(d);
      }
      return changes.acknack(relation, base, to_set(bitmap)) == letters.acknack(base, bitmap);
    }
    case 1:
      changes.initial_acknack(relation);
      letters.move('A', 'U');
      return true;
    case 2: {
      Members enqueued;
      changes.nack_response(relation).for_each([&](std::uint32_t d) { enqueued.insert(d); });
      return enqueued == letters.move('R', 'Q');
    }
    case 3: {
      const std::uint32_t d = below(count);
      const bool queued = letters.state[d] == 'Q';
      if (changes.is_queued(relation, d) != queued) return false;
      if (!queued) return true;
      changes.serialized(relation, d);
      letters.state[d] = 'S';
      return true;
    }
    case 4:
      changes.suppression_ended(relation);
      letters.move('S', 'U');
      return true;
    default:
      if (created == count) return true;
      changes.created(relation, created);
      letters.state[created++] = 'Q';
      return true;
  }
}

RC_GTEST_PROP(ChangeStates, AreALetterForEachDescriptor, ()) {
  const auto count = *rc::gen::element<std::uint32_t>(9, 63, 64, 65, 127, 128, 129);
  Fixture f{count};
  auto created = *rc::gen::inRange<std::uint32_t>(0, count + 1);
  Letters letters{std::string(created, 'U') + std::string(count - created, '-')};
  f.changes->matched(relation, created);
  for (int k = 0; k < 60; ++k) {
    RC_ASSERT(step(*f.changes, letters, created));
    RC_ASSERT(f.probe.states == letters.state);
    RC_ASSERT(f.probe.consistent);
    RC_ASSERT(f.changes->has_unacknowledged(relation) ==
              (letters.state.find('U') != std::string::npos));
    const bool all = letters.state.substr(0, created).find_first_not_of('A') == std::string::npos;
    RC_ASSERT(f.changes->all_acknowledged(relation, created) == all);
  }
}

}  // namespace change_states_test
}  // namespace stormproof::model::fastdds
