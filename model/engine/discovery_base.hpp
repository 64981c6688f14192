// What all implementations keep for the rules that they share (fsm/composition/reader.hpp,
// heartbeat_clock.hpp, announcements.hpp): the schedule of announcements, the reader side of every
// relation, and the HEARTBEAT clock of every writer with the cycle of the adaptive policy. It is
// the part of a host (model/engine/running_world.hpp) that is alike everywhere; how packets are
// filled and what a writer keeps of its readers is the implementation's own business.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "fsm/composition/announcements.hpp"
#include "fsm/composition/heartbeat_clock.hpp"
#include "fsm/composition/reader.hpp"
#include "model/engine/composition_knobs.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/effect_mutator.hpp"
#include "model/engine/implementation.hpp"
#include "model/engine/network.hpp"
#include "model/engine/relation_bits.hpp"
#include "model/engine/running_world.hpp"

namespace stormproof::model {

/// A timer of the adaptive policy: what a later event of the cycle replaces is cancelled.
template <class Timer>
concept IsCycleTimer = std::is_same_v<Timer, comp::CycleStart> ||
    std::is_same_v<Timer, comp::CycleEnd> || std::is_same_v<Timer, comp::BatchDue>;

class DiscoveryBase : public Implementation {
 public:
  using Packet = model::Packet;

  DiscoveryBase(RunState& run, Network& network);

  [[nodiscard]] comp::Watcher* watcher() { return watched_ ? &mutator_ : nullptr; }
  [[nodiscard]] const Topology& topology() const { return run_.topology; }
  [[nodiscard]] std::int64_t now() const { return run_.now.count(); }
  template <class Knob>
  [[nodiscard]] auto knob(Knob knob) const {
    return knob_value(knob, run_.scenario.dds);
  }

