// The state of every (descriptor, receiver) of a deployment: the bitmap X of the reader and the
// writer's state, both as bit planes of one relation. Descriptors in the same state that meet the
// same input cannot be told apart by the machine, so each such class takes ONE step of the
// Boost.MSM machine and moves as a whole: an ACKNACK costs a few steps for 64 descriptors, and a
// descriptor takes four bits (three of state, one of X). What happens to them, rules say
// (fsm/composition).
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <boost/pfr.hpp>

#include "fsm/stepper.hpp"
#include "model/engine/descriptor_set.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/lanes.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model {

/// Which value of each field of an input comes first.
template <class LaneInput>
using LaneOrder = std::array<bool, boost::pfr::tuple_size_v<LaneInput>>;

template <class Machine>
class RelationBits {
 public:
  using Input = typename fsm::Stepper<Machine>::Input;
  using Output = typename fsm::Stepper<Machine>::Output;

  explicit RelationBits(RunState& run) : run_{run}, machines_{table_mutations(run)} {
    static_assert(fsm::Stepper<Machine>::initial == 0, "zeroed planes must mean the initial state");
    std::uint32_t next = 0;
    first_word_.reserve(run.topology.relation_count());
    for (std::uint32_t relation = 0; relation < run.topology.relation_count(); ++relation) {
      first_word_.push_back(next);
      next += word_count(relation);
    }
    words_.resize(next);
  }

  /// The reader takes a DATA's descriptors: X := 1.
  void receive(std::uint32_t relation, const DescriptorSet& descriptors) {
    for (std::uint32_t k = descriptors.first_word(); k < descriptors.end_word(); ++k) {
      word(relation, k).received |= descriptors.word(k);
    }
  }

  /// The reader loses what it has: X := 0.
  void lose(std::uint32_t relation) {
    for (std::uint32_t k = 0; k < word_count(relation); ++k) word(relation, k).received = 0;
  }
  /// All descriptors in their initial state, none of them generated yet; observers are told that
  /// those of other states have taken the `step`.
  void renew(std::uint32_t relation, std::string_view step) {
    using States = fsm::Reflect<Machine>;
    for (std::uint32_t k = 0; k < word_count(relation); ++k) {
      for (fsm::StateId s = 1; s < States::state_count && run_.probe != nullptr; ++s) {
        const std::uint64_t members = in_state(relation, k, s);
        if (members == 0) continue;
        run_.probe->transition({{fsm::name_of<Machine>(), MachineRef::Kind::relation, relation},
                                step,
                                States::state_names[s],
                                States::state_names[0],
                                k,
                                members});
      }
      Word fresh;
      fresh.received = word(relation, k).received;
      word(relation, k) = fresh;
    }
  }

  /// X of the descriptors of word k.
  [[nodiscard]] std::uint64_t received(std::uint32_t relation, std::uint32_t k) const {
    return word(relation, k).received;
  }

  /// How many of `descriptors` the reader lacks.
  [[nodiscard]] std::uint32_t count_missing(std::uint32_t relation,
                                            const DescriptorSet& descriptors) const {
    std::uint32_t missing = 0;
    for (std::uint32_t k = descriptors.first_word(); k < descriptors.end_word(); ++k) {
      missing += static_cast<std::uint32_t>(
          std::popcount(descriptors.word(k) & ~word(relation, k).received));
    }
    return missing;
  }

  /// The descriptors with X = 0.
  [[nodiscard]] DescriptorSet missing(std::uint32_t relation) const {
    DescriptorSet set;
    for (std::uint32_t k = 0; k < word_count(relation); ++k) {
      set.add(k, valid(relation, k) & ~word(relation, k).received);
    }
    return set;
  }

  /// The first `limit` required descriptors that have not reached their readers, in ascending
  /// order.
  [[nodiscard]] std::vector<MissingDescriptor> list_missing(std::size_t limit) {
    std::vector<MissingDescriptor> list;
    for (std::uint32_t relation = 0; relation < run_.topology.relation_count(); ++relation) {
      const Pair& ends = run_.topology.pair(relation / 2);
      if (!ends.cross_host) continue;
      missing(relation).for_each([&](std::uint32_t d) {
        if (list.size() == limit) return;
        list.push_back({ParticipantId{ends.source}, ParticipantId{ends.destination},
                        streams[relation % 2], DescriptorId{d}});
      });
      if (list.size() == limit) break;
    }
    return list;
  }

  /// Marks descriptor d as generated; returns whether that happens for the first time.
  bool mark_generated(std::uint32_t relation, std::uint32_t d) {
    Word& target = word(relation, d / 64);
    const std::uint64_t bit = std::uint64_t{1} << d % 64;
    const bool first = (target.generated & bit) == 0;
    target.generated |= bit;
    return first;
  }

  /// Steps the `members` (bits of word k), every class of equal state once; calls
  /// `effect(class, output, before, after)` for each class, with the states.
  template <class Event, class Effect>
  void step(std::uint32_t relation, std::uint32_t k, std::uint64_t members, const Input& input,
            Effect&& effect);

