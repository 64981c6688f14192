// The host of rules (model/engine/running_world.hpp) in the explorer, whatever the composition: its
// state is a small one that can be copied, its clock a frame of pending events. What is scheduled
// becomes a slot of the frame, what is emitted a packet that may be late or lost. There is one
// participant, number 0, of which one stream or both are explored, with one or several readers:
// reader r is participant r + 1, its relation of stream s has number 2·r + s, and open relations
// stand in ascending order. In Fast DDS that is the order in which they have opened, which the
// world keeps. Where all of this is stored, slots and states say with numbers of explored relations
// (checker/engines/explorer/slot.hpp).
//
// `Packing` says which composition it is, and does what its rules leave to a host. It has
//   Composition, WriterOpens      the rules, and the occasion that opens the writer side
//   State                         flags and numbers that it needs besides the composition's
//   SharedState<readers, writers> and those that depend on how many there are
//   max_descriptors, receives_separately
//   one_event_opens_both          the receiver of an announcement opens both sides
//   repairs_leave_later           suppression begins when a repair leaves the source, for each of
//                                 its descriptors; otherwise when the message is made
//   lists_what_is_announced       ACKNACKs list nothing else, and `State` has `Announced`
//   Packing(running, scope), descriptors(stream)
//   start(host)                   the first state, and what will happen by itself
//   create(host, slot)            a descriptor comes into being, if that happens
//   answer(tag), fact(tag, world), perform(step, world, …)   steps without one run their contract
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

#include "checker/engines/explorer/claims.hpp"
#include "checker/engines/explorer/host_parts.hpp"
#include "checker/engines/explorer/slot_fields.hpp"
#include "checker/engines/explorer/snapshot_watch.hpp"
#include "model/engine/effect_mutator.hpp"
#include "model/engine/running_world.hpp"
#include "model/scenario.hpp"

namespace stormproof::explorer {

template <class Packing_, unsigned readers_ = 1, unsigned writers_ = 1>
class RuleHost : public SnapshotWatch<RuleHost<Packing_, readers_, writers_>, Packing_> {
 public:
  using Packing = Packing_;
  static constexpr unsigned reader_count = readers_;
  static constexpr unsigned writer_count = writers_;
  static constexpr unsigned relation_count = readers_ * writers_;
  static_assert(writers_ >= 1 && writers_ <= most_writers);
  using Composition = typename Packing::Composition;
  using Packet = Slot;
  /// The writer's view of a descriptor, the paper's letter.
  using C = decltype(detail::descriptor_part(typename Composition::Parts{}));
  using State = detail::StateOf<Packing, readers_, writers_>;

  RuleHost(const model::Scenario& running, const Scope& scope, const model::Mutation& mutation)
      : packing_{running, scope},
        participant_{detail::participant_of<writers_>(packing_)},
        dds_{running.dds},
        machines_{mutation.tables},
        mutation_{mutation} {}
  RuleHost(const RuleHost&) = delete;
  RuleHost& operator=(const RuleHost&) = delete;

