// A layer of a host of the simulator: beside what it keeps (model/engine/kept.hpp) the machines of
// its parts, the bit planes of those of descriptors, and its timers as events of the queue.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include "model/engine/composition_knobs.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/effect_mutator.hpp"
#include "model/engine/implementation.hpp"
#include "model/engine/kept.hpp"
#include "model/engine/relation_bits.hpp"
#include "model/engine/timer_kinds.hpp"

namespace stormproof::model {

namespace detail {

template <class P>
struct PlanesOf {
  explicit PlanesOf(RunState& run) : planes{run} {}
  RelationBits<typename P::Machine> planes;
};
template <class... Ps>
struct AllPlanes : PlanesOf<Ps>... {
  explicit AllPlanes([[maybe_unused]] RunState& run) : PlanesOf<Ps>{run}... {}
};
template <class... Ps>
AllPlanes<Ps...> planes_of(fsm::TypeList<Ps...>);

/// The machines of a part; observers hear of them by the numbers of `Columns`.
template <class P, class Columns>
struct MachinesOf {
  explicit MachinesOf(const RunState& run) : driver{run, Columns::kind(P::owner)} {}
  template <class Event>
  [[gnu::always_inline]] auto step(fsm::StateId& state,
                                   const typename Driver<typename P::Machine>::Input& input,
                                   std::uint32_t n) {
    return driver.template step<Event>(state, input, Columns::subject(P::owner, n));
  }
  Driver<typename P::Machine> driver;
};
template <class Columns, class... Ps>
struct AllMachines : MachinesOf<Ps, Columns>... {
  explicit AllMachines([[maybe_unused]] const RunState& run) : MachinesOf<Ps, Columns>{run}... {}
};
template <class Columns, class... Ps>
AllMachines<Columns, Ps...> machines_of(fsm::TypeList<Ps...>);

struct OnlyMachines {
  template <class T>
  static constexpr bool holds = IsMachine<T>;
};
/// The parts whose states lie in rows.
template <class Things, class Columns>
using SteppedAlone = Filtered<Filtered<Things, HasPlace<Columns>>, OnlyMachines>;

}  // namespace detail

/// What is below all layers: the run, its knobs and its time, and a timer that none of them has.
class HostBase : public Implementation {
  using Number = std::uint32_t;

 public:
  using OwnThings = fsm::TypeList<>;

  explicit HostBase(RunState& run) : run_{run} {}

  [[nodiscard]] comp::Watcher* watcher() { return watched_ ? &mutator_ : nullptr; }
  [[nodiscard]] const Topology& topology() const { return run_.topology; }
  [[nodiscard]] std::int64_t now() const { return run_.now.count(); }
  template <class Knob>
  [[nodiscard]] auto knob(Knob knob) const {
    return knob_value(knob, run_.scenario.dds);
  }
  [[nodiscard]] const Profiles& profiles() const { return run_.profiles; }
  template <class World>
  [[nodiscard]] std::int64_t answer(comp::Now, const World&) const {
    return now();
  }
  template <class World>
  [[nodiscard]] bool answer(comp::RunEnds, const World&) const {
    return run_.ends_now();
  }

  template <class T>
  void schedule(T, Number n, std::int64_t time) {
    run_.schedule(Nanoseconds{time}, event_kind_of<T>, n);
  }
  template <class T>
  [[nodiscard]] static bool is_due(T, const Event&) {
    return true;
  }
  template <class T>
  [[nodiscard]] static Number owner_of(T, const Event& event) {
    return event.subject;
  }

 protected:
  [[nodiscard]] const RunState& numbering() const { return run_; }

  RunState& run_;

 private:
  EffectMutator mutator_{run_.mutation, run_.probe};
  const bool watched_ = mutator_.is_needed();
};

/// `Self`, `Base` and `Heard` are those of `Kept`.
template <class Self, class Base, class Things, class Columns = PlainColumns,
          class Heard = fsm::TypeList<>>
class Stored : public Kept<Self, Base, Things, Columns, Heard> {
  using Below = Kept<Self, Base, Things, Columns, Heard>;
  using Number = std::uint32_t;
  /// The machine of descriptors, if there is one.
  using InPlanes = Filtered<Things, detail::HasWay<way::Planes, Columns>>;
  template <class P>
  static P only(fsm::TypeList<P>);
  template <class T>
  static constexpr bool is_in_planes = Below::template kept_as<T, way::InPlanes>;
  template <class T>
  static constexpr bool has_tokens = [] {
    if constexpr (Below::template keeps<T>) {
      return requires(detail::Place<T, detail::WayOf<T, Columns>> place) { place.token; };
    } else {
      return false;
    }
  }();
  template <class T>
  static constexpr bool has_insertions = Below::template kept_as<T, way::Insertions>;

