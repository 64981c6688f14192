// Relations of which only HEARTBEATs and ACKNACKs are modelled: liveliness between any two
// participants, what asks for types and answers, and the user endpoints that match once both sides
// have been discovered. In a storm
// of Fast DDS this traffic takes a good part of the channel, so it must be there; it is counted
// apart from the six classes. Here is what its rules (fsm/composition/control.hpp) are about, and
// which relations there are.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/scenario.hpp"

namespace stormproof::model::fastdds {

/// One side of a control-only relation.
struct ControlSide {
  std::uint32_t relation = 0;
  bool writer = false;
};

class ControlRelations {
 public:
  ControlRelations(const Topology& topology, const Scenario& scenario);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(pairs_.size()); }
  /// Those of a pair: from the first one until before the second.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> of(std::uint32_t pair) const {
    return {first_relation_[pair], first_relation_[pair + 1]};
  }
  /// Writer at the pair's source, reader at its destination.
  [[nodiscard]] std::uint32_t pair_of(std::uint32_t relation) const { return pairs_[relation]; }
  /// The relation of a pair on a topic, if the source publishes it and the destination subscribes
  /// to it; otherwise `topic::none`.
  [[nodiscard]] std::uint32_t find(std::uint32_t pair, std::uint32_t topic) const;
  /// Of one that is no lookup.
  [[nodiscard]] std::uint32_t topic_of(std::uint32_t relation) const {
    return relation - first_relation_[pairs_[relation]];
  }
  /// It is one of questions or answers.
  [[nodiscard]] bool is_lookup(std::uint32_t relation) const {
    return relation >= first_lookup(pairs_[relation]);
  }
  /// Which of the writers of the pair's source (`control_writers`) it is of.
  [[nodiscard]] std::uint32_t writer_of(std::uint32_t relation) const {
    const std::uint32_t topic =
        is_lookup(relation) ? relation - first_lookup(pairs_[relation]) : control_writers - 1;
    return control_writers * topology_.pair(pairs_[relation]).source + topic;
  }
  /// It is no user topic.
  [[nodiscard]] bool is_builtin(std::uint32_t relation) const {
    const std::uint32_t pair = pairs_[relation];
    return relation == find(pair, topic::liveliness) || is_lookup(relation);
  }
  /// A HEARTBEAT or ACKNACK of a relation.
  [[nodiscard]] Packet packet_of(PacketKind kind, std::uint32_t relation, std::int64_t bytes) const;

 private:
  [[nodiscard]] std::uint32_t first_lookup(std::uint32_t pair) const {
    return first_relation_[pair + 1] - lookups_[pair];
  }

  const Topology& topology_;
  std::vector<std::uint8_t> lookups_;          // by pair: how many, its last ones
  std::vector<std::uint32_t> first_relation_;  // by pair
  std::vector<std::uint32_t> pairs_;           // by relation
};

}  // namespace stormproof::model::fastdds
