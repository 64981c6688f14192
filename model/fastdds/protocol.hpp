// Fast DDS 2.6.11 as its source code has it (specs/guide/fastdds.md): endpoints are created over
// time, descriptors that exist at the match are pulled and later ones pushed, one writer serves all
// its readers, and what is repaired goes through one asynchronous queue per participant. By rule
// group:
//   announcements.cpp  creation of endpoints, SPDP, matching
//   writer.cpp         HEARTBEATs, ACKNACKs, nack response, suppression
//   sender.cpp         creation and async run: messages, piggyback, flushing
//   reader.cpp         DATA, HEARTBEATs, ACKNACKs at the reader
//   control.cpp        relations of which only the control traffic is modelled
//   (fastdds::ControlTraffic)
// What the paper's implementation does alike is in model/engine/discovery_base.hpp.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "fsm/single_shot.hpp"
#include "model/engine/discovery_base.hpp"
#include "model/fastdds/change_states.hpp"
#include "model/fastdds/control.hpp"
#include "model/fastdds/message.hpp"

namespace stormproof::model::fastdds {

class Protocol final : public DiscoveryBase, private Discovered {
 public:
  static constexpr SameHostPairs same_host_pairs =
      SameHostPairs::included;  ///< a writer treats all readers alike

  Protocol(RunState& run, Network& network);

  void start() override;
  void handle(const Event& event) override;
  void source_completed(const Packet&) override {}  // suppression runs from serialization
  [[nodiscard]] bool receives_separately() const override { return true; }
  [[nodiscard]] std::vector<std::uint32_t> receivers(const Packet& packet) const override;
  void received(const Packet& packet, std::uint32_t receiver) override;
  void renew_bitmap(Packet& acknack) override;
  [[nodiscard]] std::uint32_t next_recipient(const Packet&, std::uint32_t pair) const override {
    return pair;  // every packet stands for itself
  }
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override;

 private:
  struct Relation : ReaderSide {
    // Writer side.
    bool matched = false;
    std::uint32_t low = 0;  ///< every descriptor below it is acknowledged
    fsm::StateId suppression = fsm::Flyweight<fsm::SingleShot>::initial;
    // Reader side.
    fsm::StateId reply = fsm::Flyweight<fsm::SingleShot>::initial;
    std::uint32_t announced = 0;  ///< descriptors that the reader knows to exist
    std::uint32_t notified = 0;   ///< descriptors received without a gap
  };
  struct Writer {
    std::uint32_t created = 0;           ///< H: descriptors created so far
    std::int64_t budget = 0;             ///< piggyback budget, bytes
    std::vector<std::uint32_t> readers;  ///< M: relations in match order
    fsm::StateId nack_response = fsm::Flyweight<fsm::SingleShot>::initial;
    std::vector<std::uint64_t> enqueued;  ///< bit per descriptor: in the participant's async queue
  };
  struct Participant {
    fsm::StateId async_run = fsm::Flyweight<fsm::SingleShot>::initial;
    std::deque<Endpoint> queue;   ///< what the async run will send
    std::int64_t sent_bytes = 0;  ///< all bytes that the async sender has ever sent
  };

  // announcements.cpp
  void create_endpoint(std::uint32_t i, std::uint32_t k);
  void send_spdp_to_known(std::uint32_t i) override;
  void send_spdp_multicast(std::uint32_t i) override;
  void send_spdp_copy(std::uint32_t pair) override;
  void spdp_received(std::uint32_t pair);
  void match_reader(std::uint32_t relation);

  // writer.cpp
  void acknack_received(const Packet& packet);
  void initial_acknack_received(std::uint32_t relation);
  void nack_response(std::uint32_t writer);
  void suppression_end(std::uint32_t relation);
  [[nodiscard]] bool is_behind(std::uint32_t relation) const;
  void emit_heartbeat(std::uint32_t relation, std::int64_t bytes);

  // HeartbeatSender, in writer.cpp
  [[nodiscard]] bool needs_heartbeat(std::uint32_t writer) const override;
  [[nodiscard]] std::vector<std::uint32_t> unacknowledged(std::uint32_t writer) const override;
  [[nodiscard]] bool is_unacknowledged(std::uint32_t relation) const override;
  [[nodiscard]] std::uint32_t announced(std::uint32_t writer) const override;
  void send_periodic(std::uint32_t writer) override;
  void send_heartbeat(std::uint32_t relation) override;

  // sender.cpp
  enum class SendMode : std::uint8_t { sync, async };
  void push(std::uint32_t writer, std::uint32_t d);
  void async_run(std::uint32_t i);
  void deliver(Message& message, std::uint32_t writer, std::uint32_t d,
               const std::vector<std::uint32_t>& readers, SendMode mode);
  void charge(Message& message, std::uint32_t d, SendMode mode);
  void piggyback(Message& message, std::uint32_t writer, SendMode mode);
  void flush(Message& message, SendMode mode);

  // reader.cpp
  void data_received(const Packet& packet);
  void heartbeat_received(std::uint32_t relation, std::uint32_t announced);
  void acknack_generation(std::uint32_t relation) override;
  void emit_acknack(std::uint32_t relation, bool initial) override;
  void ask(Packet& acknack);
  void take(std::uint32_t relation, const DescriptorSet& descriptors, std::uint32_t fresh);

  // Discovered, for the control traffic
  [[nodiscard]] bool is_created(std::uint32_t i, Stream s, std::uint32_t d) const override {
    return d < writers_[2 * i + index_of(s)].created;
  }
  [[nodiscard]] bool is_notified(std::uint32_t pair, Stream s, std::uint32_t d) const override {
    return d < relations_[2 * pair + index_of(s)].notified;
  }

  /// Sends a unicast packet by the channel, or by loopback if both ends are on one host.
  void send(Packet&& packet);
  using SingleShots = Driver<fsm::SingleShot>;
  /// Asks a single-shot timer; schedules `kind` for `subject` if it was idle.
  void request(SingleShots& driver, fsm::StateId& timer, Nanoseconds delay, EventKind kind,
               std::uint32_t subject);
  /// A single-shot timer is due: it is idle again. Returns whether what was asked for happens now.
  bool expire(SingleShots& driver, fsm::StateId& timer, std::uint32_t subject);

  [[nodiscard]] ReaderSide& reader_side(std::uint32_t relation) override {
    return relations_[relation];
  }
  [[nodiscard]] bool crosses(std::uint32_t relation) const { return ends(relation).cross_host; }

  ChangeStates changes_;
  ControlTraffic control_;
  std::vector<Participant> participants_;
  std::vector<Writer> writers_;  // 2 · participant + stream
  std::vector<Relation> relations_;
  std::vector<bool> known_;  // by pair (i, j): i has recognised j
  Message sync_message_;
  Message async_message_;
  std::vector<std::uint32_t> targets_;

  SingleShots participant_shots_{run_, MachineRef::Kind::participant};
  SingleShots writer_shots_{run_, MachineRef::Kind::writer};
  SingleShots relation_shots_{run_, MachineRef::Kind::relation};
};

}  // namespace stormproof::model::fastdds
