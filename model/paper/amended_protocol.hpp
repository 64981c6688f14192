// The host of the amended rules (fsm/composition/amended.hpp): the paper's, with what these rules
// remember, and the life of participants: relations that were open before the run, participants
// that fall silent, are forgotten or come back, and outages.
#pragma once

#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "fsm/composition/amended.hpp"
#include "model/life.hpp"
#include "model/paper/protocol.hpp"

namespace stormproof::model {

/// A reader that asks by itself generates an ACKNACK.
template <>
inline constexpr EventKind event_kind_of<comp::amended::ReaderRetryDue> =
    EventKind::acknack_generation;
template <>
inline constexpr EventKind event_kind_of<comp::amended::CopyDue> = EventKind::reply_time;
template <>
inline constexpr EventKind event_kind_of<comp::amended::LeaseCheck> = EventKind::lease_check;
template <>
inline constexpr EventKind event_kind_of<comp::amended::Return> = EventKind::participant_start;

}  // namespace stormproof::model

namespace stormproof::model::paper {

namespace amended = fsm::composition::amended;

namespace detail {
/// What is remembered of a number, flag or timer, by owner.
template <class Of, class Value>
struct Remembered {
  std::vector<Value> of;
};
template <class List, class Value>
struct MemoryOf;
template <class... Each, class Value>
struct MemoryOf<fsm::TypeList<Each...>, Value> {
  using type = std::tuple<Remembered<Each, Value>...>;
};
/// The timers of a participant or a side that may be a new one.
using Cancellable =
    fsm::TypeList<comp::Announcement, comp::AckNackGeneration, comp::InitialAttempt,
                  comp::paper::RepairGeneration, comp::paper::SuppressionEnd, comp::HeartbeatExpiry,
                  comp::amended::CopyDue, comp::amended::LeaseCheck>;
template <class V, class List>
struct IsOneOf;
template <class V, class... Vs>
struct IsOneOf<V, fsm::TypeList<Vs...>> : std::disjunction<std::is_same<V, Vs>...> {};
}  // namespace detail
/// What the amended rules remember beside the paper's.
template <class V>
concept IsRemembered = detail::IsOneOf<V, amended::Amended::Memory>::value;
template <class Timer>
concept IsCancellable = detail::IsOneOf<Timer, detail::Cancellable>::value;

class AmendedProtocol final : public ProtocolOf<amended::C> {
 public:
  using Composition = amended::Amended;

  AmendedProtocol(RunState& run, Network& network);

  void start() override;
  void handle(const Event& event) override;
  void source_completed(const Packet& packet) override;
  void received(const Packet& packet, std::uint32_t receiver) override;
  void renew_bitmap(Packet& acknack) override;
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override;

  // The host of a RunningWorld.
  using ProtocolOf::answer;
  using ProtocolOf::assign;
  using ProtocolOf::assign_each;
  using ProtocolOf::cancel;
  using ProtocolOf::emit;
  using ProtocolOf::is_due;
  using ProtocolOf::perform;
  using ProtocolOf::said;
  using ProtocolOf::schedule;
  using ProtocolOf::value;
  using ProtocolOf::word;

  template <IsRemembered V>
  [[nodiscard]] std::int64_t value(V, std::uint32_t owner) const {
    return std::get<detail::Remembered<V, std::int64_t>>(memory_).of[owner];
  }
  template <IsRemembered V>
  void assign(V, std::uint32_t owner, std::int64_t to) {
    std::get<detail::Remembered<V, std::int64_t>>(memory_).of[owner] = to;
  }
  [[nodiscard]] std::uint64_t word(amended::Resent, std::uint32_t relation, std::uint32_t k) const {
    return resent_[relation].word(k);
  }
  void assign_each(amended::Resent, std::uint32_t relation, DescriptorSet&& resent) {
    resent_[relation] = std::move(resent);
  }
  // In a field that only DATA has a use for.
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