 public:
  template <class... Args>
  explicit Stored(RunState& run, Args&&... args)
      : Below{run, std::forward<Args>(args)...}, machines_{run}, planes_{run} {}

  // Machines.
  template <class P>
  auto& driver(P part) {
    if constexpr (Below::template keeps<P>) {
      return static_cast<detail::MachinesOf<P, Columns>&>(machines_);
    } else {
      return Base::driver(part);
    }
  }

  // Machines of descriptors, and X beside them.
  template <class P>
  [[nodiscard]] auto& bits(P part) {
    if constexpr (detail::is_listed<P>(InPlanes{})) {
      return static_cast<detail::PlanesOf<P>&>(planes_).planes;
    } else {
      return Base::bits(part);
    }
  }
  /// Of inputs, those come first that hold, if the host does not say otherwise.
  template <class P>
  static constexpr auto lane_order(P part) {
    if constexpr (detail::is_listed<P>(InPlanes{})) {
      LaneOrder<typename P::Machine::Io::template Input<LaneDomain>> order;
      order.fill(true);
      return order;
    } else {
      return Base::lane_order(part);
    }
  }
  template <class P>
  void moved(P part, Number n, fsm::StateId before, fsm::StateId after, std::uint64_t members) {
    if constexpr (!detail::is_listed<P>(InPlanes{})) Base::moved(part, n, before, after, members);
  }
  template <class T, class From>
  requires(is_in_planes<T> || requires(const Below& b, T t, const From& f) { b.word(t, f, 0U); })
      [[nodiscard]] std::uint64_t word(T tag, const From& from, Number k) const {
    if constexpr (is_in_planes<T>) {
      return planes().received(from, k);
    } else {
      return Below::word(tag, from, k);
    }
  }
  template <class T>
  requires(is_in_planes<T> || requires(Base & b, T t, DescriptorSet s) {
    b.assign_each(t, 0U, s);
  }) void assign_each(T tag, Number relation, const DescriptorSet& received) {
    if constexpr (!is_in_planes<T>) {
      Base::assign_each(tag, relation, received);
    } else if constexpr (Below::template is_heard<T>) {
      this->self().take_descriptors(relation, received);
    } else {
      this->take(planes(), relation, received, this->ends(relation).cross_host);
    }
  }

  // Timers.
  template <class T>
  void schedule(T timer, Number n, std::int64_t time) {
    if constexpr (!detail::is_listed<T>(Things{})) {
      Base::schedule(timer, n, time);
    } else {
      Number detail = Columns::detail(T::owner, n);
      if constexpr (has_tokens<T>) {
        auto& place = this->template place<T>(n);
        ++place.pending;
        detail = place.token;
      }
      this->run_.schedule(Nanoseconds{time}, event_kind_of<T>, Columns::subject(T::owner, n),
                          detail);
    }
  }
  template <class T>
  void cancel(T timer, Number n) {
    if constexpr (has_tokens<T>) {
      ++this->template place<T>(n).token;
      this->template place<T>(n).pending = 0;
    } else if constexpr (has_insertions<T>) {
      this->template place<T>(n).before = this->run_.queue.next_insertion();
    } else {
      Base::cancel(timer, n);
    }
  }
  template <class T>
  [[nodiscard]] std::int64_t pending(T timer, Number n) const {
    if constexpr (has_tokens<T>) {
      return this->template place<T>(n).pending;
    } else {
      return Base::pending(timer, n);
    }
  }
  template <class T>
  [[nodiscard]] Number owner_of(T timer, const Event& event) const {
    if constexpr (detail::is_listed<T>(Things{})) {
      return Columns::number(T::owner, event);
    } else {
      return Base::owner_of(timer, event);
    }
  }
  /// Whether what is due has not been cancelled. It is not pending any more.
  template <class T>
  [[nodiscard]] bool is_due(T timer, const Event& event) {
    if constexpr (has_tokens<T>) {
      auto& place = this->template place<T>(owner_of(timer, event));
      if (event.detail != place.token) return false;
      if (place.pending > 0) --place.pending;  // 0: the event was scheduled twice
      return true;
    } else if constexpr (has_insertions<T>) {
      return event.insertion() >= this->template place<T>(owner_of(timer, event)).before &&
             Base::is_due(timer, event);
    } else {
      return Base::is_due(timer, event);
    }
  }

 protected:
  [[nodiscard]] auto& planes() {
    if constexpr (InPlanes::size == 1) {
      return bits(decltype(only(InPlanes{})){});
    } else {
      return Base::planes();
    }
  }
  [[nodiscard]] const auto& planes() const { return const_cast<Stored&>(*this).planes(); }

 private:
  decltype(detail::machines_of<Columns>(detail::SteppedAlone<Things, Columns>{})) machines_;
  decltype(detail::planes_of(InPlanes{})) planes_;
};

}  // namespace stormproof::model
