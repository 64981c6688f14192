// Relations of which only HEARTBEATs and ACKNACKs are modelled: liveliness between any two
// participants, and the user endpoints that match once both sides have been discovered. In a storm
// of Fast DDS this traffic takes a good part of the channel, so it must be there; it is counted
// apart from the six classes.
#pragma once

#include <cstdint>
#include <vector>

#include "fsm/control_relation.hpp"
#include "fsm/single_shot.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/initial_attempts.hpp"
#include "model/engine/network.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::model::fastdds {

/// What the control traffic must know of discovery.
class Discovered {
 public:
  virtual ~Discovered() = default;
  /// Whether participant i has created descriptor d of stream s.
  [[nodiscard]] virtual bool is_created(std::uint32_t i, Stream s, std::uint32_t d) const = 0;
  /// Whether the destination of `pair` has been notified of the source's descriptor d of stream s.
  [[nodiscard]] virtual bool is_notified(std::uint32_t pair, Stream s, std::uint32_t d) const = 0;
};

class ControlTraffic {
 public:
  ControlTraffic(RunState& run, Network& network, const Discovered& discovered);

  /// j has recognised i; `pair` is (i, j), cross-host: liveliness opens on j's side.
  void recognised(std::uint32_t pair);
  /// Participant i has created descriptor d of stream s.
  void created(std::uint32_t i, Stream s, std::uint32_t d);
  /// The destination of `pair` (cross-host) has been notified of the source's descriptor d of
  /// stream s.
  void notified(std::uint32_t pair, Stream s, std::uint32_t d);

  /// A packet of a control-only relation has arrived.
  void received(const Packet& packet);
  /// An initial ACKNACK or a reply of a control-only relation is due.
  void handle(const Event& event);

 private:
  /// Writer at the pair's source, reader at its destination.
  struct Relation {
    std::uint32_t pair = 0;
    fsm::StateId writer = fsm::Flyweight<fsm::ControlWriter>::initial;
    fsm::StateId reader = fsm::Flyweight<fsm::ControlReader>::initial;
    InitialTimer initial;
    fsm::StateId reply = fsm::Flyweight<fsm::SingleShot>::initial;
    bool heartbeat_seen = false;
  };

  /// Whether the pair has a relation on the topic: the source publishes it and the destination
  /// subscribes to it.
  [[nodiscard]] bool exists(std::uint32_t pair, std::uint32_t topic) const;
  [[nodiscard]] std::uint32_t relation_of(std::uint32_t pair, std::uint32_t topic) const {
    return first_relation_[pair] + topic;
  }
  void open_writer(std::uint32_t relation);
  void open_reader(std::uint32_t relation);
  void emit_heartbeat(std::uint32_t relation);
  void emit_acknack(std::uint32_t relation, bool initial);

  RunState& run_;
  Network& network_;
  const Discovered& discovered_;
  InitialAttempts initial_attempts_;
  std::vector<std::uint32_t> first_relation_;  // by pair
  std::vector<Relation> relations_;
  Driver<fsm::ControlWriter> writer_driver_{run_, MachineRef::Kind::control_relation};
  Driver<fsm::ControlReader> reader_driver_{run_, MachineRef::Kind::control_relation};
  Driver<fsm::SingleShot> reply_driver_{run_, MachineRef::Kind::control_relation};
};

}  // namespace stormproof::model::fastdds