  /// What rules are about from now on, and what `packing` works on.
  void go_on_with(State& state, Frame& frame) {
    state_ = &state;
    frame_ = &frame;
  }
  [[nodiscard]] State& state() { return *state_; }
  [[nodiscard]] Frame& frame() { return *frame_; }
  [[nodiscard]] Packing& packing() { return packing_; }
  [[nodiscard]] unsigned descriptors(unsigned relation = 0) const {
    return participant_.descriptors[relation % writer_count];
  }
  /// For the relation, writer or participant that the slot is about.
  template <class Trigger>
  void run_rule(const Slot& slot, std::uint32_t descriptor = 0) {
    model::run_rule<Trigger>(*this, slot.relation * detail::number_step<writers_>, &slot,
                             descriptor);
  }
  /// Runs the rule of the timer that the slot is.
  void run_due(const Slot& slot) {
    comp::for_each_type(typename Composition::Timers{}, [&]<class T>() {
      if constexpr (what_of<T>().has_value()) {
        if (what_of<T>() != slot.what) return;
        if constexpr (T::counted) {
          const std::uint8_t scheduled = state_->template get<T>(slot.relation);
          // 0: it was scheduled twice
          if (scheduled > 0) state_->template set<T>(scheduled - 1, slot.relation);
        }
        run_rule<comp::Due<T>>(slot);
      }
    });
  }
  /// The explored relation of what has a number in `owner`, and that of a world.
  template <comp::Owner owner = comp::owner::relation>
  static constexpr unsigned relation_of(std::uint32_t number) {
    return detail::explored_relation<owner, reader_count, writer_count>(number);
  }
  template <comp::Owner owner = comp::owner::relation, class World>
  static std::uint8_t relation_at(const World& w) {
    return static_cast<std::uint8_t>(relation_of<owner>(w.template number<owner>()));
  }
  void send(const Slot& packet) {
    if (!this->keeps(packet)) frame_->emit(packet);
  }
  // What a RunningWorld asks of its host.
  [[nodiscard]] comp::Watcher* watcher() { return mutator_.is_needed() ? &mutator_ : nullptr; }
  [[nodiscard]] const detail::OneParticipant<writers_>& topology() const { return participant_; }
  [[nodiscard]] static std::int64_t now() { return 0; }
  template <class Knob>
  [[nodiscard]] auto knob(Knob knob) const {
    return model::knob_value(knob, dds_);
  }
  template <class Tag, class World>
  [[nodiscard]] auto answer(Tag tag, const World&) const {
    if constexpr (std::derived_from<Tag, comp::Amount>) {
      return std::int64_t{0};  // the present, and counts of a cycle that there is not
    } else if constexpr (std::is_same_v<Tag, comp::RunEnds>) {
      return false;
    } else {
      return packing_.answer(tag);
    }
  }
  template <class Fact, class World>
  [[nodiscard]] bool fact(Fact fact, World& w) requires requires(Packing& packing) {
    packing.fact(fact, w);
  }
  { return packing_.fact(fact, w); }

  // Machines.
  template <class P>
  decltype(auto) driver(P) {
    auto& machines = static_cast<detail::PartMachines<P>&>(machines_);
    if constexpr (Packing::lists_what_is_announced && std::is_same_v<P, comp::Reader>) {
      return typename RuleHost::ListeningMachines{machines, *this};
    } else {
      return (machines);
    }
  }
  template <class P>
  [[nodiscard]] fsm::StateId& state(P, std::uint32_t n) {
    return state_->template state<P>(0, relation_of<P::owner>(n));
  }
  auto& bits(C) { return *this; }
  static constexpr auto lane_order(C) { return nullptr; }
  static void moved(C, std::uint32_t, fsm::StateId, fsm::StateId, std::uint64_t) {}

  [[nodiscard]] std::uint64_t in_state(std::uint32_t relation, std::uint32_t,
                                       fsm::StateId wanted) const {
    return state_->template in_state<C>(wanted, relation_of(relation));
  }
  [[nodiscard]] fsm::StateId state_of(std::uint32_t relation, std::uint32_t d) const {
    return state_->template state<C>(d, relation_of(relation));
  }
  template <class Event, class Effect>
  void step(std::uint32_t relation, std::uint32_t, std::uint64_t members,
            const typename fsm::Stepper<typename C::Machine>::Input& input, Effect&& effect) {
    for (std::uint64_t left = members; left != 0; left &= left - 1) {
      fsm::StateId& state = state_->template state<C>(static_cast<unsigned>(std::countr_zero(left)),
                                                      relation_of(relation));
      const fsm::StateId before = state;
      const auto output = driver(C{}).template step<Event>(state, input);
      effect(left & -left, output, before, state);
    }
  }
  template <class Event, class LaneInput, class Order, class Effect>
  void step_each(std::uint32_t relation, std::uint32_t, std::uint64_t members,
                 const LaneInput& lanes, const Order&, Effect&& effect) {
    if constexpr (requires { lanes.listed; }) {
      note_asked(*state_, *frame_, relation_of(relation),
                 static_cast<Members>(lanes.listed.bits & members), this->emitted());
    }
    for (std::uint64_t left = members; left != 0; left &= left - 1) {
      using Input = typename fsm::Stepper<typename C::Machine>::Input;
      step<Event>(relation, 0, left & -left, detail::input_of<Input>(left & -left, lanes), effect);
    }
  }

