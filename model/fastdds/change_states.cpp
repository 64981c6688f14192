// The events of Fast DDS's writer on the descriptors of one relation.
#include "model/fastdds/change_states.hpp"

namespace stormproof::model::fastdds {

namespace change = fsm::change_for_reader;
using States = fsm::Reflect<fsm::ChangeForReader>;

namespace {
constexpr std::uint64_t bit_of(std::uint32_t d) { return std::uint64_t{1} << d % 64; }
}  // namespace

void ChangeStates::matched(std::uint32_t relation, std::uint32_t existing) {
  for (std::uint32_t k = 0; k < words_for(existing); ++k) {
    step<change::ReaderMatched>(relation, k, below(existing, k));
  }
}

void ChangeStates::created(std::uint32_t relation, std::uint32_t d) {
  step<change::Created>(relation, d / 64, bit_of(d));
}

bool ChangeStates::acknack(std::uint32_t relation, std::uint32_t base,
                           const DescriptorSet& bitmap) {
  bool requested = false;
  for (std::uint32_t k = 0; k < word_count(relation); ++k) {
    const std::uint64_t acknowledged = below(base, k);
    step<change::AckNackReceived>(relation, k, valid(relation, k) & acknowledged,
                                  {.listed = false, .below_base = true});
    step<change::AckNackReceived>(
        relation, k, bitmap.word(k) & ~acknowledged, {.listed = true, .below_base = false},
        [&](std::uint64_t, const Output& output) { requested = requested || output.requested; });
  }
  return requested;
}

void ChangeStates::initial_acknack(std::uint32_t relation) {
  for (std::uint32_t k = 0; k < word_count(relation); ++k) {
    step<change::InitialAckNackReceived>(relation, k, valid(relation, k));
  }
}

DescriptorSet ChangeStates::nack_response(std::uint32_t relation) {
  scratch_.assign(word_count(relation), 0);
  for (std::uint32_t k = 0; k < word_count(relation); ++k) {
    step<change::NackResponseDue>(relation, k, valid(relation, k), {},
                                  [&](std::uint64_t members, const Output& output) {
                                    if (output.enqueue) scratch_[k] |= members;
                                  });
  }
  return DescriptorSet{scratch_};
}

void ChangeStates::serialized(std::uint32_t relation, std::uint32_t d) {
  step<change::Serialized>(relation, d / 64, bit_of(d));
}

void ChangeStates::suppression_ended(std::uint32_t relation) {
  for (std::uint32_t k = 0; k < word_count(relation); ++k) {
    step<change::SuppressionEnded>(relation, k, valid(relation, k));
  }
}

bool ChangeStates::is_queued(std::uint32_t relation, std::uint32_t d) const {
  return (in_state(relation, d / 64, States::id<change::Q>) & bit_of(d)) != 0;
}

bool ChangeStates::has_unacknowledged(std::uint32_t relation) const {
  for (std::uint32_t k = 0; k < word_count(relation); ++k) {
    if (in_state(relation, k, States::id<change::U>) != 0) return true;
  }
  return false;
}

bool ChangeStates::all_acknowledged(std::uint32_t relation, std::uint32_t count) const {
  for (std::uint32_t k = 0; k < words_for(count); ++k) {
    if ((below(count, k) & ~in_state(relation, k, States::id<change::A>)) != 0) return false;
  }
  return true;
}

}  // namespace stormproof::model::fastdds
