// Relations of which only HEARTBEATs and ACKNACKs are modelled: liveliness between any two
// participants, and the user endpoints that match once both sides have been discovered. In a storm
// of Fast DDS this traffic takes a good part of the channel, so it must be there; it is counted
// apart from the six classes. Here is what its rules (fsm/composition/control.hpp) are about, and
// which relations there are.
#pragma once

#include <cstdint>
#include <vector>

#include "fsm/composition/control.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/packet.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::model::fastdds {

/// One side of a control-only relation.
struct ControlSide {
  std::uint32_t relation = 0;
  bool writer = false;
};

class ControlRelations {
 public:
  explicit ControlRelations(RunState& run);

  /// Writer at the pair's source, reader at its destination.
  struct Relation {
    std::uint32_t pair = 0;
    fsm::StateId writer = fsm::Stepper<fsm::ControlWriter>::initial;
    fsm::StateId reader = fsm::Stepper<fsm::ControlReader>::initial;
    fsm::StateId initial = fsm::Stepper<fsm::InitialAckNack>::initial;
    fsm::StateId reply = fsm::Stepper<fsm::SingleShot>::initial;
    bool heartbeat_seen = false;
    std::int64_t last_delay = 0;  ///< of the initial ACKNACK, ns
  };
  [[nodiscard]] Relation& of(std::uint32_t relation) { return relations_[relation]; }
  [[nodiscard]] const Relation& of(std::uint32_t relation) const { return relations_[relation]; }
  /// The relation of a pair on a topic, if the source publishes it and the destination subscribes
  /// to it; otherwise `topic::none`.
  [[nodiscard]] std::uint32_t find(std::uint32_t pair, std::uint32_t topic) const;
  /// A HEARTBEAT or ACKNACK of a relation.
  [[nodiscard]] Packet packet_of(PacketKind kind, std::uint32_t relation, std::int64_t bytes) const;

  Driver<fsm::ControlWriter> writer_driver;
  Driver<fsm::ControlReader> reader_driver;
  Driver<fsm::InitialAckNack> initial_driver;
  Driver<fsm::SingleShot> reply_driver;

 private:
  std::vector<std::uint32_t> first_relation_;  // by pair
  std::vector<Relation> relations_;
};

}  // namespace stormproof::model::fastdds
