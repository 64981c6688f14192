// The host of Cyclone DDS's rules in the explorer: the publications of participant 0 and their
// reader, participant 1, with the event threads of both. It differs from the other compositions'
// (rule_host.hpp), because the rules
//   compare times: those are marks of the frame, and a comparison that the zone leaves open makes
//     two steps (Frame::holds);
//   move timers: each time that a timer is moved to is an event, of which the first one that comes
//     is the due one, and the others are forgotten;
//   leave messages to a thread, which does all that it has to do at once: the time that sending
//     takes is part of the delay of a packet.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>

#include "checker/engines/explorer/claims.hpp"
#include "checker/engines/explorer/cyclone_fields.hpp"
#include "checker/engines/explorer/cyclone_state.hpp"
#include "model/cyclone/packer.hpp"
#include "model/engine/effect_mutator.hpp"
#include "model/engine/running_world.hpp"
#include "model/scenario.hpp"

namespace stormproof::explorer {

class CycloneHost {
  using Number = std::uint32_t;

 public:
  using Composition = comp::cyclone::Cyclone;
  using Packet = Slot;
  using State = CycloneState;

  CycloneHost(const model::Scenario& running, const Scope& scope, const EventRules& rules,
              const model::Mutation& mutation);
  CycloneHost(const CycloneHost&) = delete;
  CycloneHost& operator=(const CycloneHost&) = delete;

  /// What rules are about from now on.
  void go_on_with(State& state, Frame& frame) {
    state_ = &state;
    frame_ = &frame;
  }
  template <class Trigger>
  void run_rule(Number n, const Slot* packet = nullptr, Number descriptor = 0) {
    packet_ = packet;
    model::run_rule<Trigger>(*this, n, packet, descriptor);
  }
  /// A time of a timer, or of a thread.
  void come(const Slot& slot);
  /// Forgets what is over, and keeps counts small.
  void settle();

  // What a RunningWorld asks of its host.
  [[nodiscard]] comp::Watcher* watcher() { return mutator_.is_needed() ? &mutator_ : nullptr; }
  struct Ends {
    static model::Pair pair(Number number) { return {number, 1 - number, 1 - number, true}; }
  };
  [[nodiscard]] static Ends topology() { return {}; }
  [[nodiscard]] Number samples_of(Number) const { return samples_; }
  [[nodiscard]] static std::int64_t now() { return 0; }
  template <class Knob>
  [[nodiscard]] auto knob(Knob knob) const {
    return model::knob_value(knob, dds_);
  }
  static std::int64_t knob(comp::cyclone::SendTime) { return 0; }

  // What only the host knows. All that is queued goes to the one reader.
  template <class W>
  [[nodiscard]] static std::int64_t answer(comp::Now, const W&) {
    return 0;
  }
  template <class W>
  [[nodiscard]] static bool answer(comp::RunEnds, const W&) {
    return false;
  }
  template <class W>
  [[nodiscard]] bool answer(comp::cyclone::IsQueued, const W& w) const {
    return is_queued(w.descriptor());
  }
  template <class W>
  [[nodiscard]] bool answer(comp::cyclone::IsQueuedForIt, const W& w) const {
    return is_queued(w.descriptor());
  }
  template <class W>
  [[nodiscard]] bool answer(comp::cyclone::QueueIsFull, const W&) const {
    return queued_repairs() >= dds_.sedp.max_queued_rexmit_messages;
  }
  template <class W>
  [[nodiscard]] bool answer(comp::cyclone::AnswerIsKept, const W&) const {
    return state_->keeps != 0;
  }
  template <class W>
  [[nodiscard]] bool answer(comp::cyclone::SomeAnswerIsKept, const W& w) const {
    return w.template number<comp::owner::participant>() == 0 && state_->keeps != 0;
  }

  // Machines.
  template <class P>
  auto& driver(P) {
    return static_cast<detail::PartMachines<P>&>(machines_);
  }
  /// The writer takes an ACKNACK from its reader.
  struct Listener {
    CycloneHost& host;
    template <class Event, class Input>
    auto step(fsm::StateId& state, const Input& input, Number) {
      auto& machines = static_cast<detail::PartMachines<comp::cyclone::Peer>&>(host.machines_);
      const auto output = machines.template step<Event>(state, input);
      if (output.take) host.note_asked();
      return output;
    }
  };
  Listener driver(comp::cyclone::Peer) { return {*this}; }
  template <class P>
  [[nodiscard]] fsm::StateId& state(P, Number n) {
    expect_explored(n);
    return state_->state<P>();
  }
  [[nodiscard]] fsm::StateId& state(comp::cyclone::Thread, Number i) {
    return i == 0 ? state_->state<comp::cyclone::Thread>()
                  : state_->state<cyclone_parts::ReaderThread>();
  }

  // Flags and numbers.
  template <class V>
  [[nodiscard]] auto value(V, Number) const {
    return state_->get<V>();
  }
  template <class V, class Value>
  void assign(V, Number n, Value value) {
    expect_explored(n);
    state_->set<V>(value);
  }
  /// Intervals do not grow beyond some number of HEARTBEATs.
  void assign(comp::cyclone::HeartbeatsSince, Number, std::int64_t number) {
    state_->set<comp::cyclone::HeartbeatsSince>(std::min(number, most_heartbeats_));
  }
  template <class V>
  void assign(V, Number n, Number d, bool holds) {
    expect_explored(n);
    const Members others = state_->get<V>() & static_cast<Members>(~member(d));
    state_->set<V>(others | (holds ? member(d) : Members{0}));
  }
  template <class V>
  void assign_each(V, Number n, const model::DescriptorSet& set) {
    expect_explored(n);
    state_->set<V>(members_of(set));
  }
  template <class V>
  [[nodiscard]] std::uint64_t word(V, Number, Number) const {
    return state_->get<V>();
  }
  template <class Field>
  [[nodiscard]] static std::uint64_t word(Field, const Slot& packet, Number) {
    return members_said<Field>(packet);
  }
  template <class Field>
  [[nodiscard]] static bool said(Field field, const Slot& packet) {
    return packet.has(flag_of(field));
  }
  [[nodiscard]] static std::int64_t said(comp::cyclone::Count, const Slot& packet) {
    return packet.count;
  }

