// Relations of which only HEARTBEATs and ACKNACKs are modelled: liveliness between any two
// participants, and the user endpoints that match once both sides have been discovered. In a storm
// of Fast DDS this traffic takes a good part of the channel, so it must be there; it is counted
// apart from the six classes. Here is what its rules (fsm/composition/control.hpp) are about, and
// which relations there are.
#pragma once

#include <cstdint>
#include <vector>

#include "fsm/composition/control.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/run_state.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::model::fastdds {

/// One side of a control-only relation.
struct ControlSide {
  std::uint32_t relation = 0;
  bool writer = false;
};

class ControlRelations {
 public:
  explicit ControlRelations(const RunState& run);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(pairs_.size()); }
  /// Writer at the pair's source, reader at its destination.
  [[nodiscard]] std::uint32_t pair_of(std::uint32_t relation) const { return pairs_[relation]; }
  /// The relation of a pair on a topic, if the source publishes it and the destination subscribes
  /// to it; otherwise `topic::none`.
  [[nodiscard]] std::uint32_t find(std::uint32_t pair, std::uint32_t topic) const;
  /// A HEARTBEAT or ACKNACK of a relation.
  [[nodiscard]] Packet packet_of(PacketKind kind, std::uint32_t relation, std::int64_t bytes) const;

 private:
  std::vector<std::uint32_t> first_relation_;  // by pair
  std::vector<std::uint32_t> pairs_;           // by relation
};

}  // namespace stormproof::model::fastdds
