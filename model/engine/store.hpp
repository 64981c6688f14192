// What a composition declares, kept: the states of its machines, its flags, numbers and timers, one
// place for each thing and owner. What has one owner lies in one row. How a thing is kept is chosen
// by a name, in `Columns`: an overload `static Prefix column(Known);`. `Stored` is the part of a
// host (model/engine/running_world.hpp) that follows from that.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "fsm/composition/vocabulary.hpp"
#include "fsm/stepper.hpp"
#include "model/engine/composition_knobs.hpp"
#include "model/engine/descriptor_set.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/implementation.hpp"
#include "model/engine/relation_bits.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model {

// Lists of things. --------------------------------------------------------------------------------

namespace detail {
template <class T, class... Ts>
constexpr bool is_listed(fsm::TypeList<Ts...>) {
  return (std::is_same_v<T, Ts> || ...);
}
template <class Keep, class... Ts>
auto filtered(fsm::TypeList<Ts...>) -> typename comp::JoinedLists<
    std::conditional_t<Keep::template holds<Ts>, fsm::TypeList<Ts>, fsm::TypeList<>>...>::type;
template <class List>
struct NotIn {
  template <class T>
  static constexpr bool holds = !is_listed<T>(List{});
};
}  // namespace detail

template <class List, class Keep>
using Filtered = decltype(detail::filtered<Keep>(List{}));
/// Those of a list that are not in the other.
template <class List, class Other>
using Without = Filtered<List, detail::NotIn<Other>>;
/// All that the composition declares to exist.
template <class C>
using ThingsOf = comp::Joined<typename C::Parts, typename C::State, typename C::Timers>;

// Ways to keep a thing. ---------------------------------------------------------------------------

namespace way {
struct Cell {};        ///< a machine's state, a truth value, or a number
struct Narrow {};      ///< a number that never grows beyond 32 bits
struct Prefix {};      ///< a flag of descriptors that holds for the first ones: how many
struct Bits {};        ///< a flag of descriptors: a bit for each
struct Tokens {};      ///< a timer that is counted, and cancelled by a new number
struct Insertions {};  ///< a timer that is cancelled by what was scheduled before
struct Nothing {};     ///< a timer that is neither counted nor cancelled
struct Capped {};    ///< a delay that doubles, and need not any more once it is longer than any run
struct Planes {};    ///< machines of descriptors, as bit planes (model/engine/relation_bits.hpp)
struct InPlanes {};  ///< X, which lies with them
struct Elsewhere {};  ///< the host keeps it
}  // namespace way

/// What there is to say of numbers of owners: where their things are, and what the queue and
/// observers call them.
struct PlainColumns {
  template <class T>
  static constexpr auto column(T) {
    if constexpr (requires { T::counted; }) {
      return std::conditional_t<T::counted, way::Tokens, way::Nothing>{};
    } else if constexpr ((T::owner.indices & comp::owner::descriptor_index) == 0) {
      return way::Cell{};
    } else {
      return std::conditional_t < requires { typename T::Machine; }
      , way::Planes, way::Bits > {};
    }
  }
  static way::InPlanes column(comp::X);
  /// How many rows there are.
  static std::uint32_t rows(comp::Owner owner, const RunState& run) {
    namespace own = comp::owner;
    if (owner == own::participant) return run.topology.participant_count();
    if (owner == own::pair) return run.topology.pair_count();
    if (owner == own::writer) return 2 * run.topology.participant_count();
    if (owner == own::relation) return run.topology.relation_count();
    return 0;
  }
  static std::uint32_t row(comp::Owner, std::uint32_t n, const RunState&) { return n; }
  /// How observers hear of a machine.
  static constexpr MachineRef::Kind kind(comp::Owner owner) {
    using enum MachineRef::Kind;
    namespace own = comp::owner;
    if (owner == own::participant) return participant;
    if (owner == own::pair) return pair;
    if (owner == own::writer) return writer;
    return owner == own::relation ? relation : control_relation;
  }
  static constexpr std::uint32_t subject(comp::Owner, std::uint32_t n) { return n; }
  /// The detail of an event; with `way::Tokens` it is the token, if this is 0.
  static constexpr std::uint32_t detail(comp::Owner, std::uint32_t) { return 0; }
  static constexpr std::uint32_t number(comp::Owner, const Event& event) { return event.subject; }
};

