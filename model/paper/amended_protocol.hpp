// The host of the amended rules (fsm/composition/amended.hpp): the paper's, with what these rules
// remember, and the life of participants (model/engine/living_host.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "fsm/composition/amended.hpp"
#include "model/engine/living_host.hpp"
#include "model/paper/protocol.hpp"

namespace stormproof::model {

/// A reader that asks by itself generates an ACKNACK.
template <>
inline constexpr EventKind event_kind_of<comp::amended::ReaderRetryDue> =
    EventKind::acknack_generation;
template <>
inline constexpr EventKind event_kind_of<comp::amended::CopyDue> = EventKind::reply_time;

}  // namespace stormproof::model

namespace stormproof::model::paper {

namespace amended = fsm::composition::amended;

namespace detail {
using Cancellable = fsm::TypeList<comp::Announcement, comp::AckNackGeneration, comp::InitialAttempt,
                                  comp::paper::RepairGeneration, comp::paper::SuppressionEnd,
                                  comp::amended::CopyDue, comp::LeaseCheck>;
}  // namespace detail

class AmendedProtocol final
    : public LivingHost<ProtocolOf<amended::C>, amended::Amended, detail::Cancellable> {
 public:
  AmendedProtocol(RunState& run, Network& network);

  void start() override;
  void handle(const Event& event) override;
  void source_completed(const Packet& packet) override;
  void received(const Packet& packet, std::uint32_t receiver) override;
  void renew_bitmap(Packet& acknack) override;

  // The host of a RunningWorld.
  using LivingHost::answer;
  using LivingHost::assign;
  using LivingHost::cancel;
  using LivingHost::is_due;
  using LivingHost::renew;
  using LivingHost::schedule;
  using LivingHost::value;
  using LivingHost::word;
  using ProtocolOf::assign_each;
  using ProtocolOf::emit;
  using ProtocolOf::perform;
  using ProtocolOf::said;

  [[nodiscard]] std::uint64_t word(amended::Resent, std::uint32_t relation, std::uint32_t k) const {
    return resent_[relation].word(k);
  }
  void assign_each(amended::Resent, std::uint32_t relation, DescriptorSet&& resent) {
    resent_[relation] = std::move(resent);
  }
  // Descriptors exist, and are known, in ascending order.
  [[nodiscard]] std::uint64_t word(amended::Exists, std::uint32_t w, std::uint32_t k) const {
    return bits_below(written_[w].now, k);
  }
  void assign(amended::Exists, std::uint32_t w, std::uint32_t d, bool) {
    written_[w].now = d + 1;
    writers_[w].announced = d + 1;
  }
  [[nodiscard]] std::uint64_t word(amended::WrittenLater, std::uint32_t w, std::uint32_t k) const {
    return bits_below(written_[w].now, k) & ~bits_below(written_[w].at_start, k);
  }
  void assign(amended::WrittenLater, std::uint32_t, std::uint32_t, bool) {}
  [[nodiscard]] std::uint64_t word(amended::Known, std::uint32_t relation, std::uint32_t k) const {
    return bits_below(known_[relation], k);
  }
  void assign_each(amended::Known, std::uint32_t relation, const DescriptorSet& known) {
    known_[relation] = known.empty() ? 0 : known.highest() + 1;
  }
  /// HEARTBEATs of a writer that writes nothing later announce all, one that rides in DATA nothing.
  [[nodiscard]] std::uint64_t word(comp::Announces, const Packet& packet, std::uint32_t k) const {
    if (packet.kind != PacketKind::heartbeat) return 0;
    const Samples& samples = written_[writer_of(packet.relation())];
    return bits_below(std::max(packet.detail, samples.at_start), k);
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

  // A retry has the number of those that were cancelled, from 1; 0 is an answer to a HEARTBEAT.
  void schedule(amended::ReaderRetryDue, std::uint32_t relation, std::int64_t time) {
    run_.schedule(Nanoseconds{time}, EventKind::acknack_generation, relation,
                  retries_[relation] + 1);
  }
  void cancel(amended::ReaderRetryDue, std::uint32_t relation) { ++retries_[relation]; }
  [[nodiscard]] bool is_due(amended::ReaderRetryDue, const Event& event) {
    return event.detail == retries_[event.subject] + 1;
  }

  [[nodiscard]] bool is_due(comp::AckNackGeneration generation, const Event& event) {
    return event.detail == 0 && LivingHost::is_due(generation, event);
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
                 said_of<comp::IsInitial>(sayings), known_[relation],
                 static_cast<std::uint32_t>(said_of<amended::Answered>(sayings)));
  }
  template <class World>
  void perform(amended::Clock::SendBatch, World& w) {
    send_next_batch<amended::Implementation>(w);
  }

 private:
  /// How many samples a writer has written.
  struct Samples {
    std::uint32_t at_start = 0;
    std::uint32_t now = 0;
  };
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
  [[nodiscard]] std::uint32_t actor_of(const Event& event) const;

  const Amendments& amendments_;
  std::vector<Samples> written_;         // by writer
  std::vector<std::uint32_t> known_;     // by relation: so many descriptors
  std::vector<DescriptorSet> resent_;    // by relation
  std::vector<std::uint32_t> retries_;   // by relation
  std::vector<Account> accounts_;        // by participant
  std::vector<std::uint32_t> answered_;  // by writer
};

}  // namespace stormproof::model::paper
