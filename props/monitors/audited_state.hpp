// What rules that are executed beside a run are about: the state follows from the composition, in
// plain columns (model/engine/store.hpp), and so do facts, by their definitions. Here are also what
// packets say, and timers: the events of the run that are pending, by their insertion numbers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <deque>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "fsm/composition/heartbeat_clock.hpp"
#include "fsm/composition/reader.hpp"
#include "model/engine/composition_knobs.hpp"
#include "model/engine/running_world.hpp"
#include "props/monitors/audited.hpp"
#include "props/monitors/follower.hpp"
#include "props/monitors/received_descriptors.hpp"

namespace stormproof::props {

/// Packets that are no messages of contents, each with fields of its own.
template <class Packet>
concept OfNumbers = std::is_same_v<Packet, model::Packet>;

/// `Self` is the host of `Of`; `Base` is below it, a Follower or the host of other rules.
template <class Self, class Base, class Of>
class AuditedState : public model::Stored<Self, Base, typename Of::Things, typename Of::Columns,
                                          typename Of::Heard> {
  using Below =
      model::Stored<Self, Base, typename Of::Things, typename Of::Columns, typename Of::Heard>;
  using IsQueued = typename QueuedIn<typename Of::Composition>::type;

 public:
  using Number = std::uint32_t;
  using Packet = typename Of::Packet;
  using Composition = typename Of::Composition;
  using Columns = typename Of::Columns;
  template <comp::Owner owner>
  using World = model::RunningWorld<Self, owner>;

  AuditedState(model::RunState& run, Audit& audit)
      : Below{run, audit},
        readers_(Columns::template rows<comp::owner::writer>(run)),
        received_(run.topology.relation_count()),
        has_bases_{model::traits_of(run.scenario.dds).acknacks_have_bases},
        some_ride_{some_profile(run.scenario, [](const model::DdsProfile& dds) {
          return dds.sedp.piggyback != model::Piggyback::off;
        })} {
    if constexpr (has_part<Composition, comp::Reader>) {
      for (Number r = 0; r < run.topology.relation_count(); ++r) {
        this->state(comp::Reader{}, r) = first_state(comp::Reader{}, r);
      }
    }
  }

  [[nodiscard]] const model::Topology& topology() const { return this->run_.topology; }
  void stands_at(comp::Site site) { this->audit_.stands_at(site); }
  template <class Knob>
  [[nodiscard]] auto knob(Knob knob) const {
    return model::knob_value(knob, this->run_.scenario.dds);
  }
  [[nodiscard]] const model::Profiles& profiles() const { return this->run_.profiles; }
  [[nodiscard]] std::int64_t now() const { return this->run_.now.count(); }

  // What only a host knows.
  template <class W>
  [[nodiscard]] std::int64_t answer(comp::Now, const W&) const {
    return now();
  }
  template <class W>
  [[nodiscard]] bool answer(comp::RunEnds, const W&) const {
    return this->run_.ends_now();
  }
  template <class W>
  [[nodiscard]] bool answer(comp::CrossHost, const W& w) const {
    return topology().pair(w.template number<comp::owner::pair>()).cross_host;
  }
  template <class W>
  [[nodiscard]] std::int64_t answer(comp::ContactedCount, const W& w) const {
    return count_readers<comp::Contacted>(w.template number<comp::owner::writer>());
  }
  template <class W>
  [[nodiscard]] std::int64_t answer(comp::RespondedCount, const W& w) const {
    return count_readers<comp::Responded>(w.template number<comp::owner::writer>());
  }
  /// What every HEARTBEAT and ACKNACK asks for is counted as descriptors come and go.
  template <class W>
  [[nodiscard]] Number fact(comp::Missing, const W& w) const {
    const Number relation = w.template number<comp::owner::relation>();
    return topology().descriptor_count(relation) - received_[relation];
  }
  /// What a budget decides, if there is one.
  Choice choice() {
    bool& holds = chosen_[choices_++ % chosen_.size()];
    holds = false;
    return Choice{holds} && some_ride_;
  }

  // What packets say. Of the first descriptors of a stream it is how many these are.
  using Below::word;
  template <OfNumbers P>
  [[nodiscard]] std::uint64_t word(comp::Carries, const P& packet, Number k) const {
    return packet.descriptors.word(k);
  }
  template <OfNumbers P>
  [[nodiscard]] std::uint64_t word(comp::Listed, const P& packet, Number k) const {
    return packet.descriptors.word(k);
  }
  template <OfNumbers P>
  [[nodiscard]] std::uint64_t word(comp::BelowBase, const P& packet, Number k) const {
    return model::bits_below(has_bases_ ? packet.detail : packet.descriptors.lowest(), k);
  }
  template <OfNumbers P>
  [[nodiscard]] std::uint64_t word(comp::Announces, const P& packet, Number k) const {
    return model::bits_below(packet.detail, k);
  }
  template <OfNumbers P>
  static bool said(comp::CarriesHeartbeat, const P& packet) {
    return packet.carries_heartbeat;
  }
  template <OfNumbers P>
  static bool said(comp::IsRepair, const P& packet) {
    return packet.from_repair;
  }
  template <OfNumbers P>
  static bool said(comp::IsInitial, const P& packet) {
    return packet.initial_acknack;
  }

  // Readers.
  [[nodiscard]] const std::vector<Number>& readers(Number writer) const { return readers_[writer]; }
  [[nodiscard]] std::vector<Number> readers_by_number(Number writer) const {
    std::vector<Number> relations = readers_[writer];
    std::ranges::sort(relations);
    return relations;
  }
  void changed(typename Composition::IsOpen, Number relation, bool open) {
    const World<comp::owner::relation> w{self(), relation};
    const auto writer = w.template number<comp::owner::writer>();
    std::vector<Number>& readers = readers_[writer];
    if (!open) {
      std::erase(readers, relation);
      self().loses_turn(writer, relation);
    } else if constexpr (requires { Composition::serves_in_order_of_match; }) {
      readers.push_back(relation);
    } else {
      readers.insert(std::ranges::lower_bound(readers, relation), relation);
    }
  }
  /// The reader has these, and no others. Perhaps they complete the run; where endpoints have types
  /// it is notifications that do.
  virtual void take_descriptors(Number relation, const model::DescriptorSet& received) {
    const Number before = std::exchange(received_[relation], received.count());
    const Number now = received_[relation];
    if (is_required(relation / 2) && !this->run_.scenario.deployment.types) {
      this->run_.missing += before;
      this->run_.missing -= now;
    }
    if constexpr (std::is_same_v<decltype(Columns::column(comp::X{})), model::way::InPlanes>) {
      if (now < before) this->planes().lose(relation);
      this->planes().receive(relation, received);
    }
  }
  /// Whether discovery is complete only if the pair's destination has everything of its source.
  [[nodiscard]] virtual bool is_required(Number pair) const {
    return topology().pair(pair).cross_host;
  }

  // What is queued, first in, first out.
  struct Entry {
    Number writer = 0;
    Number descriptor = 0;

    bool operator==(const Entry&) const = default;
  };
  using Below::assign;
  using Below::assign_word;
  void assign(IsQueued flag, Number writer, Number d, bool queued) {
    const std::uint64_t bit = std::uint64_t{1} << d % 64;
    const std::uint64_t others = word(flag, writer, d / 64) & ~bit;
    assign_word(flag, writer, d / 64, queued ? others | bit : others);
  }
  void assign_word(IsQueued flag, Number writer, Number k, std::uint64_t queued) {
    std::deque<Entry>& queue = queues_[writer / 2];
    for (std::uint64_t left = queued ^ word(flag, writer, k); left != 0; left &= left - 1) {
      const Entry entry{writer, 64 * k + static_cast<Number>(std::countr_zero(left))};
      if ((left & ~(left - 1) & queued) != 0) {
        queue.push_back(entry);
      } else {
        std::erase(queue, entry);
      }
    }
    Below::assign_word(flag, writer, k, queued);
  }

  // Machines that are new ones. Of a reader side observers are told always, of clocks and of
  // control-only relations never, and of others if that changes their state.
  template <class P>
  void renew(P part, Number n) {
    if constexpr ((P::owner.indices & comp::owner::descriptor_index) != 0) {
      this->planes().renew(n, ReceivedDescriptors::renewed);
    } else {
      using States = fsm::Reflect<typename P::Machine>;
      const fsm::StateId before = this->state(part, n);
      this->state(part, n) = first_state(part, n);
      const fsm::StateId after = this->state(part, n);
      constexpr bool shown = P::owner != comp::owner::control_relation &&
                             std::is_same_v<typename P::Machine, fsm::SingleShot>;
      if (!std::is_same_v<P, comp::Reader> && !(shown && before != after)) return;
      this->audit_.transition({.machine = {fsm::name_of<typename P::Machine>(),
                                           Columns::kind(P::owner), Columns::subject(P::owner, n)},
                               .event = ReceivedDescriptors::renewed,
                               .before = States::state_names[before],
                               .after = States::state_names[after]});
    }
  }

  // Timers; those of a host of other rules below are its own.
  template <class T>
  static constexpr bool keeps_timer = std::is_same_v<Base, Follower> ||
                                      model::detail::is_listed<T>(typename Of::Things{});
  template <class T>
  void schedule(T timer, Number n, std::int64_t time) {
    if constexpr (!keeps_timer<T>) return Base::schedule(timer, n, time);
    const Scheduled* event = this->audit_.expect(Scheduled{
        model::event_kind_of<T>, Columns::subject(T::owner, n), model::Nanoseconds{time}});
    if (event != nullptr) pending_of(model::event_kind_of<T>, n).push_back(event->insertion);
  }
  template <class T>
  [[nodiscard]] std::int64_t pending(T timer, Number n) {
    if constexpr (!keeps_timer<T>) return Base::pending(timer, n);
    return std::ssize(pending_of(model::event_kind_of<T>, n));
  }
  template <class T>
  void cancel(T timer, Number n) {
    if constexpr (!keeps_timer<T>) return Base::cancel(timer, n);
    pending_of(model::event_kind_of<T>, n).clear();
  }
  // Layers lie on one another, so none of their virtual functions says `override`.
  virtual void rescheduled(const model::Event& event, std::uint64_t insertion) {
    comp::for_each_type(typename Composition::Timers{}, [&]<class T>() {
      if (event.kind != model::event_kind_of<T>) return;
      std::ranges::replace(pending_of(event.kind, Columns::number(T::owner, event)),
                           event.insertion(), insertion);
    });
  }

 protected:
  /// One of an owner without descriptors has nothing to wait for.
  template <class P>
  [[nodiscard]] fsm::StateId first_state([[maybe_unused]] P part, [[maybe_unused]] Number n) const {
    if constexpr (std::is_same_v<P, comp::Reader>) {
      if (topology().descriptor_count(n) == 0) {
        return fsm::Reflect<fsm::DiscoveryReader>::id<fsm::discovery_reader::EarlyComplete>;
      }
    }
    return fsm::Stepper<typename P::Machine>::initial;
  }
  /// Whether the event is one that is pending; it is not any more.
  template <class T>
  bool takes(T timer, Number owner, const model::Event& event) {
    if constexpr (!keeps_timer<T>) return Base::takes(timer, owner, event);
    return std::erase(pending_of(event.kind, owner), event.insertion()) > 0;
  }
  [[nodiscard]] std::deque<Entry>& queue_of(Number participant) { return queues_[participant]; }
  [[nodiscard]] bool has_bases() const { return has_bases_; }

  Self& self() { return static_cast<Self&>(*this); }

 private:
  template <class Flag>
  [[nodiscard]] std::int64_t count_readers(Number writer) const {
    return std::ranges::count_if(readers_[writer],
                                 [&](Number r) { return this->value(Flag{}, r); });
  }
  std::vector<std::uint64_t>& pending_of(model::EventKind kind, Number owner) {
    auto& owners = pending_[static_cast<std::size_t>(kind)];
    if (owner >= owners.size()) owners.resize(owner + 1);
    return owners[owner];
  }

  std::vector<std::vector<Number>> readers_;    // open relations, by writer
  std::vector<Number> received_;                // how many descriptors, by relation
  std::map<Number, std::deque<Entry>> queues_;  // by participant
  /// Insertion numbers, by kind and owner.
  std::array<std::vector<std::vector<std::uint64_t>>, model::event_kind_count> pending_;
  std::array<bool, 8> chosen_{};  // by the contract that is executed
  std::size_t choices_ = 0;
  const bool has_bases_;  // ACKNACKs
  const bool some_ride_;  // HEARTBEATs, in DATA
};

}  // namespace stormproof::props