  /// The same where the input differs: every class of equal state and input steps once. Of a field,
  /// those come first for which it has the value that `first` says.
  template <class Event, class LaneInput, class Effect>
  void step_each(std::uint32_t relation, std::uint32_t k, std::uint64_t members,
                 const LaneInput& input, const LaneOrder<LaneInput>& first, Effect&& effect) {
    step_classes<Event, 0>(relation, k, members, input, first, Input{}, effect);
  }

  /// The state of descriptor d.
  [[nodiscard]] fsm::StateId state_of(std::uint32_t relation, std::uint32_t d) const {
    unsigned state = 0;
    for (std::size_t b = 0; b < state_bits; ++b) {
      state |= static_cast<unsigned>(word(relation, d / 64).state[b] >> d % 64 & 1) << b;
    }
    return static_cast<fsm::StateId>(state);
  }

  /// Bits of word k whose descriptors are in the state with this number.
  [[nodiscard]] std::uint64_t in_state(std::uint32_t relation, std::uint32_t k,
                                       fsm::StateId state) const {
    std::uint64_t members = valid(relation, k);
    const Word& planes = word(relation, k);
    for (std::size_t b = 0; b < state_bits; ++b) {
      members &= (state >> b & 1) != 0 ? planes.state[b] : ~planes.state[b];
    }
    return members;
  }

 private:
  static constexpr std::size_t state_bits = 3;
  static_assert(fsm::Reflect<Machine>::state_count <= (1U << state_bits));

  [[nodiscard]] std::uint32_t word_count(std::uint32_t relation) const {
    return words_for(run_.topology.descriptor_count(relation));
  }

  /// Bits of word k that belong to descriptors of the relation.
  [[nodiscard]] std::uint64_t valid(std::uint32_t relation, std::uint32_t k) const {
    return bits_below(run_.topology.descriptor_count(relation), k);
  }

  struct Word {
    std::uint64_t received = 0;
    std::array<std::uint64_t, state_bits> state{};
    std::uint64_t generated = 0;
  };

  template <class Event, std::size_t field, class LaneInput, class Effect>
  void step_classes(std::uint32_t relation, std::uint32_t k, std::uint64_t members,
                    const LaneInput& lanes, const LaneOrder<LaneInput>& first, Input input,
                    Effect& effect) {
    if constexpr (field == boost::pfr::tuple_size_v<LaneInput>) {
      step<Event>(relation, k, members, input, effect);
    } else {
      const std::uint64_t holds = boost::pfr::get<field>(lanes).bits;
      for (const bool value : {first[field], !first[field]}) {
        const std::uint64_t same = members & (value ? holds : ~holds);
        if (same == 0) continue;
        boost::pfr::get<field>(input) = value;
        step_classes<Event, field + 1>(relation, k, same, lanes, first, input, effect);
      }
    }
  }

  [[nodiscard]] Word& word(std::uint32_t relation, std::uint32_t k) {
    return words_[first_word_[relation] + k];
  }
  [[nodiscard]] const Word& word(std::uint32_t relation, std::uint32_t k) const {
    return words_[first_word_[relation] + k];
  }

  RunState& run_;
  fsm::Stepper<Machine> machines_;
  std::vector<Word> words_;
  std::vector<std::uint32_t> first_word_;  // by relation
};

template <class Machine>
template <class Event, class Effect>
void RelationBits<Machine>::step(std::uint32_t relation, std::uint32_t k, std::uint64_t members,
                                 const Input& input, Effect&& effect) {
  constexpr std::size_t states = fsm::Reflect<Machine>::state_count;
  // Classes are taken from the states before the event: a descriptor takes one step, not two.
  std::array<std::uint64_t, states> classes;
  for (std::size_t s = 0; s < states; ++s) {
    classes[s] = members & in_state(relation, k, static_cast<fsm::StateId>(s));
  }
  Word& planes = word(relation, k);
  for (std::size_t s = 0; s < states; ++s) {
    if (classes[s] == 0) continue;
    const auto before = static_cast<fsm::StateId>(s);
    fsm::StateId after = before;
    fsm::RowId row = fsm::no_row;
    const Output output = machines_.template step<Event>(after, input, row);
    for (std::size_t b = 0; b < state_bits; ++b) {
      if ((after >> b & 1) != 0)
        planes.state[b] |= classes[s];
      else
        planes.state[b] &= ~classes[s];
    }
    if (run_.who_hears(Report::descriptor_transition) != nullptr && row != fsm::no_row) {
      const auto& names = fsm::Reflect<Machine>::state_names;
      run_.probe->transition({{fsm::name_of<Machine>(), MachineRef::Kind::relation, relation},
                              fsm::name_of<Event>(),
                              names[before],
                              names[after],
                              k,
                              classes[s]});
    }
    effect(classes[s], output, before, after);
  }
}

}  // namespace stormproof::model
