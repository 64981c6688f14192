// What all implementations of discovery do alike: announcing, recognising, opening a reader side,
// and the answers of a reader, which machines shared by all decide (fsm/discovery_reader.hpp,
// fsm/initial_acknack.hpp, fsm/announcer.hpp, fsm/heartbeat_timer.hpp). Who sends what to whom, and
// what a descriptor goes through at the writer, is the implementation's own business.
#pragma once

#include <cstdint>

#include "fsm/discovery_reader.hpp"
#include "model/engine/announcement_schedule.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/heartbeat_schedule.hpp"
#include "model/engine/implementation.hpp"
#include "model/engine/initial_attempts.hpp"
#include "model/engine/network.hpp"

namespace stormproof::model {

class DiscoveryBase : public Implementation, protected HeartbeatSender {
 public:
  /// An announcement, an answer of a reader or an event of the HEARTBEAT timer is due. An
  /// implementation takes its own events first.
  void handle(const Event& event) override;

 protected:
  /// The reader side of a relation.
  struct ReaderSide {
    fsm::StateId reader = fsm::Stepper<fsm::DiscoveryReader>::initial;
    InitialTimer initial;
    bool heartbeat_seen = false;
    std::uint32_t missing = 0;  ///< descriptors with X = 0
  };
  /// Whether an announcement goes to the multicast group before its unicast copies, or after them.
  enum class Multicast : std::uint8_t { first, last };

  /// `accepts_unmatched`: what a reader side that is not open does with DATA and HEARTBEATs.
  DiscoveryBase(RunState& run, Network& network, Multicast multicast, bool accepts_unmatched);

  [[nodiscard]] virtual ReaderSide& reader_side(std::uint32_t relation) = 0;
  /// A unicast announcement to each participant that i knows.
  virtual void send_spdp_to_known(std::uint32_t i) = 0;
  virtual void send_spdp_multicast(std::uint32_t i) = 0;
  /// A unicast announcement from the pair's source to its destination.
  virtual void send_spdp_copy(std::uint32_t pair) = 0;
  virtual void emit_acknack(std::uint32_t relation, bool initial) = 0;
  /// An ACKNACK of the relation is due; the default lets its machine decide.
  virtual void acknack_generation(std::uint32_t relation);

  /// What the source of `reverse_pair` sends when it recognises the destination.
  void resend(std::uint32_t reverse_pair);
  void open_reader(std::uint32_t relation);
  /// Whether the reader takes a DATA after which `missing_after` descriptors are missing.
  [[nodiscard]] bool takes_data(std::uint32_t relation, std::uint32_t missing_after);
  /// Whether the reader answers the HEARTBEAT, which it has seen then.
  [[nodiscard]] bool sees_heartbeat(std::uint32_t relation);
  /// Whether `fresh` descriptors are all that the run still lacks.
  [[nodiscard]] bool completes(std::uint32_t fresh) const {
    return fresh == run_.missing && fresh > 0;
  }
  /// The descriptor that the reader of the relation lacks completes the run.
  void note_last_delivery(std::uint32_t relation, std::uint32_t descriptor);

  [[nodiscard]] static Packet packet_of(PacketKind kind, std::uint32_t pair,
                                        std::int64_t payload_bytes);
  [[nodiscard]] static Packet packet_on(PacketKind kind, std::uint32_t relation,
                                        std::int64_t payload_bytes);

  [[nodiscard]] const Pair& ends(std::uint32_t relation) const {
    return run_.topology.pair(relation / 2);
  }
  [[nodiscard]] std::uint32_t writer_of(std::uint32_t relation) const {
    return 2 * ends(relation).source + relation % 2;
  }
  [[nodiscard]] static Stream stream_of(std::uint32_t relation_or_writer) {
    return relation_or_writer % 2 == 0 ? Stream::pub : Stream::sub;
  }

  RunState& run_;
  Network& network_;
  const SpdpProfile& spdp_;
  const SedpProfile& sedp_;
  HeartbeatSchedule heartbeats_;
  AnnouncementSchedule announcements_;

 private:
  void send_spdp(std::uint32_t i);
  void initial_acknack_due(std::uint32_t relation);
  template <class ReaderEvent>
  Driver<fsm::DiscoveryReader>::Output step(std::uint32_t relation, ReaderSide& side,
                                            std::uint32_t missing_after);

  const Multicast multicast_;
  const bool accepts_unmatched_;
  InitialAttempts initial_attempts_;
  Driver<fsm::DiscoveryReader> reader_driver_;
};

}  // namespace stormproof::model
