// Class-wise stepping of the descriptor machines; see the header for the idea.
#include "model/engine/descriptor_states.hpp"

#include <array>

namespace stormproof::model {

namespace repair = fsm::descriptor_repair;

DescriptorStates::DescriptorStates(RunState& run) : run_{run} {
  static_assert(fsm::Flyweight<Machine>::initial == 0, "zeroed planes must mean the initial state");
  std::uint32_t next = 0;
  first_word_.reserve(run.topology.relation_count());
  for (std::uint32_t relation = 0; relation < run.topology.relation_count(); ++relation) {
    first_word_.push_back(next);
    next += word_count(relation);
  }
  words_.resize(next);
}

template <class Event, class Effect>
void DescriptorStates::step(std::uint32_t relation, std::uint32_t k, std::uint64_t members,
                            const Input& input, Effect&& effect) {
  constexpr std::size_t states = fsm::Reflect<Machine>::state_count;
  Word& planes_now = word(relation, k);
  // Classes are taken from the states before the event: a descriptor takes one step, not two.
  std::array<std::uint64_t, states> classes;
  for (std::size_t s = 0; s < states; ++s) {
    classes[s] = members;
    for (std::size_t b = 0; b < state_bits; ++b) {
      classes[s] &= (s >> b & 1) != 0 ? planes_now.state[b] : ~planes_now.state[b];
    }
  }
  for (std::size_t s = 0; s < states; ++s) {
    if (classes[s] == 0) continue;
    Output output{};
    const auto before = static_cast<fsm::StateId>(s);
    const fsm::StateId after = machine_.step<Event>(before, input, output);
    for (std::size_t b = 0; b < state_bits; ++b) {
      if ((after >> b & 1) != 0) planes_now.state[b] |= classes[s];
      else planes_now.state[b] &= ~classes[s];
    }
    if (run_.probe != nullptr && after != before) {
      const auto& names = fsm::Reflect<Machine>::state_names;
      run_.probe->transition(
          {fsm::name_of<Machine>(), MachineRef::Kind::relation, relation}, fsm::name_of<Event>(),
          names[before], names[after], k, classes[s]);
    }
    effect(classes[s], output);
  }
}

std::uint32_t DescriptorStates::receive(std::uint32_t relation, const DescriptorSet& descriptors) {
  std::uint32_t fresh = 0;
  for (std::uint32_t k = descriptors.first_word(); k < descriptors.end_word(); ++k) {
    Word& target = word(relation, k);
    fresh += static_cast<std::uint32_t>(std::popcount(descriptors.word(k) & ~target.received));
    target.received |= descriptors.word(k);
  }
  return fresh;
}

std::uint32_t DescriptorStates::count_missing(std::uint32_t relation,
                                              const DescriptorSet& descriptors) const {
  std::uint32_t missing = 0;
  for (std::uint32_t k = descriptors.first_word(); k < descriptors.end_word(); ++k) {
    missing += static_cast<std::uint32_t>(
        std::popcount(descriptors.word(k) & ~word(relation, k).received));
  }
  return missing;
}

DescriptorSet DescriptorStates::missing(std::uint32_t relation) {
  scratch_.clear();
  for (std::uint32_t k = 0; k < word_count(relation); ++k) {
    scratch_.push_back(valid(relation, k) & ~word(relation, k).received);
  }
  return DescriptorSet{scratch_};
}

DescriptorSet DescriptorStates::all(std::uint32_t relation) {
  scratch_.clear();
  for (std::uint32_t k = 0; k < word_count(relation); ++k) scratch_.push_back(valid(relation, k));
  return DescriptorSet{scratch_};
}

std::uint64_t DescriptorStates::mark_generated(std::uint32_t relation, std::uint32_t k,
                                               std::uint64_t bits) {
  Word& target = word(relation, k);
  const std::uint64_t fresh = bits & ~target.generated;
  target.generated |= bits;
  return fresh;
}

DescriptorStates::AckNackEffect DescriptorStates::acknack(std::uint32_t relation,
                                                          const DescriptorSet& bitmap,
                                                          bool prefix_only) {
  AckNackEffect total;
  const auto count = [&](std::uint64_t members, const Output& output) {
    const auto size = static_cast<std::uint32_t>(std::popcount(members));
    if (output.requested) total.requested += size;
    if (output.acknowledged) total.acknowledged += size;
  };
  const std::uint32_t first_missing = bitmap.lowest();
  for (std::uint32_t k = 0; k < word_count(relation); ++k) {
    std::uint64_t below = 0;  // descriptors of this word below the first missing one
    if (64 * k + 64 <= first_missing) below = ~std::uint64_t{0};
    else if (64 * k < first_missing) below = (std::uint64_t{1} << (first_missing - 64 * k)) - 1;

    const std::uint64_t all = valid(relation, k);
    const std::uint64_t listed = bitmap.word(k) & all;
    Input input{.listed = true, .below_first_missing = false, .prefix_only = prefix_only};
    step<repair::AckNackReceived>(relation, k, listed, input, count);
    input.listed = false;
    step<repair::AckNackReceived>(relation, k, all & ~listed & ~below, input, count);
    input.below_first_missing = true;
    step<repair::AckNackReceived>(relation, k, all & ~listed & below, input, count);
  }
  return total;
}

DescriptorSet DescriptorStates::repair_due(std::uint32_t relation) {
  scratch_.assign(word_count(relation), 0);
  for (std::uint32_t k = 0; k < word_count(relation); ++k) {
    step<repair::RepairDue>(relation, k, valid(relation, k), {},
                            [&](std::uint64_t members, const Output& output) {
                              if (output.generate) scratch_[k] |= members;
                            });
  }
  return DescriptorSet{scratch_};
}

void DescriptorStates::repair_sent(std::uint32_t relation, const DescriptorSet& descriptors) {
  for (std::uint32_t k = descriptors.first_word(); k < descriptors.end_word(); ++k) {
    step<repair::RepairSent>(relation, k, descriptors.word(k), {},
                             [](std::uint64_t, const Output&) {});
  }
}

std::uint32_t DescriptorStates::suppression_ended(std::uint32_t relation) {
  std::uint32_t returned = 0;
  for (std::uint32_t k = 0; k < word_count(relation); ++k) {
    step<repair::SuppressionEnded>(
        relation, k, valid(relation, k), {}, [&](std::uint64_t members, const Output& output) {
          if (output.returned) returned += static_cast<std::uint32_t>(std::popcount(members));
        });
  }
  return returned;
}

}  // namespace stormproof::model
