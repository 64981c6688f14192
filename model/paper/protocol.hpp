// The paper's DDS implementation as a host of its rules (fsm/composition/paper.hpp): it keeps what
// they are about, and does the steps that they leave to a host. The class is spread over three
// source files:
//   protocol.cpp       state, events and packets to rules, the list of what is missing
//   announcements.cpp  SPDP: what an announcement is on the wire
//   data.cpp           generation of DATA and HEARTBEATs, grouping, piggyback
// What Fast DDS does alike is in model/engine/discovery_base.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "fsm/composition/paper.hpp"
#include "model/descriptor_sizes.hpp"
#include "model/engine/discovery_base.hpp"
#include "model/engine/relation_bits.hpp"
#include "model/engine/running_world.hpp"

namespace stormproof::model::paper {

namespace rules = fsm::composition::paper;

/// A rank that no recipient has: the relation is not open, the participant is not known.
inline constexpr std::uint32_t no_rank = UINT32_MAX;

class Protocol final : public DiscoveryBase {
 public:
  using Composition = rules::Paper;

  Protocol(RunState& run, Network& network);

  void start() override;
  void handle(const Event& event) override { run_due(*this, event); }
  void source_completed(const Packet& packet) override;
  [[nodiscard]] bool receives_separately() const override { return false; }
  [[nodiscard]] std::vector<std::uint32_t> receivers(const Packet&) const override { return {}; }
  void received(const Packet& packet, std::uint32_t receiver) override;
  void renew_bitmap(Packet& acknack) override;
  [[nodiscard]] std::uint32_t next_recipient(const Packet& packet,
                                             std::uint32_t pair) const override;
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override;

  // The host of a RunningWorld.
  using DiscoveryBase::assign;
  using DiscoveryBase::assign_each;
  using DiscoveryBase::emit;
  using DiscoveryBase::fact;
  using DiscoveryBase::perform;
  using DiscoveryBase::value;
  using DiscoveryBase::word;

  auto& bits(rules::C) { return descriptors_; }
  /// Of an ACKNACK: what is listed, then what is confirmed only without a prefix, then the prefix.
  static constexpr auto lane_order(rules::C) { return std::array{true, false, false}; }
  void moved(rules::C, std::uint32_t relation, fsm::StateId before, fsm::StateId after,
             std::uint64_t members);

  [[nodiscard]] bool value(comp::Recognised, std::uint32_t pair) const {
    return known_rank_[topology().pair(pair).reverse] != no_rank;
  }
  void assign(comp::Recognised, std::uint32_t pair, bool);
  [[nodiscard]] bool value(rules::WriterOpen, std::uint32_t relation) const {
    return relations_[relation].open_rank != no_rank;
  }
  void assign(rules::WriterOpen, std::uint32_t relation, bool);
  [[nodiscard]] std::uint64_t word(comp::X, std::uint32_t relation, std::uint32_t k) const {
    return descriptors_.received(relation, k);
  }
  void assign_each(comp::X, std::uint32_t relation, const DescriptorSet& received) {
    take(descriptors_, relation, received);
  }
  [[nodiscard]] std::uint64_t word(comp::BelowBase, const Packet& packet, std::uint32_t k) const {
    return bits_below(packet.descriptors.lowest(), k);
  }
  template <class World>
  [[nodiscard]] bool fact(rules::Waits, const World& w) const {
    const Relation& r = relations_[w.template number<comp::owner::relation>()];
    return r.open_rank != no_rank && r.unacknowledged > 0;
  }
  template <class World>
  [[nodiscard]] bool fact(rules::SomeReaderWaits, const World& w) const {
    return writers_[w.template number<comp::owner::writer>()].unacknowledged > 0;
  }

  [[nodiscard]] std::vector<std::uint32_t> readers(std::uint32_t w) const {
    return open_relations(w);
  }

  template <class World, class Sayings>
  void emit(rules::Heartbeat, World& w, const Sayings&) {
    send_heartbeat(w.template number<comp::owner::relation>());
  }
  template <class World, class Sayings>
  void emit(rules::AckNack, World& w, const Sayings& sayings) {
    send_acknack(w.template number<comp::owner::relation>(),
                 w.set_of(said_of<comp::Listed>(sayings)), said_of<comp::IsInitial>(sayings));
  }

  template <class World>
  void perform(rules::HeartbeatToRecipients, World& w) {
    send_periodic(w.template number<comp::owner::writer>());
  }
  template <class World>
  void perform(rules::Generate, World& w, const DescriptorSet& descriptors, bool repair) {
    generate_data(w.template number<comp::owner::relation>(), descriptors, repair);
  }
  template <class World>
  void perform(rules::Clock::SendBatch, World& w) {
    send_next_batch<rules::Implementation>(w);
  }

 private:
  /// Its writer side.
  struct Relation {
    std::uint32_t unacknowledged = 0;   ///< descriptors not in A
    std::uint32_t open_rank = no_rank;  ///< how many relations of the writer opened before
  };

  struct Writer {
    std::int64_t budget = 0;           ///< piggyback budget, bytes
    std::uint32_t open = 0;            ///< open relations
    std::uint32_t unacknowledged = 0;  ///< open relations with a descriptor not in A
    std::uint32_t first_open_pair = UINT32_MAX;
    std::vector<std::uint64_t> waiting_readers;  ///< bit per peer: open and something not in A
  };

  struct Participant {
    std::uint32_t known = 0;  ///< cross-host participants it has recognised
    std::uint32_t first_known_pair = UINT32_MAX;
    std::int64_t sent_bytes = 0;  ///< the cumulative charge of the piggyback rule
  };

  // protocol.cpp
  void note_waiting(std::uint32_t relation);
  [[nodiscard]] std::vector<std::uint32_t> open_relations(std::uint32_t writer) const override;
  [[nodiscard]] std::vector<std::uint32_t> waiting(std::uint32_t writer) const;
  [[nodiscard]] bool has_started(std::uint32_t participant) const;
  void send_acknack(std::uint32_t relation, DescriptorSet&& bitmap, bool initial);

  // announcements.cpp
  void send_spdp_to_known(std::uint32_t i) override;
  void send_spdp_multicast(std::uint32_t i) override;
  void send_spdp_copy(std::uint32_t pair) override;

  // data.cpp
  void generate_data(std::uint32_t relation, const DescriptorSet& descriptors, bool repair);
  void refill(std::uint32_t writer) override;
  void send_heartbeat(std::uint32_t relation);
  void send_heartbeat_to(std::uint32_t relation);
  void send_heartbeat_to_open(std::uint32_t writer);
  void send_periodic(std::uint32_t writer);
  struct Message;
  void flush(Message& message);
  void charge(Message& message, std::int64_t added_bytes);

  RelationBits<fsm::DescriptorRepair> descriptors_;
  std::vector<Participant> participants_;
  std::vector<Writer> writers_;  // 2 · participant + stream
  std::vector<Relation> relations_;
  std::vector<std::uint32_t> known_rank_;  // by pair (i, j): when i recognised j
  const DescriptorSizes sizes_;
};

}  // namespace stormproof::model::paper