  // Times.
  template <Time V>
  [[nodiscard]] std::int64_t value(V, Number) {
    constexpr What what = mark_of<V>;
    return what == What::last_heartbeat ? last_heartbeat() : until(what);
  }
  template <Time V>
  void assign(V, Number n, std::int64_t to) {
    expect_explored(n);
    frame_->erase_marks(mark_of<V>, 0);
    frame_->mark({mark_of<V>}, to);
  }
  std::int64_t value(comp::cyclone::AckDue, Number) const {
    return due(What::ack_time, state_->get<cyclone_parts::AckTimeMissed>());
  }
  std::int64_t value(comp::cyclone::HeartbeatDue, Number) const {
    return due(What::heartbeat_time, state_->get<cyclone_parts::HeartbeatTimeMissed>());
  }
  void assign(comp::cyclone::AckDue, Number, std::int64_t) {
    state_->set<cyclone_parts::AckTimeMissed>(false);
  }
  void assign(comp::cyclone::HeartbeatDue, Number, std::int64_t) {
    state_->set<cyclone_parts::HeartbeatTimeMissed>(false);
  }
  template <class T>
  void schedule(T, Number n, std::int64_t time) {
    if constexpr (!std::is_same_v<T, comp::cyclone::ThreadRun>) expect_explored(n);
    schedule({*what_of<T>(), 0, 0, static_cast<std::uint8_t>(n)}, time);
  }

  // Messages.
  template <class P, class W, class... Sayings>
  void emit(P, W& w, const std::tuple<Sayings...>& sayings) {
    Slot message{what_of_packet<P>(), flags_};
    std::apply([&](const auto&... each) { (say(message, each, w), ...); }, sayings);
    expect_explored(w.template number<comp::owner::relation>());
    leave(message);
  }

  // Opaque steps.
  template <class Step, class W>
  requires std::same_as<Step, comp::cyclone::HeartbeatToAll> ||
      std::same_as<Step, comp::cyclone::DataToAll>
  void perform(Step, W& w) {
    flags_ = Slot::to_set;
    Step::contract(w);
    flags_ = 0;
  }
  template <class W>
  static void perform(comp::cyclone::SendToAllInstead, W&) {}  // nobody else is there
  template <class W>
  static void perform(comp::cyclone::OpenTopics, W&) {}
  template <class W>
  void perform(comp::cyclone::LetAnswerGo, W&) {
    let_answer_go();
  }
  template <class W>
  void perform(comp::cyclone::JoinList, W&, comp::cyclone::HeartbeatTimer) {
    ++state_->listed[0];
  }
  template <class W>
  void perform(comp::cyclone::JoinList, W&, comp::cyclone::AckTimer) {
    ++state_->listed[1];
  }
  template <class W>
  void perform(comp::cyclone::Work, W& w) {
    work(w.template number<comp::owner::participant>());
  }
  [[nodiscard]] std::span<const Number> readers(Number) const {
    static constexpr std::array<Number, 1> one{0};
    return {one.data(), state_->get<comp::cyclone::WriterOpen>() ? one.size() : 0};
  }

 private:
  template <class P>
  static constexpr What what_of_packet() {
    if constexpr (std::is_same_v<P, comp::cyclone::Data>) return What::data;
    return std::is_same_v<P, comp::cyclone::Heartbeat> ? What::heartbeat : What::acknack;
  }
  /// Only a mistake is about the reverse relation, or about the writer's or reader's of another
  /// one.
  void expect_explored(Number n) {
    if (n != 0) frame_->overflow();
  }
  [[nodiscard]] bool is_queued(Number d) const;
  [[nodiscard]] unsigned queued_repairs() const;
  [[nodiscard]] std::int64_t interval() const;
  std::int64_t until(What what);
  std::int64_t last_heartbeat();
  [[nodiscard]] std::int64_t due(What what, bool missed) const;
  void schedule(Slot slot, std::int64_t time);
  void note_asked();
  void leave(Slot message);
  void enqueue(const Slot& message);
  void let_answer_go();
  void work(Number i);
  bool next_task(Number i);
  void send(const model::cyclone::Bundle& bundle);
  template <class Made, class Last>
  void keep_counts_small(What what);

  const model::DdsProfile dds_;
  const unsigned samples_;
  const EventRules& rules_;
  detail::Machines<Composition::Parts> machines_;
  const model::Mutation mutation_;
  model::EffectMutator mutator_{&mutation_};
  const std::int64_t most_heartbeats_;
  State* state_ = nullptr;
  Frame* frame_ = nullptr;
  std::uint8_t flags_ = 0;        ///< of what a step to all emits
  const Slot* packet_ = nullptr;  ///< what is being processed
  std::optional<What> coming_;    ///< the timer whose time it is
  bool works_ = false;            ///< a thread does
  std::deque<Slot> given_;        ///< what the timer that it fires gives
};

}  // namespace stormproof::explorer
