// ACKNACK, repair generation, repair delivery and suppression end, on the descriptors of one
// relation.
#include "model/paper/descriptor_states.hpp"

namespace stormproof::model::paper {

namespace repair = fsm::descriptor_repair;

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
    const std::uint64_t prefix = below(first_missing, k);
    const std::uint64_t listed = bitmap.word(k);
    Input input{.listed = true, .below_first_missing = false, .prefix_only = prefix_only};
    step<repair::AckNackReceived>(relation, k, listed, input, count);
    input.listed = false;
    step<repair::AckNackReceived>(relation, k, ~listed & ~prefix, input, count);
    input.below_first_missing = true;
    step<repair::AckNackReceived>(relation, k, ~listed & prefix, input, count);
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
    step<repair::RepairSent>(relation, k, descriptors.word(k));
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

}  // namespace stormproof::model::paper
