// What every machine is built from: events that carry an input and an outbox, guards and actions
// with one domain-generic body, and a front end for Boost.MSM with the two policies that make a
// machine small and fast (no exceptions, no message queue). Actions only fill the outbox; they
// never process another event, because MSM without a message queue would run it at once and then
// overwrite its result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <boost/mpl/fold.hpp>
#include <boost/mpl/push_back.hpp>
#include <boost/mpl/vector.hpp>
#include <boost/msm/front/functor_row.hpp>
#include <boost/msm/front/state_machine_def.hpp>

#include "fsm/domain.hpp"

namespace stormproof::fsm {

using none = boost::msm::front::none;

/// A row of a transition table: in `Source`, on `Event`, if `Guard` holds, run `Action` and go to
/// `Target`.
template <class Source, class Event, class Target, class Action = none, class Guard = none>
using Row = boost::msm::front::Row<Source, Event, Target, Action, Guard>;

using State = boost::msm::front::state<>;

/// Position of a row in its table, as written.
using RowId = std::uint8_t;
inline constexpr RowId no_row = UINT8_MAX;

/// Base of the events of one machine. `Io` has templates `Input<D>` and `Output<D>`: what guards
/// and actions may read, and what actions may ask for.
template <class Io>
struct Event {
  const typename Io::template Input<Plain>& input;
  typename Io::template Output<Plain>& output;
  mutable RowId row = no_row;  ///< which row fired, once the event is processed
};

/// A guard: `Self::test<D>(input)` is its body.
template <class Self>
struct Guard {
  template <class Event, class Fsm, class Source, class Target>
  bool operator()(const Event& event, Fsm&, Source&, Target&) const {
    return Self::template test<Plain>(event.input);
  }
};

/// An action: `Self::act<D>(input, output)` is its body.
template <class Self>
struct Action {
  template <class Event, class Fsm, class Source, class Target>
  void operator()(const Event& event, Fsm&, Source&, Target&) const {
    Self::template act<Plain>(event.input, event.output);
  }
};

/// A guard that is one flag of the input: `Self::flag(input)`.
template <class Self>
struct Holds : Guard<Self> {
  template <class D>
  static constexpr typename D::Bool test(const auto& in) {
    return Self::flag(in);
  }
};

/// An action that sets one flag of the output: `Self::flag(output)`.
template <class Self>
struct Sets : Action<Self> {
  template <class D>
  static constexpr void act(const auto&, auto& out) {
    Self::flag(out) = true;
  }
};

template <class G>
struct Not : Guard<Not<G>> {
  template <class D, class Input>
  static constexpr typename D::Bool test(const Input& in) {
    return !G::template test<D>(in);
  }
};

template <class... Gs>
struct All : Guard<All<Gs...>> {
  template <class D, class Input>
  static constexpr typename D::Bool test(const Input& in) {
    return (Gs::template test<D>(in) && ...);
  }
};

namespace detail {
/// The action of row K: it leaves the row's number in the event, because MSM does not tell a row
/// that leads back to its state from no row at all.
template <RowId K, class A>
struct Fires {
  template <class Event, class Fsm, class Source, class Target>
  void operator()(const Event& event, Fsm& fsm, Source& source, Target& target) const {
    event.row = K;
    if constexpr (!std::is_same_v<A, none>) A{}(event, fsm, source, target);
  }
};

template <RowId K, class R>
struct NumberedRow : Row<typename R::Source, typename R::Evt, typename R::Target,
                         Fires<K, typename R::Action>, typename R::Guard> {
  using AsWritten = R;
};

template <class Sequence, class... Rows>
struct Append {
  using type = Sequence;
};
template <class Sequence, class First, class... Rest>
struct Append<Sequence, First, Rest...>
    : Append<typename boost::mpl::push_back<Sequence, First>::type, Rest...> {};
template <class Numbers, class... Rows>
struct Numbered;
template <std::size_t... Ks, class... Rows>
struct Numbered<std::index_sequence<Ks...>, Rows...>
    : Append<boost::mpl::vector<>, NumberedRow<static_cast<RowId>(Ks), Rows>...> {
  static_assert(sizeof...(Rows) < no_row);
};
}  // namespace detail

/// The MPL sequence of rows that MSM wants. `mpl::vector<…>` itself ends at 20 rows; this does not.
template <class... Rows>
using Table = typename detail::Numbered<std::make_index_sequence<sizeof...(Rows)>, Rows...>::type;

/// Base of every machine.
template <class Self>
struct FrontEnd : boost::msm::front::state_machine_def<Self> {
  using no_exception_thrown = int;
  using no_message_queue = int;

  /// A pair that has no row changes nothing; specs/ignored-pairs.yaml lists these pairs with their
  /// reasons.
  template <class Fsm, class Event>
  void no_transition(const Event&, Fsm&, int) {}
};

}  // namespace stormproof::fsm
