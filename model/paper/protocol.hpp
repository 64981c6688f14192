// The paper's DDS implementation as a host of its rules (fsm/composition/paper.hpp): it keeps what
// they are about, and does the steps that they leave to a host. `ProtocolBase` is what it shares
// with the host of the amended rules (model/paper/amended_protocol.hpp); it is spread over three
// source files:
//   protocol.cpp       state, packets to rules
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

/// The writer's view of a descriptor, and X beside it, are those of `ProtocolOf`.
using Things = Without<ThingsBeside<rules::Paper, DiscoveryBase>, fsm::TypeList<rules::C, comp::X>>;

class ProtocolBase : public Stored<ProtocolBase, DiscoveryBase, Things, PlainColumns,
                                   fsm::TypeList<comp::Recognised, rules::WriterOpen>> {
 public:
  ProtocolBase(RunState& run, Network& network);

  void start() override;
  [[nodiscard]] bool receives_separately() const override { return false; }
  [[nodiscard]] std::vector<std::uint32_t> receivers(const Packet&) const override { return {}; }
  [[nodiscard]] std::uint32_t next_recipient(const Packet& packet,
                                             std::uint32_t pair) const override;

  // The host of a RunningWorld.
  using DiscoveryBase::emit;
  using DiscoveryBase::fact;
  using DiscoveryBase::perform;
  using Stored::word;
  // Who is known and open, in which order.
  void changed(comp::Recognised, std::uint32_t pair, bool recognised);
  void changed(rules::WriterOpen, std::uint32_t relation, bool open);

  [[nodiscard]] std::uint64_t word(comp::BelowBase, const Packet& packet, std::uint32_t k) const {
    return bits_below(packet.descriptors.lowest(), k);
  }

  [[nodiscard]] std::vector<std::uint32_t> readers(std::uint32_t w) const {
    return open_relations(w);
  }

  template <class World>
  void perform(rules::Generate, World& w, const DescriptorSet& descriptors, bool repair) {
    generate_data(w.template number<comp::owner::relation>(), descriptors, repair);
  }

 protected:
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
    std::uint32_t announced = 0;  ///< by its HEARTBEATs, if it has written something in the run
    std::vector<std::uint64_t> waiting_readers;  ///< bit per peer: open and something not in A
  };

  struct Participant {
    std::uint32_t known = 0;  ///< cross-host participants it has recognised
    std::uint32_t first_known_pair = UINT32_MAX;
    std::int64_t sent_bytes = 0;  ///< the cumulative charge of the piggyback rule
  };

  // protocol.cpp
  /// The number of the relation's reader among the peers of its writer.
  [[nodiscard]] std::uint32_t peer_of(std::uint32_t relation) const {
    return relation / 2 - topology().first_pair(writer_of(relation) / 2);
  }
  void note_waiting(std::uint32_t relation);
  /// These descriptors, bits of a word, are acknowledged now, or not any more.
  void note_acknowledged(std::uint32_t relation, bool acknowledged, std::uint64_t members);
  [[nodiscard]] bool is_waiting(std::uint32_t relation) const {
    return relations_[relation].open_rank != no_rank && relations_[relation].unacknowledged > 0;
  }
  [[nodiscard]] std::vector<std::uint32_t> open_relations(std::uint32_t writer) const override;
  [[nodiscard]] std::vector<std::uint32_t> waiting(std::uint32_t writer) const;
  [[nodiscard]] bool has_started(std::uint32_t participant) const;
  /// `known`: of how many descriptors the reader knows.
  void send_acknack(std::uint32_t relation, DescriptorSet&& bitmap, bool initial,
                    std::uint32_t known, std::uint32_t answered = 0);

  // announcements.cpp
  void send_spdp_to_known(std::uint32_t i) override;
  void send_spdp_multicast(std::uint32_t i) override;
  void send_spdp_copy(std::uint32_t pair) override;

  // data.cpp
  /// Whether that happens for the first time.
  virtual bool mark_generated(std::uint32_t relation, std::uint32_t d) = 0;
  /// Charges the writer; whether that calls for HEARTBEATs.
  virtual bool uses_up_budget(std::uint32_t writer, std::int64_t added_bytes);
  void generate_data(std::uint32_t relation, const DescriptorSet& descriptors, bool repair);
  void refill(std::uint32_t writer) override;
  void send_heartbeat(std::uint32_t relation, std::uint32_t number = 0);
  void send_heartbeat_to(std::uint32_t relation);
  void send_heartbeat_to_open(std::uint32_t writer);
  void send_periodic(std::uint32_t writer);
  struct Message;
  void flush(Message& message);
  void charge(Message& message, std::int64_t added_bytes);

  /// Whether participants may be forgotten. Ranks then say nothing, and no record stands for
  /// several copies.
  bool forgets_ = false;
  std::vector<Participant> participants_;
  std::vector<Writer> writers_;  // 2 · participant + stream
  std::vector<Relation> relations_;
  std::vector<std::uint32_t> known_rank_;  // by pair (i, j): when i recognised j
  // All participants have one profile.
  const SpdpProfile& spdp_;
  const SedpProfile& sedp_;
  const DescriptorSizes sizes_;
};

