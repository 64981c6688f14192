// The descriptors of every relation as Fast DDS's writer sees them (its ChangeForReader records):
// which event each rule applies to which of them. The machine is fsm/change_for_reader.hpp.
#pragma once

#include "fsm/change_for_reader.hpp"
#include "model/engine/relation_bits.hpp"

namespace stormproof::model::fastdds {

class ChangeStates : public RelationBits<fsm::ChangeForReader> {
 public:
  using RelationBits::RelationBits;

  /// The reader is matched when the first `existing` descriptors exist: they wait to be asked for.
  void matched(std::uint32_t relation, std::uint32_t existing);
  /// Descriptor d is created for a reader that is matched: it is to be pushed.
  void created(std::uint32_t relation, std::uint32_t d);
  /// An ACKNACK with this base and bitmap. Returns whether something was newly requested.
  bool acknack(std::uint32_t relation, std::uint32_t base, const DescriptorSet& bitmap);
  /// An initial ACKNACK: what was acknowledged is not any more.
  void initial_acknack(std::uint32_t relation);
  /// The nack response: what was requested is to be sent. Returns the descriptors to enqueue.
  [[nodiscard]] DescriptorSet nack_response(std::uint32_t relation);
  /// Descriptor d is serialized into a message.
  void serialized(std::uint32_t relation, std::uint32_t d);
  /// The suppression of the relation ends.
  void suppression_ended(std::uint32_t relation);

  /// Whether descriptor d is to be sent (Q).
  [[nodiscard]] bool is_queued(std::uint32_t relation, std::uint32_t d) const;
  /// Whether some descriptor is unacknowledged and not on its way (U).
  [[nodiscard]] bool has_unacknowledged(std::uint32_t relation) const;
  /// Whether all of the first `count` descriptors are acknowledged (A).
  [[nodiscard]] bool all_acknowledged(std::uint32_t relation, std::uint32_t count) const;
};

}  // namespace stormproof::model::fastdds