namespace detail {
template <class T, class Columns>
using WayOf = decltype(Columns::column(T{}));
template <class T>
constexpr auto first_value() {
  if constexpr (requires { typename T::Machine; }) {
    return fsm::Stepper<typename T::Machine>::initial;
  } else if constexpr (requires { typename T::IsFlag; }) {
    return false;
  } else {
    return std::int64_t{};
  }
}

template <class T, class Way>
struct Place;
template <class T>
struct Place<T, way::Cell> {
  decltype(first_value<T>()) value = first_value<T>();
};
template <class T>
struct Place<T, way::Narrow> {
  std::uint32_t value = 0;
};
template <class T>
struct Place<T, way::Capped> {
  std::int64_t value = 0;
};
template <class T>
struct Place<T, way::Prefix> {
  std::uint32_t value = 0;

  [[nodiscard]] std::uint64_t word(std::uint32_t k) const { return bits_below(value, k); }
  void set(std::uint32_t d, bool to) { value = to ? d + 1 : d; }
  [[nodiscard]] std::uint32_t first() const { return value; }
  void set_first(std::uint32_t count) { value = count; }
  /// Words come in ascending order, and those above are read before they are written: a full word
  /// leaves them as they are.
  void set_word(std::uint32_t k, std::uint64_t bits) {
    if (~bits == 0) {
      value = std::max(value, 64 * k + 64);
    } else if (value >= 64 * k) {
      value = 64 * k + static_cast<std::uint32_t>(std::bit_width(bits));
    }
  }
};
template <class T>
struct Place<T, way::Bits> {
  std::vector<std::uint64_t> value;

  [[nodiscard]] std::uint64_t word(std::uint32_t k) const {
    return k < value.size() ? value[k] : 0;
  }
  void set(std::uint32_t d, bool to) {
    const std::uint64_t bit = std::uint64_t{1} << d % 64;
    set_word(d / 64, to ? word(d / 64) | bit : word(d / 64) & ~bit);
  }
  void set_word(std::uint32_t k, std::uint64_t bits) {
    if (k >= value.size()) value.resize(k + 1);
    value[k] = bits;
  }
  [[nodiscard]] std::uint32_t first() const {
    std::uint32_t count = 0;
    for (const std::uint64_t bits : value) {
      count += static_cast<std::uint32_t>(std::countr_one(bits));
      if (~bits != 0) break;
    }
    return count;
  }
  void set_first(std::uint32_t count) {
    value.clear();
    for (std::uint32_t k = 0; k < words_for(count); ++k) value.push_back(bits_below(count, k));
  }
};
template <class T>
struct Place<T, way::Tokens> {
  std::uint32_t token = 0;
  std::uint32_t pending = 0;
};
template <class T>
struct Place<T, way::Insertions> {
  std::uint64_t before = 0;  ///< events that were scheduled before this one are cancelled
};

template <class Columns>
struct HasPlace {
  template <class T>
  static constexpr bool holds = !is_listed<WayOf<T, Columns>>(
      fsm::TypeList<way::Nothing, way::Elsewhere, way::Planes, way::InPlanes>{});
};
template <class Way, class Columns>
struct HasWay {
  template <class T>
  static constexpr bool holds = std::is_same_v<WayOf<T, Columns>, Way>;
};
/// Of descriptors: what their relation or writer has of them.
constexpr comp::Owner without_descriptor(comp::Owner owner) {
  return {static_cast<std::uint8_t>(owner.indices & ~comp::owner::descriptor_index)};
}
template <std::uint8_t indices, class Columns, std::size_t least, std::size_t most>
struct InRow {
  template <class T>
  static constexpr bool holds = [] {
    if constexpr (without_descriptor(T::owner).indices != indices) {
      return false;
    } else {
      constexpr std::size_t size = sizeof(Place<T, WayOf<T, Columns>>);
      return least <= size && size <= most;
    }
  }();
};
template <class Columns, class... Ts>
struct RowOf : Place<Ts, WayOf<Ts, Columns>>... {};
template <class Columns, class... Ts>
RowOf<Columns, Ts...> row_of(fsm::TypeList<Ts...>);
/// All of one owner; large things first, which leaves no holes.
template <std::uint8_t indices, class Things, class Columns>
struct Rows {
  using Row =
      decltype(row_of<Columns>(comp::Joined<Filtered<Things, InRow<indices, Columns, 9, SIZE_MAX>>,
                                            Filtered<Things, InRow<indices, Columns, 8, 8>>,
                                            Filtered<Things, InRow<indices, Columns, 4, 4>>,
                                            Filtered<Things, InRow<indices, Columns, 1, 1>>>{}));
  static constexpr comp::Owner owner{indices};
  std::vector<Row> of;
};
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
template <class P, class Columns>
struct Machines {
  explicit Machines(const RunState& run) : driver{run, Columns::kind(P::owner)} {}
  template <class Event>
  [[gnu::always_inline]] auto step(fsm::StateId& state,
                                   const typename Driver<typename P::Machine>::Input& input,
                                   std::uint32_t n) {
    return driver.template step<Event>(state, input, Columns::subject(P::owner, n));
  }
  Driver<typename P::Machine> driver;
};
template <class Columns, class... Ps>
struct AllMachines : Machines<Ps, Columns>... {
  explicit AllMachines([[maybe_unused]] const RunState& run) : Machines<Ps, Columns>{run}... {}
};
template <class Columns, class... Ps>
AllMachines<Columns, Ps...> machines_of(fsm::TypeList<Ps...>);
struct IsMachine {
  template <class T>
  static constexpr bool holds = requires {
    typename T::Machine;
  };
};
}  // namespace detail

