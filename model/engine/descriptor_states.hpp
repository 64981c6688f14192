// The state of every (descriptor, receiver): the bitmap X of the reader and the state U R Q S A of the writer,
// both as bit planes of one relation. Descriptors in the same state that meet the same input cannot be told
// apart by the machine, so each such class takes ONE step of the Boost.MSM machine and moves as a whole: an
// ACKNACK costs a few steps for 64 descriptors, and a descriptor takes four bits (three of state, one of X).
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "fsm/descriptor_repair.hpp"
#include "fsm/flyweight.hpp"
#include "model/engine/descriptor_set.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model {

class DescriptorStates {
 public:
  using Machine = fsm::DescriptorRepair;
  using Input = fsm::Flyweight<Machine>::Input;
  using Output = fsm::Flyweight<Machine>::Output;

  explicit DescriptorStates(RunState& run);

  /// The reader takes a DATA's descriptors: X := 1. Returns how many were missing before.
  std::uint32_t receive(std::uint32_t relation, const DescriptorSet& descriptors);
  /// How many of `descriptors` the reader lacks.
  [[nodiscard]] std::uint32_t count_missing(std::uint32_t relation,
                                            const DescriptorSet& descriptors) const;
  /// The bitmap {d : X = 0} of this instant.
  [[nodiscard]] DescriptorSet missing(std::uint32_t relation);

  /// Marks descriptors as generated; returns those (of `word` k) generated for the first time.
  std::uint64_t mark_generated(std::uint32_t relation, std::uint32_t k, std::uint64_t word);

  /// An ACKNACK with this bitmap reaches the writer.
  struct AckNackEffect {
    std::uint32_t requested = 0;
    std::uint32_t acknowledged = 0;
  };
  AckNackEffect acknack(std::uint32_t relation, const DescriptorSet& bitmap, bool prefix_only);
  /// Repair generation: all that is requested becomes queued. Returns the descriptors to generate.
  [[nodiscard]] DescriptorSet repair_due(std::uint32_t relation);
  /// The repair DATA with these descriptors has left the source.
  void repair_sent(std::uint32_t relation, const DescriptorSet& descriptors);
  /// The suppression of the relation ends. Returns how many descriptors are open to requests again.
  std::uint32_t suppression_ended(std::uint32_t relation);

  /// All descriptors 0 … D-1 of the relation.
  [[nodiscard]] DescriptorSet all(std::uint32_t relation);

 private:
  static constexpr std::size_t state_bits = 3;
  static_assert(fsm::Reflect<Machine>::state_count <= (1U << state_bits));
  // Planes of one word: X, then the bits of the state, then "has been generated".
  static constexpr std::size_t planes = 1 + state_bits + 1;

  struct Word {
    std::uint64_t received = 0;
    std::uint64_t state[state_bits] = {};
    std::uint64_t generated = 0;
  };
  static_assert(sizeof(Word) == planes * sizeof(std::uint64_t));

  [[nodiscard]] std::uint32_t word_count(std::uint32_t relation) const {
    return words_for(run_.topology.descriptor_count(relation));
  }
  [[nodiscard]] Word& word(std::uint32_t relation, std::uint32_t k) {
    return words_[first_word_[relation] + k];
  }
  [[nodiscard]] const Word& word(std::uint32_t relation, std::uint32_t k) const {
    return words_[first_word_[relation] + k];
  }
  /// Bits of word k that belong to descriptors of the relation.
  [[nodiscard]] std::uint64_t valid(std::uint32_t relation, std::uint32_t k) const {
    const std::uint32_t rest = run_.topology.descriptor_count(relation) - 64 * k;
    return rest >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << rest) - 1;
  }

  /// Steps every class of `members` (bits of word k) once; calls `effect(class, output)` for each.
  template <class Event, class Effect>
  void step(std::uint32_t relation, std::uint32_t k, std::uint64_t members, const Input& input,
            Effect&& effect);

  RunState& run_;
  fsm::Flyweight<Machine> machine_;
  std::vector<Word> words_;
  std::vector<std::uint32_t> first_word_;  // by relation
  std::vector<std::uint64_t> scratch_;
};

}  // namespace stormproof::model
