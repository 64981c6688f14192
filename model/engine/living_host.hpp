// A host of rules with a life (fsm/composition/life.hpp), on top of the host of those without:
// what these rules remember, timers that a new side or participant does not have any more, and who
// hears whom.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "fsm/composition/life.hpp"
#include "model/engine/discovery_base.hpp"
#include "model/life.hpp"

namespace stormproof::model {

template <>
inline constexpr EventKind event_kind_of<comp::LeaseCheck> = EventKind::lease_check;
template <>
inline constexpr EventKind event_kind_of<comp::Return> = EventKind::participant_start;

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
template <class V, class List>
struct IsOneOf;
template <class V, class... Vs>
struct IsOneOf<V, fsm::TypeList<Vs...>> : std::disjunction<std::is_same<V, Vs>...> {};
}  // namespace detail

/// `Cancellable` are the timers of a participant or a side that may be a new one; what the rules
/// remember is `Composition::Memory`.
template <class Base, class Composition_, class Cancellable>
class LivingHost : public Base {
 public:
  using Composition = Composition_;

  template <class V>
  static constexpr bool is_remembered = detail::IsOneOf<V, typename Composition::Memory>::value;
  template <class Timer>
  static constexpr bool is_cancellable = detail::IsOneOf<Timer, Cancellable>::value;

  LivingHost(RunState& run, Network& network)
      : Base{run, network}, life_{run.scenario.deployment.life.value_or(Life{})} {
    const std::uint32_t owners =
        std::max(run.topology.relation_count(), 2 * run.topology.participant_count());
    std::apply([&](auto&... each) { (each.of.resize(owners), ...); }, memory_);
    for (std::uint32_t i = 0; i < run.topology.participant_count(); ++i) {
      leases_.push_back(lease_of(life_, i).value_or(Nanoseconds{}).count());
    }
    for (std::uint32_t relation = 0; relation < run.topology.relation_count(); ++relation) {
      if (this->ends(relation).cross_host && !is_required(relation)) {
        run.missing -= run.topology.descriptor_count(relation);
      }
    }
  }

  using Base::answer;
  using Base::assign;
  using Base::cancel;
  using Base::is_due;
  using Base::value;

  template <class V>
  requires is_remembered<V>
  [[nodiscard]] std::int64_t value(V, std::uint32_t owner) const {
    return std::get<detail::Remembered<V, std::int64_t>>(memory_).of[owner];
  }
  template <class V>
  requires is_remembered<V>
  void assign(V, std::uint32_t owner, std::int64_t to) {
    std::get<detail::Remembered<V, std::int64_t>>(memory_).of[owner] = to;
  }

  template <class Timer>
  void cancel(Timer timer, std::uint32_t owner) {
    if constexpr (is_cancellable<Timer>) {
      cancel_all(timer, owner);
    } else {
      Base::cancel(timer, owner);
    }
  }
  void cancel(comp::HeartbeatExpiry, std::uint32_t w) {
    cancel_all(comp::HeartbeatExpiry{}, w);
    this->clocks_[w].expiries = 0;
  }
  template <class Timer>
  [[nodiscard]] bool is_due(Timer timer, const Event& event) {
    if constexpr (is_cancellable<Timer>) {
      return !is_cancelled(timer, event);
    } else {
      return Base::is_due(timer, event);
    }
  }
  [[nodiscard]] bool is_due(comp::HeartbeatExpiry expiry, const Event& event) {
    return !is_cancelled(expiry, event) && Base::is_due(expiry, event);
  }

  void renew(comp::AnnouncementTimer, std::uint32_t i) { this->announcers_[i] = {}; }
  void renew(comp::HeartbeatClock, std::uint32_t w) {
    const auto tokens = this->clocks_[w].tokens;
    this->clocks_[w] = {};
    this->clocks_[w].tokens = tokens;
  }
  void renew(comp::Reader, std::uint32_t relation) {
    using States = fsm::Reflect<fsm::DiscoveryReader>;
    const fsm::StateId before = this->readers_[relation].state;
    const fsm::StateId after = this->topology().descriptor_count(relation) > 0
                                   ? States::template id<fsm::discovery_reader::Unknown>
                                   : States::template id<fsm::discovery_reader::EarlyComplete>;
    this->readers_[relation].state = after;
    note_renewed<fsm::DiscoveryReader>(MachineRef::Kind::relation, relation, before, after);
  }
  void renew(comp::InitialTimer, std::uint32_t relation) {
    this->readers_[relation].initial = fsm::Stepper<fsm::InitialAckNack>::initial;
  }