// The store. --------------------------------------------------------------------------------------

template <class Things, class Columns>
class Store {
  using Kept = Filtered<Things, detail::HasPlace<Columns>>;

 public:
  template <class T>
  static constexpr bool has = detail::is_listed<T>(Things{});
  template <class T>
  static constexpr bool keeps = detail::is_listed<T>(Kept{});

  explicit Store(RunState& run) : machines_{run}, planes_{run} {
    std::apply([&](auto&... each) { (each.of.resize(Columns::rows(each.owner, run)), ...); },
               rows_);
  }
  template <class T>
  [[nodiscard]] auto& at(std::uint32_t row) {
    return static_cast<detail::Place<T, detail::WayOf<T, Columns>>&>(
        rows<detail::without_descriptor(T::owner).indices>()[row]);
  }
  template <class T>
  [[nodiscard]] const auto& at(std::uint32_t row) const {
    return const_cast<Store&>(*this).at<T>(row);
  }
  template <class P>
  [[nodiscard]] detail::Machines<P, Columns>& machines() {
    return machines_;
  }
  /// Of the machine of descriptors.
  template <class P>
  [[nodiscard]] auto& planes() {
    return static_cast<detail::PlanesOf<P>&>(planes_).planes;
  }

 private:
  template <std::uint8_t indices>
  using RowsOf = detail::Rows<indices, Kept, Columns>;
  template <std::uint8_t indices>
  auto& rows() {
    return std::get<RowsOf<indices>>(rows_).of;
  }

  std::tuple<RowsOf<comp::owner::participant.indices>, RowsOf<comp::owner::pair.indices>,
             RowsOf<comp::owner::writer.indices>, RowsOf<comp::owner::relation.indices>,
             RowsOf<comp::owner::control_relation.indices>>
      rows_;
  decltype(detail::machines_of<Columns>(Filtered<Kept, detail::IsMachine>{})) machines_;
  decltype(detail::planes_of(Filtered<Things, detail::HasWay<way::Planes, Columns>>{})) planes_;
};

// What a host has of it. --------------------------------------------------------------------------

/// What is below all stores of a host: a timer that none of them keeps.
class HostBase : public Implementation {
  using Number = std::uint32_t;

 public:
  explicit HostBase(RunState& run) : run_{run} {}

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
  RunState& run_;
};

