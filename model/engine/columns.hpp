// How the things of a composition are kept, and how many there are: what follows from their owners,
// unless a host chooses otherwise in its own `Columns`. A way is chosen by an overload without a
// body, `static way::Prefix column(Known);`, beside `using PlainColumns::column;`.
#pragma once

#include <cstdint>
#include <type_traits>

#include "fsm/composition/reader.hpp"
#include "model/engine/run_state.hpp"
#include "model/engine/ways.hpp"

namespace stormproof::model {

struct PlainColumns {
  template <class T>
  static constexpr auto column(T) {
    if constexpr (IsTimer<T>) {
      return std::conditional_t<T::counted, way::Tokens, way::Nothing>{};
    } else if constexpr (!is_of_descriptors<T>) {
      return way::Cell{};
    } else {
      return std::conditional_t<IsMachine<T>, way::Planes, way::Bits>{};
    }
  }
  static way::InPlanes column(comp::X);

  // Where things are.
  /// How many rows an owner has in all.
  template <comp::Owner owner>
  static std::uint32_t rows(const RunState& run) {
    namespace own = comp::owner;
    static_assert(owner == own::participant || owner == own::pair || owner == own::writer ||
                      owner == own::relation,
                  "only the host can say how many of these there are");
    if (owner == own::participant) return run.topology.participant_count();
    if (owner == own::pair) return run.topology.pair_count();
    if (owner == own::writer) return 2 * run.topology.participant_count();
    return run.topology.relation_count();
  }
  /// Which row is that of number n.
  static std::uint32_t row(comp::Owner, std::uint32_t n, const RunState&) { return n; }

  // What observers and the queue call number n of an owner.
  static constexpr MachineRef::Kind kind(comp::Owner owner) {
    using enum MachineRef::Kind;
    namespace own = comp::owner;
    if (owner == own::participant) return participant;
    if (owner == own::pair) return pair;
    if (owner == own::writer) return writer;
    if (owner == own::control_writer) return control_writer;
    return owner == own::relation ? relation : control_relation;
  }
  static constexpr std::uint32_t subject(comp::Owner, std::uint32_t n) { return n; }
  /// The detail of an event; that of a timer with tokens is the token.
  static constexpr std::uint32_t detail(comp::Owner, std::uint32_t) { return 0; }
  /// The number that an event with such a subject and detail is about.
  static constexpr std::uint32_t number(comp::Owner, const Event& event) { return event.subject; }
};

namespace detail {

template <class T, class Columns>
using WayOf = decltype(Columns::column(T{}));

template <class Way, class Columns>
struct HasWay {
  template <class T>
  static constexpr bool holds = std::is_same_v<WayOf<T, Columns>, Way>;
};
/// It is kept in a row.
template <class Columns>
struct HasPlace {
  template <class T>
  static constexpr bool holds = !is_listed<WayOf<T, Columns>>(
      fsm::TypeList<way::Nothing, way::Elsewhere, way::Planes, way::InPlanes>{});
};

}  // namespace detail

}  // namespace stormproof::model
