// The paper's DDS implementation: announcements, the reader side and the writer side of every relation, by the
// rules of specs/model.md. The class is spread over five source files by rule group:
//   announcements.cpp  SPDP: sending, reception, opening of relations
//   reader.cpp         reception of DATA and HEARTBEAT, ACKNACKs
//   writer.cpp         reception of ACKNACKs, repair, suppression
//   data.cpp           generation of DATA and HEARTBEATs, grouping, piggyback
//   heartbeat.cpp      the HEARTBEAT timer with both policies
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fsm/announcer.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/heartbeat_timer.hpp"
#include "fsm/initial_acknack.hpp"
#include "model/descriptor_sizes.hpp"
#include "model/engine/descriptor_states.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/implementation.hpp"
#include "model/engine/network.hpp"

namespace stormproof::model::paper {

/// A rank that no recipient has: the relation is not open, the participant is not known.
inline constexpr std::uint32_t no_rank = UINT32_MAX;

class Protocol final : public Implementation {
 public:
  Protocol(RunState& run, Network& network);

  void start() override;
  void handle(const Event& event) override;
  void source_completed(const Packet& packet) override;
  void received(const Packet& packet) override;
  [[nodiscard]] std::uint32_t next_recipient(const Packet& packet,
                                             std::uint32_t pair) const override;
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override;

 private:
  struct Relation {
    std::uint32_t missing = 0;         ///< descriptors with X = 0
    std::uint32_t unacknowledged = 0;  ///< descriptors not in A
    std::uint32_t open_rank = no_rank; ///< writer side: how many relations of the writer opened before
    fsm::StateId reader = 0;
    fsm::StateId initial = fsm::Flyweight<fsm::InitialAckNack>::initial;
    bool heartbeat_seen = false;
    std::uint8_t attempts = 0;         ///< the current initial delay is τ_I · 2^attempts
  };

  /// Cycle data of the adaptive policy; a writer has it from its first cycle on.
  struct Cycle {
    Nanoseconds start;
    Nanoseconds period;
    std::uint32_t token = 0;  ///< events with an older token are void
    std::uint32_t responded = 0;
    std::vector<std::uint32_t> contacted;  ///< relations, ascending
    std::vector<bool> has_responded;       ///< parallel to `contacted`
    std::vector<std::vector<std::uint32_t>> batches;
    std::size_t next_batch = 0;
  };

  struct Writer {
    std::int64_t budget = 0;             ///< piggyback budget, bytes
    std::uint32_t open = 0;              ///< open relations
    std::uint32_t unacknowledged = 0;    ///< open relations with a descriptor not in A
    std::uint32_t first_open_pair = UINT32_MAX;
    std::uint32_t pending_expiries = 0;
    fsm::StateId timer = fsm::Flyweight<fsm::HeartbeatTimer>::initial;
    std::vector<std::uint64_t> waiting_readers;  ///< bit per peer: open and something not in A
    std::unique_ptr<Cycle> cycle;
  };

  struct Participant {
    fsm::StateId announcer = fsm::Flyweight<fsm::Announcer>::initial;
    std::uint32_t announcements = 0;
    std::uint32_t known = 0;            ///< cross-host participants it has recognised
    std::uint32_t first_known_pair = UINT32_MAX;
    std::int64_t sent_bytes = 0;        ///< the cumulative charge of the piggyback rule
  };

  // announcements.cpp
  void announcement_due(std::uint32_t i);
  void send_spdp(std::uint32_t i);
  void send_spdp_multicast(std::uint32_t i);
  void send_spdp_copy(std::uint32_t pair);
  void spdp_received(std::uint32_t pair);
  void resend(std::uint32_t reverse_pair);
  void open_reader(std::uint32_t relation);
  void open_writer(std::uint32_t relation);

  // reader.cpp
  void data_received(const Packet& packet);
  void heartbeat_received(std::uint32_t relation);
  void acknack_generation(std::uint32_t relation);
  void initial_acknack_due(std::uint32_t relation);
  void step_initial(std::uint32_t relation, bool opened);
  void emit_acknack(std::uint32_t relation, bool initial);
  [[nodiscard]] bool has_started(std::uint32_t participant) const;

  // writer.cpp
  void acknack_received(const Packet& packet);
  void repair_generation(std::uint32_t relation);
  void suppression_end(std::uint32_t relation);

  // data.cpp
  void generate_data(std::uint32_t relation, const DescriptorSet& descriptors, bool repair);
  void generate_heartbeat(std::uint32_t relation);
  void generate_heartbeat_to_open(std::uint32_t writer);
  void generate_heartbeat_to_unacknowledged(std::uint32_t writer);
  struct Message;
  void flush(Message& message);
  void charge(Message& message, std::int64_t added_bytes);

  // heartbeat.cpp
  template <class TimerEvent>
  void step_timer(std::uint32_t writer, std::uint32_t responding_reader = no_rank);
  using TimerOutput = Driver<fsm::HeartbeatTimer>::Output;
  [[nodiscard]] Driver<fsm::HeartbeatTimer>::Input timer_input(const Writer& writer) const;
  void apply_periodic(std::uint32_t writer, const TimerOutput& output);
  void apply_adaptive(std::uint32_t writer, const TimerOutput& output,
                      std::uint32_t responding_reader);
  void contact(std::uint32_t writer);
  void plan_batches(std::uint32_t writer, Nanoseconds stretched);
  void send_batch(std::uint32_t writer);
  void cycle_event(const Event& event);
  void response(std::uint32_t relation);

  [[nodiscard]] const Pair& ends(std::uint32_t relation) const {
    return run_.topology.pair(relation / 2);
  }
  [[nodiscard]] std::uint32_t writer_of(std::uint32_t relation) const {
    return 2 * ends(relation).source + relation % 2;
  }
  [[nodiscard]] static Stream stream_of(std::uint32_t relation_or_writer) {
    return relation_or_writer % 2 == 0 ? Stream::pub : Stream::sub;
  }
  template <class Visit>
  void for_each_unacknowledged(std::uint32_t writer, Visit&& visit) const;

  RunState& run_;
  Network& network_;
  const SpdpProfile& spdp_;
  const SedpProfile& sedp_;
  const bool accepts_unmatched_;
  DescriptorStates descriptors_;
  std::vector<Participant> participants_;
  std::vector<Writer> writers_;           // 2 · participant + stream
  std::vector<Relation> relations_;
  std::vector<std::uint32_t> known_rank_; // by pair (i, j): when i recognised j
  const DescriptorSizes sizes_;

  Driver<fsm::Announcer> announcer_driver_{MachineRef::Kind::participant};
  Driver<fsm::DiscoveryReader> reader_driver_{MachineRef::Kind::relation};
  Driver<fsm::InitialAckNack> initial_driver_{MachineRef::Kind::relation};
  Driver<fsm::HeartbeatTimer> timer_driver_{MachineRef::Kind::writer};
};

template <class Visit>
void Protocol::for_each_unacknowledged(std::uint32_t writer, Visit&& visit) const {
  const std::vector<std::uint64_t>& words = writers_[writer].waiting_readers;
  const std::uint32_t first_pair = run_.topology.first_pair(writer / 2);
  for (std::size_t k = 0; k < words.size(); ++k) {
    for (std::uint64_t bits = words[k]; bits != 0; bits &= bits - 1) {
      const auto peer = static_cast<std::uint32_t>(64 * k) +
                        static_cast<std::uint32_t>(std::countr_zero(bits));
      visit(2 * (first_pair + peer) + writer % 2);
    }
  }
}

}  // namespace stormproof::model::paper
