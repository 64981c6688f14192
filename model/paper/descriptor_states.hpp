// The descriptors of every relation as the paper's writer sees them: which event each rule applies
// to which of them. The machine is fsm/descriptor_repair.hpp.
#pragma once

#include "fsm/descriptor_repair.hpp"
#include "model/engine/relation_bits.hpp"

namespace stormproof::model::paper {

class DescriptorStates : public RelationBits<fsm::DescriptorRepair> {
 public:
  using RelationBits::RelationBits;

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
};

}  // namespace stormproof::model::paper