  // Flags, numbers and what packets say.
  template <class V>
  [[nodiscard]] auto value(V, std::uint32_t n) const {
    return state_->template get<V>(relation_of<V::owner>(n));
  }
  template <class V, class Value>
  void assign(V, std::uint32_t n, Value value) {
    state_->template set<V>(value, relation_of<V::owner>(n));
  }
  /// Doubling without end, the explored world would never come back to a state.
  void assign(comp::LastDelay, std::uint32_t relation, std::int64_t delay) {
    if (delay > knob(comp::InitialDelay{}) << last_doubling) return;
    state_->template set<comp::LastDelay>(delay, relation_of(relation));
  }
  template <class V>
  void assign(V, std::uint32_t n, std::uint32_t d, bool holds) {
    const unsigned relation = relation_of<V::owner>(n);
    const Members others = state_->template get<V>(relation) & static_cast<Members>(~member(d));
    state_->template set<V>(others | (holds ? member(d) : Members{0}), relation);
  }
  template <class V>
  void assign_each(V, std::uint32_t n, const model::DescriptorSet& set) {
    state_->template set<V>(members_of(set), relation_of<V::owner>(n));
  }
  template <class V>
  [[nodiscard]] std::uint64_t word(V, std::uint32_t n, std::uint32_t) const {
    return state_->template get<V>(relation_of<V::owner>(n));
  }
  template <class Field>
  [[nodiscard]] static std::uint64_t word(Field, const Slot& packet, std::uint32_t) {
    return members_said<Field>(packet);
  }
  template <class Field>
  [[nodiscard]] static bool said(Field field, const Slot& packet) {
    return packet.has(flag_of(field));
  }

  // Effects.
  template <class T>
  void schedule(T, std::uint32_t n, std::int64_t time) {
    if constexpr (what_of<T>().has_value()) {
      const unsigned relation = relation_of<T::owner>(n);
      if constexpr (T::counted) {
        state_->template set<T>(state_->template get<T>(relation) + 1, relation);
      }
      Slot slot{*what_of<T>()};
      slot.relation = static_cast<std::uint8_t>(relation);
      frame_->schedule(slot, time);
    }
  }
  template <class T>
  [[nodiscard]] std::int64_t pending(T, std::uint32_t n) const {
    return state_->template get<T>(relation_of<T::owner>(n));
  }
  /// Of the cycle that there is not.
  template <class T>
  static void cancel(T, std::uint32_t) {
    static_assert(detail::is_among<T>(LeftOut{}), "slots of a frame are not cancelled");
  }
  template <class P, class World, class... Sayings>
  void emit(P, World& w, const std::tuple<Sayings...>& sayings) {
    Slot packet{std::is_same_v<P, typename Composition::AckNack> ? What::acknack : What::heartbeat};
    packet.relation = relation_at(w);
    std::apply([&](const auto&... each) { (say(packet, each, w), ...); }, sayings);
    if constexpr (std::is_same_v<P, typename Composition::AckNack>) this->note_emitted(packet);
    send(packet);
  }
  template <class Step, class World, class... Args>
  void perform(Step step, World& w, const Args&... args) {
    if constexpr (requires { packing_.perform(step, w, args...); }) {
      packing_.perform(step, w, args...);
    } else {
      Step::contract(w, args...);
    }
  }
  /// The periodic policy has no cycle.
  template <class World>
  static void perform(comp::PlanBatches, World&, std::int64_t) {}
  /// The relations of the writer whose writer sides are open.
  [[nodiscard]] std::span<const std::uint32_t> readers(std::uint32_t writer) const {
    const std::uint32_t first = writer_count == 1 ? 0 : writer;
    return detail::relations_of<reader_count>(first, [&](unsigned reader) {
      return state_->template get<typename Composition::IsOpen>(first + reader * writer_count);
    });
  }
  [[nodiscard]] std::span<const std::uint32_t> readers_by_number(std::uint32_t writer) const {
    return readers(writer);
  }
  template <class Visit>
  void for_queue(std::uint32_t, Visit&& visit) {
    if constexpr (relation_count > 1) return packing_.for_queue(*this, visit);
    const unsigned queue = state_->template get<typename Composition::IsQueued>();
    for (unsigned left = queue; left != 0; left &= left - 1) {
      visit(0, static_cast<std::uint32_t>(std::countr_zero(left)));
    }
  }

 private:
  Packing packing_;
  const detail::OneParticipant<writers_> participant_;
  const model::DdsProfile dds_;
  detail::Machines<typename Composition::Parts> machines_;
  const model::Mutation mutation_;
  model::EffectMutator mutator_{&mutation_};
  State* state_ = nullptr;
  Frame* frame_ = nullptr;
};

}  // namespace stormproof::explorer