/// `C_` is the part that is the writer's view of a descriptor.
template <class C_>
class ProtocolOf : public Stored<ProtocolOf<C_>, ProtocolBase, fsm::TypeList<C_, comp::X>> {
  using Below = Stored<ProtocolOf<C_>, ProtocolBase, fsm::TypeList<C_, comp::X>>;

 public:
  using Below::Below;

  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override {
    return this->planes().list_missing(limit);
  }

  // The host of a RunningWorld.
  /// Of an ACKNACK: what is listed, then what is confirmed only without a prefix, then the prefix.
  static constexpr auto lane_order(C_) { return std::array{true, false, false}; }
  void moved(C_, std::uint32_t relation, fsm::StateId before, fsm::StateId after,
             std::uint64_t members) {
    constexpr fsm::StateId acknowledged =
        fsm::Reflect<typename C_::Machine>::template id<fsm::descriptor_repair::A>;
    if ((before == acknowledged) == (after == acknowledged)) return;
    this->note_acknowledged(relation, after == acknowledged, members);
  }

 protected:
  bool mark_generated(std::uint32_t relation, std::uint32_t d) override {
    return this->planes().mark_generated(relation, d);
  }
  /// The way of a packet to the rule of `host` for it; `hears(i, j)`: whether j takes what i sends.
  template <class Host, class Hears>
  static void take_in(Host& host, const Packet& packet, Hears&& hears) {
    using Rules = typename Host::Composition;
    const Topology& topology = host.topology();
    if (packet.multicast()) {
      // `pair` of a multicast packet is its source; every started cross-host participant processes
      // it.
      const std::uint32_t end = topology.first_pair(packet.pair + 1);
      for (std::uint32_t pair = topology.first_pair(packet.pair); pair < end; ++pair) {
        if (!hears(packet.pair, topology.pair(pair).destination)) continue;
        run_rule<comp::Received<comp::SpdpMulticast>>(host, pair);
      }
      return;
    }
    const Pair& pair = topology.pair(packet.pair);
    const bool back = packet.to_writer();
    if (!hears(back ? pair.destination : pair.source, back ? pair.source : pair.destination)) {
      return;
    }
    const std::uint32_t relation = packet.relation();
    switch (packet.kind) {
      case PacketKind::spdp_unicast:
        run_rule<comp::Received<comp::SpdpUnicast>>(host, packet.pair);
        break;
      case PacketKind::data:
        host.count_copies(host.bits(C_{}), packet);
        run_rule<comp::Received<typename Rules::Data>>(host, relation, &packet);
        break;
      case PacketKind::heartbeat:
        run_rule<comp::Received<typename Rules::Heartbeat>>(host, relation, &packet);
        break;
      case PacketKind::acknack:
        run_rule<comp::Received<typename Rules::AckNack>>(host, relation, &packet);
        break;
      default:
        break;
    }
  }
};

class Protocol final : public ProtocolOf<rules::C> {
 public:
  using Composition = rules::Paper;

  using ProtocolOf::ProtocolOf;

  void handle(const Event& event) override { run_due(*this, event); }
  void source_completed(const Packet& packet) override;
  void received(const Packet& packet, std::uint32_t receiver) override;
  void renew_bitmap(Packet& acknack) override;

  // The host of a RunningWorld.
  using ProtocolOf::emit;
  using ProtocolOf::fact;
  using ProtocolOf::perform;

  template <class World>
  [[nodiscard]] bool fact(rules::Waits, const World& w) const {
    return is_waiting(w.template number<comp::owner::relation>());
  }
  template <class World>
  [[nodiscard]] bool fact(rules::SomeReaderWaits, const World& w) const {
    return writers_[w.template number<comp::owner::writer>()].unacknowledged > 0;
  }
  template <class World, class Sayings>
  void emit(rules::Heartbeat, World& w, const Sayings&) {
    send_heartbeat(w.template number<comp::owner::relation>());
  }
  template <class World, class Sayings>
  void emit(rules::AckNack, World& w, const Sayings& sayings) {
    const auto relation = w.template number<comp::owner::relation>();
    send_acknack(relation, w.set_of(said_of<comp::Listed>(sayings)),
                 said_of<comp::IsInitial>(sayings), topology().descriptor_count(relation));
  }
  template <class World>
  void perform(rules::HeartbeatToRecipients, World& w) {
    send_periodic(w.template number<comp::owner::writer>());
  }
  template <class World>
  void perform(rules::Clock::SendBatch, World& w) {
    send_next_batch<rules::Implementation>(w);
  }
};

}  // namespace stormproof::model::paper
