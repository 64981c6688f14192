// The host of the amended rules (fsm/composition/amended.hpp): the paper's, with what these rules
// remember, and the life of participants (model/engine/living_host.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fsm/composition/amended.hpp"
#include "model/engine/living_host.hpp"
#include "model/paper/protocol.hpp"

namespace stormproof::model::paper {

namespace amended = fsm::composition::amended;

namespace detail {
using Cancellable = fsm::TypeList<comp::Announcement, comp::AckNackGeneration, comp::InitialAttempt,
                                  comp::paper::RepairGeneration, comp::paper::SuppressionEnd>;
}  // namespace detail

using LivingPaper = LivingHost<ProtocolOf<amended::C>, amended::Amended, detail::Cancellable>;

struct AmendedColumns : LivingPaper::OwnColumns {
  using LivingPaper::OwnColumns::column;
  static way::Prefix column(amended::Exists);
  static way::Prefix column(amended::Known);
  /// Its events are of the kind of those that answer a HEARTBEAT, whose detail is 0.
  static way::TokensFrom<1> column(amended::ReaderRetryDue);
};

class AmendedProtocol final
    : public Stored<AmendedProtocol, LivingPaper, ThingsBeside<amended::Amended, LivingPaper>,
                    AmendedColumns, fsm::TypeList<amended::Exists>> {
 public:
  AmendedProtocol(RunState& run, Network& network);

  void start() override;
  void handle(const Event& event) override;
  void source_completed(const Packet& packet) override;
  void received(const Packet& packet, std::uint32_t receiver) override;
  void renew_bitmap(Packet& acknack) override;

  // The host of a RunningWorld.
  using LivingHost::renew;
  using ProtocolOf::emit;
  using ProtocolOf::perform;
  using ProtocolOf::said;
  using Stored::assign_each;
  using Stored::is_due;
  using Stored::word;

  void changed(amended::Exists, std::uint32_t w, std::uint32_t d, bool) {
    writers_[w].announced = d + 1;
  }
  /// HEARTBEATs of a writer that writes nothing later announce all, one that rides in DATA nothing.
  [[nodiscard]] std::uint64_t word(comp::Announces, const Packet& packet, std::uint32_t k) const {
    if (packet.kind != PacketKind::heartbeat) return 0;
    return bits_below(std::max(packet.detail, at_start_[writer_of(packet.relation())]), k);
  }
  [[nodiscard]] std::uint64_t word(comp::BelowBase, const Packet& acknack, std::uint32_t k) const {
    return bits_below(std::min(acknack.descriptors.lowest(), acknack.repair_data), k);
  }
  // In fields that only DATA has a use for.
  [[nodiscard]] std::uint64_t word(amended::Covers, const Packet& acknack, std::uint32_t k) const {
    return bits_below(acknack.repair_data, k);
  }
  [[nodiscard]] std::int64_t said(amended::HeartbeatNumber, const Packet& heartbeat) const {
    return heartbeat.initial_data;
  }
  [[nodiscard]] std::int64_t said(amended::Answered, const Packet& acknack) const {
    return acknack.initial_data;
  }

  /// Not a retry.
  [[nodiscard]] bool is_due(comp::AckNackGeneration generation, const Event& event) {
    return event.detail == 0 && Stored::is_due(generation, event);
  }
  void assign_each(comp::X, std::uint32_t relation, const DescriptorSet& received) {
    if (received.empty()) {
      lose(planes(), relation, is_required(relation));
    } else {
      take(planes(), relation, received, is_required(relation));
    }
  }
  void renew(amended::C, std::uint32_t relation);
  template <class World>
  void perform(amended::Life::LoseAll, World& w) {
    lose_all(w.template number<comp::owner::participant>());
  }

  template <class World, class Sayings>
  void emit(amended::Heartbeat, World& w, const Sayings& sayings) {
    send_heartbeat(w.template number<comp::owner::relation>(),
                   static_cast<std::uint32_t>(said_of<amended::HeartbeatNumber>(sayings)));
  }
  template <class World, class Sayings>
  void emit(amended::AckNack, World& w, const Sayings& sayings) {
    const auto relation = w.template number<comp::owner::relation>();
    send_acknack(relation, w.set_of(said_of<comp::Listed>(sayings)),
                 said_of<comp::IsInitial>(sayings), first<amended::Known>(relation),
                 static_cast<std::uint32_t>(said_of<amended::Answered>(sayings)));
  }
  template <class World>
  void perform(amended::Clock::SendBatch, World& w) {
    send_next_batch<amended::Implementation>(w);
  }

 private:
  /// What a participant counts for its piggyback HEARTBEATs with `linear_group`.
  struct Account {
    std::int64_t bytes = 0;       ///< of DATA since the last overflow
    std::uint32_t overflows = 0;  ///< of a writer: those that it has answered
  };

  bool uses_up_budget(std::uint32_t writer, std::int64_t added_bytes) override;
  /// Before the run: the writers of i believe that j has everything, and i has j's descriptors.
  void open_before(std::uint32_t i, std::uint32_t j);
  /// It creates the endpoints, or deletes them.
  void write(const LateEndpoints& endpoints);
  /// The participant is a new one.
  void lose_all(std::uint32_t participant);

  const Amendments& amendments_;
  std::vector<std::uint32_t> at_start_;  // by writer: samples of before the run
  std::vector<Account> accounts_;        // by participant
  std::vector<std::uint32_t> answered_;  // by writer
};

}  // namespace stormproof::model::paper