  // What only the host knows.
  template <class World>
  [[nodiscard]] std::int64_t answer(comp::Now, const World&) const {
    return now();
  }
  template <class World>
  [[nodiscard]] bool answer(comp::RunEnds, const World&) const {
    return run_.ends_now();
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(comp::ContactedCount, const World& w) const {
    return clocks_[w.template number<comp::owner::writer>()].contacted;
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(comp::RespondedCount, const World& w) const {
    return clocks_[w.template number<comp::owner::writer>()].responded;
  }
  [[nodiscard]] bool said(comp::CarriesHeartbeat, const Packet& packet) const {
    return packet.carries_heartbeat;
  }
  [[nodiscard]] bool said(comp::IsInitial, const Packet& packet) const {
    return packet.initial_acknack;
  }
  [[nodiscard]] bool said(comp::IsRepair, const Packet& packet) const { return packet.from_repair; }
  [[nodiscard]] std::uint64_t word(comp::Carries, const Packet& packet, std::uint32_t k) const {
    return packet.descriptors.word(k);
  }
  [[nodiscard]] std::uint64_t word(comp::Listed, const Packet& packet, std::uint32_t k) const {
    return packet.descriptors.word(k);
  }

  // Machines.
  auto& driver(comp::AnnouncementTimer) { return announcer_driver_; }
  auto& driver(comp::Reader) { return reader_driver_; }
  auto& driver(comp::InitialTimer) { return initial_driver_; }
  auto& driver(comp::HeartbeatClock) { return clock_driver_; }
  auto& state(comp::AnnouncementTimer, std::uint32_t i) { return announcers_[i].state; }
  auto& state(comp::Reader, std::uint32_t relation) { return readers_[relation].state; }
  auto& state(comp::InitialTimer, std::uint32_t relation) { return readers_[relation].initial; }
  auto& state(comp::HeartbeatClock, std::uint32_t w) { return clocks_[w].state; }

  // Flags and numbers.
  [[nodiscard]] std::int64_t value(comp::AnnouncementsSent, std::uint32_t i) const {
    return announcers_[i].sent;
  }
  void assign(comp::AnnouncementsSent, std::uint32_t i, std::int64_t sent) {
    announcers_[i].sent = static_cast<std::uint32_t>(sent);
  }
  [[nodiscard]] bool value(comp::HeartbeatSeen, std::uint32_t relation) const {
    return readers_[relation].heartbeat_seen;
  }
  void assign(comp::HeartbeatSeen, std::uint32_t relation, bool seen) {
    readers_[relation].heartbeat_seen = seen;
  }
  [[nodiscard]] std::int64_t value(comp::LastDelay, std::uint32_t relation) const {
    return readers_[relation].last_delay;
  }
  void assign(comp::LastDelay, std::uint32_t relation, std::int64_t delay) {
    lengthen(readers_[relation].last_delay, delay);
  }
  [[nodiscard]] std::int64_t value(comp::CycleBegan, std::uint32_t w) const {
    return clocks_[w].began;
  }
  void assign(comp::CycleBegan, std::uint32_t w, std::int64_t time) { clocks_[w].began = time; }
  [[nodiscard]] std::int64_t value(comp::CyclePeriod, std::uint32_t w) const {
    return clocks_[w].period;
  }
  void assign(comp::CyclePeriod, std::uint32_t w, std::int64_t period) {
    clocks_[w].period = period;
  }
  [[nodiscard]] bool value(comp::Contacted, std::uint32_t relation) const {
    return asked_[relation].contacted;
  }
  void assign(comp::Contacted, std::uint32_t relation, bool contacted);
  [[nodiscard]] bool value(comp::Responded, std::uint32_t relation) const {
    return asked_[relation].responded;
  }
  void assign(comp::Responded, std::uint32_t relation, bool responded);
  [[nodiscard]] std::uint64_t word(comp::AnnouncedAtStart, std::uint32_t w, std::uint32_t k) const {
    return bits_below(clocks_[w].announced, k);
  }
  void assign_each(comp::AnnouncedAtStart, std::uint32_t w, const DescriptorSet& announced) {
    clocks_[w].announced = announced.empty() ? 0 : announced.highest() + 1;
  }

  // Timers.
  template <class Timer>
  void schedule(Timer, std::uint32_t owner, std::int64_t time) {
    run_.schedule(Nanoseconds{time}, event_kind_of<Timer>, owner);
  }
  void schedule(comp::HeartbeatExpiry, std::uint32_t w, std::int64_t time) {
    ++clocks_[w].expiries;
    run_.schedule(Nanoseconds{time}, EventKind::heartbeat_expiry, w);
  }
  template <IsCycleTimer Timer>
  void schedule(Timer, std::uint32_t w, std::int64_t time) {
    run_.schedule(Nanoseconds{time}, event_kind_of<Timer>, w, token(Timer{}, w));
  }
  template <IsCycleTimer Timer>
  void cancel(Timer, std::uint32_t w) {
    ++token(Timer{}, w);
  }
  [[nodiscard]] std::int64_t pending(comp::HeartbeatExpiry, std::uint32_t w) const {
    return clocks_[w].expiries;
  }
  /// Whether what is due has not been cancelled. It is not pending any more.
  template <class Timer>
  [[nodiscard]] bool is_due(Timer, const Event&) {
    return true;
  }
  [[nodiscard]] bool is_due(comp::HeartbeatExpiry, const Event& event) {
    std::uint32_t& expiries = clocks_[event.subject].expiries;
    if (expiries > 0) --expiries;  // 0: the event was scheduled twice
    return true;
  }
  template <IsCycleTimer Timer>
  [[nodiscard]] bool is_due(Timer, const Event& event) {
    return event.detail == token(Timer{}, event.subject);
  }

  /// How many descriptors the reader lacks.
  template <class World>
  [[nodiscard]] std::uint32_t fact(comp::Missing, const World& w) const {
    return readers_[w.template number<comp::owner::relation>()].missing;
  }
  [[nodiscard]] std::vector<std::uint32_t> readers_by_number(std::uint32_t w) const {
    return open_relations(w);
  }

  // Packets and opaque steps.
  template <class World, class Sayings>
  void emit(comp::SpdpMulticast, World& w, const Sayings&) {
    send_spdp_multicast(w.template number<comp::owner::participant>());
  }
  template <class World, class Sayings>
  void emit(comp::SpdpUnicast, World& w, const Sayings&) {
    send_spdp_copy(w.template number<comp::owner::pair>());
  }
  template <class World>
  void perform(comp::CopyToKnown, World& w) {
    send_spdp_to_known(w.template number<comp::owner::participant>());
  }
  template <class World>
  void perform(comp::RefillBudget, World& w) {
    refill(w.template number<comp::owner::writer>());
  }
  /// The silent readers of the cycle are asked again, in batches spread over the rest of the
  /// stretched period.
  template <class World>
  void perform(comp::PlanBatches, World& w, std::int64_t stretched) {
    plan_batches(w.template number<comp::owner::writer>(), stretched);
  }

 protected:
  /// A HEARTBEAT to those readers of the next batch that still wait.
  template <class Rules, class World>
  void send_next_batch(World& w) {
    for (const std::uint32_t relation : next_batch(w.template number<comp::owner::writer>())) {
      RunningWorld<typename World::Host, comp::owner::relation> r{w.host(), relation};
      if (r(typename Rules::Waits{})) Rules::heartbeat(r);
    }
  }
  /// The readers whose turn it is in the next batch of the cycle.
  [[nodiscard]] std::vector<std::uint32_t> next_batch(std::uint32_t writer);
  /// The open relations of the writer, by number.
  [[nodiscard]] virtual std::vector<std::uint32_t> open_relations(std::uint32_t writer) const = 0;

  /// Only events that are scheduled twice get a delay near the end of the clock.
  static void lengthen(std::int64_t& last_delay, std::int64_t delay) {
    constexpr std::int64_t longest = std::int64_t{1} << 60;
    if (last_delay < longest) last_delay = delay;
  }
  /// Announcement 0 of participant i.
  void start_announcing(std::uint32_t i) {
    run_.schedule(run_.topology.start(i), EventKind::announcement_due, i);
  }
  /// Counts the copies in a DATA that arrives.
  template <class Machine>
  void count_copies(const RelationBits<Machine>& bits, const Packet& data) {
    const std::uint32_t relation = data.relation();
    if (!ends(relation).cross_host) return;
    run_.duplicate_deliveries +=
        data.descriptors.count() - bits.count_missing(relation, data.descriptors);
  }
  /// The reader has these now, and perhaps they complete the run, which asks for those that are
  /// `required`.
  template <class Machine>
  void take(RelationBits<Machine>& bits, std::uint32_t relation, const DescriptorSet& received,
            bool required) {
    std::uint32_t& missing = readers_[relation].missing;
    const std::uint32_t fresh =
        received.count() - (topology().descriptor_count(relation) - missing);
    if (required) {
      if (fresh > 0 && fresh == run_.missing) {
        note_last_delivery(relation, bits.missing(relation).lowest());
      }
      run_.missing -= fresh;
      run_.useful_deliveries += fresh;
    }
    bits.receive(relation, received);
    missing -= fresh;
  }

  /// The reader has lost all that it had.
  template <class Machine>
  void lose(RelationBits<Machine>& bits, std::uint32_t relation, bool required) {
    std::uint32_t& missing = readers_[relation].missing;
    const std::uint32_t all = topology().descriptor_count(relation);
    if (required) run_.missing += all - missing;
    bits.lose(relation);
    missing = all;
  }

  /// A unicast announcement to each participant that i knows.
  virtual void send_spdp_to_known(std::uint32_t i) = 0;
  virtual void send_spdp_multicast(std::uint32_t i) = 0;
  /// A unicast announcement from the pair's source to its destination.
  virtual void send_spdp_copy(std::uint32_t pair) = 0;
  /// The piggyback budget of the writer is full again.
  virtual void refill(std::uint32_t writer) = 0;

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

  struct ReaderSide {
    fsm::StateId state = fsm::Stepper<fsm::DiscoveryReader>::initial;
    fsm::StateId initial = fsm::Stepper<fsm::InitialAckNack>::initial;
    bool heartbeat_seen = false;
    std::uint32_t missing = 0;    ///< descriptors with X = 0
    std::int64_t last_delay = 0;  ///< of the initial ACKNACK, ns
  };
  std::vector<ReaderSide> readers_;  // by relation

  struct Announcer {
    fsm::StateId state = fsm::Stepper<fsm::Announcer>::initial;
    std::uint32_t sent = 0;
  };
  struct Clock {
    fsm::StateId state = fsm::Stepper<fsm::HeartbeatTimer>::initial;
    std::uint32_t expiries = 0;  ///< scheduled (periodic policy)
    // The cycle of the adaptive policy.
    std::int64_t began = 0;
    std::int64_t period = 0;
    std::uint32_t announced = 0;  ///< descriptors announced when the cycle started
    std::uint32_t contacted = 0;
    std::uint32_t responded = 0;
    std::array<std::uint32_t, 3> tokens{};  ///< events with an older token are cancelled
    std::vector<std::vector<std::uint32_t>> batches;
    std::size_t next_batch = 0;
  };
  std::vector<Announcer> announcers_;
  std::vector<Clock> clocks_;  // by writer

 private:
  /// What the cycle of its writer knows of a reader.
  struct Asked {
    bool contacted = false;
    bool responded = false;
  };

  template <IsCycleTimer Timer>
  [[nodiscard]] std::uint32_t& token(Timer, std::uint32_t w) {
    constexpr std::size_t k = std::is_same_v<Timer, comp::CycleStart> ? 0
                              : std::is_same_v<Timer, comp::CycleEnd> ? 1
                                                                      : 2;
    return clocks_[w].tokens[k];
  }
  void plan_batches(std::uint32_t writer, std::int64_t stretched);
  void note_last_delivery(std::uint32_t relation, std::uint32_t descriptor);

  EffectMutator mutator_{run_.mutation, run_.probe};
  const bool watched_ = mutator_.is_needed();
  std::vector<Asked> asked_;  // by relation
  Driver<fsm::Announcer> announcer_driver_{run_, MachineRef::Kind::participant};
  Driver<fsm::DiscoveryReader> reader_driver_{run_, MachineRef::Kind::relation};
  Driver<fsm::InitialAckNack> initial_driver_{run_, MachineRef::Kind::relation};
  Driver<fsm::HeartbeatTimer> clock_driver_{run_, MachineRef::Kind::writer};
};

}  // namespace stormproof::model