/// `Base` knows the rest. `Self` is the host itself; where it has a function
///   changed(tag, n, to)   it is told of a flag or number that changes, before it does
/// A host may keep a thing in its own way: it declares the function for its tag.
template <class Self, class Base, class Things, class Columns = PlainColumns>
class Stored : public Base {
  using Number = std::uint32_t;
  using Data = Store<Things, Columns>;
  /// The machine of descriptors, if there is one.
  using InPlanes = Filtered<Things, detail::HasWay<way::Planes, Columns>>;
  template <class P>
  static P only(fsm::TypeList<P>);
  template <class T>
  static constexpr bool is_x = std::is_same_v<T, comp::X>&& InPlanes::size == 1 &&
                               detail::is_listed<comp::X>(Things{});

  template <class T>
  static constexpr bool keeps = Data::template keeps<T>;
  template <class T, class Way>
  static constexpr bool kept_as = [] {
    if constexpr (keeps<T>) return std::is_same_v<detail::WayOf<T, Columns>, Way>;
    return false;
  }();
  template <class T>
  static constexpr bool of_descriptors = (T::owner.indices & comp::owner::descriptor_index) != 0;

 public:
  using OwnColumns = Columns;

  template <class... Args>
  explicit Stored(RunState& run, Args&&... args)
      : Base{run, std::forward<Args>(args)...}, data_{run} {}

  /// What the owner n has of it: a value; of descriptors, how many or which.
  template <class T>
  [[nodiscard, gnu::always_inline]] auto& at(Number n) {
    if constexpr (!keeps<T>) {
      return Base::template at<T>(n);
    } else if constexpr (requires { data_.template at<T>(n).value; }) {
      return data_.template at<T>(row<T>(n)).value;
    } else {
      return data_.template at<T>(row<T>(n));
    }
  }
  template <class T>
  [[nodiscard, gnu::always_inline]] const auto& at(Number n) const {
    return const_cast<Stored&>(*this).template at<T>(n);
  }

  // Machines.
  template <class P>
  auto& driver(P part) {
    if constexpr (keeps<P>) {
      return data_.template machines<P>();
    } else {
      return Base::driver(part);
    }
  }
  template <class P>
  auto& state(P, Number n) {
    return at<P>(n);
  }

  // Flags and numbers.
  template <class T>
  [[nodiscard]] auto value(T tag, Number n) const {
    if constexpr (!keeps<T>) {
      return Base::value(tag, n);
    } else if constexpr (requires { typename T::IsNumber; }) {
      return static_cast<std::int64_t>(at<T>(n));
    } else {
      return at<T>(n);
    }
  }
  template <class T, class Value>
  void assign(T tag, Number n, Value to) {
    if constexpr (!keeps<T>) {
      Base::assign(tag, n, to);
    } else {
      auto& value = at<T>(n);
      const auto next = static_cast<std::remove_reference_t<decltype(value)>>(to);
      if constexpr (requires(Self & self) { self.changed(tag, n, next); }) {
        if (value != next) static_cast<Self&>(*this).changed(tag, n, next);
      }
      if constexpr (kept_as<T, way::Capped>) {
        constexpr std::int64_t longest = std::int64_t{1} << 60;
        if (value >= longest) return;  // only an event that is scheduled twice gets so far
      }
      value = next;
    }
  }
  // Of descriptors.
  template <class T, class From>
  requires(keeps<T> || is_x<T> || requires(const Base& b, T t, const From& f) { b.word(t, f, 0U); })
      [[nodiscard]] std::uint64_t word(T tag, const From& from, Number k) const {
    if constexpr (keeps<T>) {
      return place<T>(from).word(k);
    } else if constexpr (is_x<T>) {
      return planes().received(from, k);
    } else {
      return Base::word(tag, from, k);
    }
  }
  /// How many of the first descriptors of the owner have it, however it is kept.
  template <class T>
  [[nodiscard]] Number first(Number n) const {
    if constexpr (keeps<T>) {
      return place<T>(n).first();
    } else {
      return Base::template first<T>(n);
    }
  }
  template <class T>
  void set_first(Number n, Number count) {
    if constexpr (keeps<T>) {
      place<T>(n).set_first(count);
    } else {
      Base::template set_first<T>(n, count);
    }
  }
  template <class T>
  [[nodiscard]] bool has(T tag, Number n, Number d) const {
    return (word(tag, n, d / 64) >> d % 64 & 1) != 0;
  }
  template <class T>
  void assign(T tag, Number n, Number d, bool to) {
    if constexpr (keeps<T>) {
      place<T>(n).set(d, to);
    } else {
      Base::assign(tag, n, d, to);
    }
  }
  template <class T>
  requires(keeps<T> || requires(Base & b, T t) {
    b.assign_word(t, 0U, 0U, std::uint64_t{});
  }) void assign_word(T tag, Number n, Number k, std::uint64_t bits) {
    if constexpr (keeps<T>) {
      place<T>(n).set_word(k, bits);
    } else {
      Base::assign_word(tag, n, k, bits);
    }
  }

