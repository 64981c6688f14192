// The state of every (descriptor, receiver) of a deployment: the bitmap X of the reader and the
// writer's state, both as bit planes of one relation. Descriptors in the same state that meet the
// same input cannot be told apart by the machine, so each such class takes ONE step of the
// Boost.MSM machine and moves as a whole: an ACKNACK costs a few steps for 64 descriptors, and a
// descriptor takes four bits (three of state, one of X). Which events there are is the
// implementation's business: model/paper/descriptor_states.hpp and model/fastdds/change_states.hpp.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "fsm/stepper.hpp"
#include "model/engine/descriptor_set.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model {

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

  [[nodiscard]] bool has_received(std::uint32_t relation, std::uint32_t d) const {
    return (word(relation, d / 64).received >> d % 64 & 1) != 0;
  }

  /// The bitmap {d < limit : X = 0} of this instant.
  [[nodiscard]] DescriptorSet missing(std::uint32_t relation, std::uint32_t limit = UINT32_MAX) {
    scratch_.clear();
    for (std::uint32_t k = 0; k < word_count(relation); ++k) {
      scratch_.push_back(valid(relation, k) & below(limit, k) & ~word(relation, k).received);
    }
    return DescriptorSet{scratch_};
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

  /// All descriptors 0 … D-1 of the relation.
  [[nodiscard]] DescriptorSet all(std::uint32_t relation) {
    scratch_.clear();
    for (std::uint32_t k = 0; k < word_count(relation); ++k) scratch_.push_back(valid(relation, k));
    return DescriptorSet{scratch_};
  }

  /// Marks descriptor d as generated; returns whether that happens for the first time.
  bool mark_generated(std::uint32_t relation, std::uint32_t d) {
    Word& target = word(relation, d / 64);
    const std::uint64_t bit = std::uint64_t{1} << d % 64;
    const bool first = (target.generated & bit) == 0;
    target.generated |= bit;
    return first;
  }

 protected:
  static constexpr std::size_t state_bits = 3;
  static_assert(fsm::Reflect<Machine>::state_count <= (1U << state_bits));

  [[nodiscard]] std::uint32_t word_count(std::uint32_t relation) const {
    return words_for(run_.topology.descriptor_count(relation));
  }

  /// Bits of word k that belong to descriptors of the relation.
  [[nodiscard]] std::uint64_t valid(std::uint32_t relation, std::uint32_t k) const {
    return below(run_.topology.descriptor_count(relation), k);
  }

  /// Bits of word k that belong to descriptors below `limit`.
  [[nodiscard]] static std::uint64_t below(std::uint32_t limit, std::uint32_t k) {
    if (limit <= 64 * k) return 0;
    const std::uint32_t rest = limit - 64 * k;
    return rest >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << rest) - 1;
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

  /// Steps every class of `members` (bits of word k) once; calls `effect(class, output)` for each.
  template <class Event, class Effect>
  void step(std::uint32_t relation, std::uint32_t k, std::uint64_t members, const Input& input,
            Effect&& effect);
  template <class Event>
  void step(std::uint32_t relation, std::uint32_t k, std::uint64_t members,
            const Input& input = {}) {
    step<Event>(relation, k, members, input, [](std::uint64_t, const Output&) {});
  }

  RunState& run_;
  std::vector<std::uint64_t> scratch_;

 private:
  struct Word {
    std::uint64_t received = 0;
    std::array<std::uint64_t, state_bits> state{};
    std::uint64_t generated = 0;
  };

  [[nodiscard]] Word& word(std::uint32_t relation, std::uint32_t k) {
    return words_[first_word_[relation] + k];
  }
  [[nodiscard]] const Word& word(std::uint32_t relation, std::uint32_t k) const {
    return words_[first_word_[relation] + k];
  }

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
    if (run_.probe != nullptr && row != fsm::no_row) {
      const auto& names = fsm::Reflect<Machine>::state_names;
      run_.probe->transition({fsm::name_of<Machine>(), MachineRef::Kind::relation, relation},
                             fsm::name_of<Event>(), names[before], names[after], k, classes[s]);
    }
    effect(classes[s], output);
  }
}

}  // namespace stormproof::model