  template <class World>
  [[nodiscard]] std::int64_t answer(comp::LeaseDuration, const World& w) const {
    return leases_[this->topology().pair(w.template number<comp::owner::pair>()).source];
  }

  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override {
    std::vector<MissingDescriptor> list = Base::missing(SIZE_MAX);
    std::erase_if(list, [&](const MissingDescriptor& missing) {
      return is_replaced(life_, missing.source.value) ||
             is_replaced(life_, missing.destination.value);
    });
    list.resize(std::min(list.size(), limit));
    return list;
  }

 protected:
  /// What observers are told of a machine that is a new one.
  static constexpr std::string_view renewed = "Renewed";

  template <class Machine>
  void note_renewed(MachineRef::Kind kind, std::uint32_t n, fsm::StateId before,
                    fsm::StateId after) {
    if (this->run_.probe == nullptr) return;
    using States = fsm::Reflect<Machine>;
    this->run_.probe->transition({fsm::name_of<Machine>(), kind, n}, renewed,
                                 States::state_names[before], States::state_names[after], 0, 0);
  }
  /// `Life::LoseAll` of participant i, with what the host has besides: `of_participant()`, and
  /// `of_writer(w)` for each.
  template <class Life, class Host, class OfParticipant, class OfWriter>
  void lose_all(Host& host, std::uint32_t i, OfParticipant&& of_participant, OfWriter&& of_writer) {
    renew(comp::AnnouncementTimer{}, i);
    cancel(comp::Announcement{}, i);
    of_participant();
    const Topology& topology = this->topology();
    for (std::uint32_t there = topology.first_pair(i); there < topology.first_pair(i + 1);
         ++there) {
      RunningWorld<Host, comp::owner::pair>{host, topology.pair(there).reverse}.call(
          typename Life::Forget{});
    }
    for (const std::uint32_t w : {2 * i, 2 * i + 1}) {
      renew(comp::HeartbeatClock{}, w);
      cancel(comp::HeartbeatExpiry{}, w);
      cancel(comp::CycleStart{}, w);
      cancel(comp::CycleEnd{}, w);
      cancel(comp::BatchDue{}, w);
      this->refill(w);
      of_writer(w);
    }
  }
  /// Returns that are part of the run.
  void schedule_returns() {
    for (const Restart& restart : life_.restarts) {
      if (restart.identity == Identity::fresh) continue;
      this->run_.schedule(restart.start, EventKind::participant_start, restart.participant);
    }
  }
  /// Whether discovery is complete only if the reader has everything.
  [[nodiscard]] bool is_required(std::uint32_t relation) const {
    const Pair& pair = this->ends(relation);
    return pair.cross_host && !is_replaced(life_, pair.source) &&
           !is_replaced(life_, pair.destination);
  }
  /// What is scheduled of it.
  template <class Timer>
  void cancel_all(Timer, std::uint32_t owner) {
    auto& before = std::get<detail::Remembered<Timer, std::uint64_t>>(cancelled_).of;
    if (before.size() <= owner) before.resize(owner + 1);
    before[owner] = this->run_.queue.next_insertion();
  }
  template <class Timer>
  [[nodiscard]] bool is_cancelled(Timer, const Event& event) const {
    const auto& before = std::get<detail::Remembered<Timer, std::uint64_t>>(cancelled_).of;
    return event.subject < before.size() && event.insertion() < before[event.subject];
  }

  const Life life_;

 private:
  typename detail::MemoryOf<typename Composition::Memory, std::int64_t>::type memory_;
  /// By owner: events that were scheduled before this one are cancelled.
  typename detail::MemoryOf<Cancellable, std::uint64_t>::type cancelled_;
  std::vector<std::int64_t> leases_;  // by participant; 0: never forgotten
};

}  // namespace stormproof::model