  template <class T>
  requires(is_x<T> || requires(Base & b, T t, DescriptorSet s) {
    b.assign_each(t, 0U, s);
  }) void assign_each(T tag, Number relation, const DescriptorSet& received) {
    if constexpr (!is_x<T>) {
      Base::assign_each(tag, relation, received);
    } else if constexpr (requires(Self & self) { self.take_descriptors(relation, received); }) {
      static_cast<Self&>(*this).take_descriptors(relation, received);
    } else {
      this->take(planes(), relation, received, this->ends(relation).cross_host);
    }
  }

  // Machines of descriptors.
  template <class P>
  [[nodiscard]] auto& bits(P part) {
    if constexpr (detail::is_listed<P>(InPlanes{})) {
      return data_.template planes<P>();
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

  // Timers.
  template <class T>
  void schedule(T timer, Number n, std::int64_t time) {
    if constexpr (!Data::template has<T>) {
      Base::schedule(timer, n, time);
    } else {
      Number detail = Columns::detail(T::owner, n);
      if constexpr (kept_as<T, way::Tokens>) {
        auto& place = at<T>(n);
        ++place.pending;
        detail = place.token;
      }
      this->run_.schedule(Nanoseconds{time}, event_kind_of<T>, Columns::subject(T::owner, n),
                          detail);
    }
  }
  template <class T>
  void cancel(T timer, Number n) {
    if constexpr (kept_as<T, way::Tokens>) {
      ++at<T>(n).token;
      at<T>(n).pending = 0;
    } else if constexpr (kept_as<T, way::Insertions>) {
      at<T>(n).before = this->run_.queue.next_insertion();
    } else {
      Base::cancel(timer, n);
    }
  }
  template <class T>
  [[nodiscard]] std::int64_t pending(T timer, Number n) const {
    if constexpr (kept_as<T, way::Tokens>) {
      return at<T>(n).pending;
    } else {
      return Base::pending(timer, n);
    }
  }
  template <class T>
  [[nodiscard]] Number owner_of(T timer, const Event& event) const {
    if constexpr (Data::template has<T>) {
      return Columns::number(T::owner, event);
    } else {
      return Base::owner_of(timer, event);
    }
  }
  /// Whether what is due has not been cancelled. It is not pending any more.
  template <class T>
  [[nodiscard]] bool is_due(T timer, const Event& event) {
    if constexpr (kept_as<T, way::Tokens>) {
      auto& place = at<T>(owner_of(timer, event));
      if (event.detail != place.token) return false;
      if (place.pending > 0) --place.pending;  // 0: the event was scheduled twice
      return true;
    } else if constexpr (kept_as<T, way::Insertions>) {
      return event.insertion() >= at<T>(owner_of(timer, event)).before &&
             Base::is_due(timer, event);
    } else {
      return Base::is_due(timer, event);
    }
  }

 protected:
  [[nodiscard]] auto& planes() {
    if constexpr (InPlanes::size == 1) {
      return data_.template planes<decltype(only(InPlanes{}))>();
    } else {
      return Base::planes();
    }
  }
  [[nodiscard]] const auto& planes() const { return const_cast<Stored&>(*this).planes(); }

 private:
  template <class T>
  [[nodiscard, gnu::always_inline]] Number row(Number n) const {
    return Columns::row(detail::without_descriptor(T::owner), n, this->run_);
  }
  template <class T>
  [[nodiscard, gnu::always_inline]] auto& place(Number n) {
    return data_.template at<T>(row<T>(n));
  }
  template <class T>
  [[nodiscard, gnu::always_inline]] const auto& place(Number n) const {
    return data_.template at<T>(row<T>(n));
  }
  Data data_;
};

}  // namespace stormproof::model