  template <class Timer>
  void cancel(Timer timer, std::uint32_t owner) {
    if constexpr (IsCancellable<Timer>) {
      cancelled<Timer>()[owner] = run_.queue.next_insertion();
    } else {
      ProtocolOf::cancel(timer, owner);
    }
  }
  void cancel(comp::HeartbeatExpiry, std::uint32_t w) {
    cancelled<comp::HeartbeatExpiry>()[w] = run_.queue.next_insertion();
    clocks_[w].expiries = 0;
  }
  template <class Timer>
  [[nodiscard]] bool is_due(Timer timer, const Event& event) {
    if constexpr (IsCancellable<Timer>) {
      return event.insertion() >= cancelled<Timer>()[event.subject];
    } else {
      return ProtocolOf::is_due(timer, event);
    }
  }
  [[nodiscard]] bool is_due(comp::AckNackGeneration, const Event& event) {
    return event.detail == 0 &&
           event.insertion() >= cancelled<comp::AckNackGeneration>()[event.subject];
  }
  [[nodiscard]] bool is_due(comp::HeartbeatExpiry expiry, const Event& event) {
    return event.insertion() >= cancelled<comp::HeartbeatExpiry>()[event.subject] &&
           ProtocolOf::is_due(expiry, event);
  }

  void assign_each(comp::X, std::uint32_t relation, const DescriptorSet& received) {
    if (received.empty()) {
      lose(descriptors_, relation, is_required(relation));
    } else {
      take(descriptors_, relation, received, is_required(relation));
    }
  }
  void renew(comp::AnnouncementTimer, std::uint32_t i) { announcers_[i] = {}; }
  void renew(comp::HeartbeatClock, std::uint32_t w);
  void renew(comp::Reader, std::uint32_t relation);
  void renew(comp::InitialTimer, std::uint32_t relation) {
    readers_[relation].initial = fsm::Stepper<fsm::InitialAckNack>::initial;
  }
  void renew(amended::C, std::uint32_t relation);
  template <class World>
  [[nodiscard]] std::int64_t answer(amended::LeaseDuration, const World& w) const {
    return leases_[topology().pair(w.template number<comp::owner::pair>()).source];
  }
  template <class World>
  void perform(amended::LoseAll, World& w) {
    lose_all(w.template number<comp::owner::participant>());
  }

  template <class World, class Sayings>
  void emit(amended::Heartbeat, World& w, const Sayings& sayings) {
    send_heartbeat(w.template number<comp::owner::relation>(),
                   static_cast<std::uint32_t>(said_of<amended::HeartbeatNumber>(sayings)));
  }
  template <class World, class Sayings>
  void emit(amended::AckNack, World& w, const Sayings& sayings) {
    send_acknack(w.template number<comp::owner::relation>(),
                 w.set_of(said_of<comp::Listed>(sayings)), said_of<comp::IsInitial>(sayings),
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
  /// The participant is a new one.
  void lose_all(std::uint32_t participant);
  /// Whether discovery is complete only if the reader has everything.
  [[nodiscard]] bool is_required(std::uint32_t relation) const {
    const Pair& pair = ends(relation);
    return pair.cross_host && !is_replaced(life_, pair.source) &&
           !is_replaced(life_, pair.destination);
  }
  /// By owner: events of the timer that were scheduled before this one are cancelled.
  template <class Timer>
  [[nodiscard]] std::vector<std::uint64_t>& cancelled() {
    return std::get<detail::Remembered<Timer, std::uint64_t>>(cancelled_).of;
  }
  /// Whether j takes now what i has emitted then.
  [[nodiscard]] bool hears(std::uint32_t i, std::uint32_t j, Nanoseconds emitted) const;
  [[nodiscard]] std::uint32_t actor_of(const Event& event) const;

  const Amendments& amendments_;
  const Life life_;
  detail::MemoryOf<Composition::Memory, std::int64_t>::type memory_;
  detail::MemoryOf<detail::Cancellable, std::uint64_t>::type cancelled_;
  std::vector<std::int64_t> leases_;     // by participant; 0: never forgotten
  std::vector<DescriptorSet> resent_;    // by relation
  std::vector<std::uint32_t> retries_;   // by relation
  std::vector<Account> accounts_;        // by participant
  std::vector<std::uint32_t> answered_;  // by writer
};

}  // namespace stormproof::model::paper
