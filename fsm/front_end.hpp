// What every machine is built from: events that carry an input and an outbox, guards and actions
// with one domain-generic body, and a front end for Boost.MSM with the two policies that make a
// machine small and fast (no exceptions, no message queue). Actions only fill the outbox; they
// never process another event, because MSM without a message queue would run it at once and then
// overwrite its result.
#pragma once

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

/// Base of the events of one machine. `Io` has templates `Input<D>` and `Output<D>`: what guards
/// and actions may read, and what actions may ask for.
template <class Io>
struct Event {
  const typename Io::template Input<Plain>& input;
  typename Io::template Output<Plain>& output;
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
template <class Sequence, class... Rows>
struct Append {
  using type = Sequence;
};
template <class Sequence, class First, class... Rest>
struct Append<Sequence, First, Rest...>
    : Append<typename boost::mpl::push_back<Sequence, First>::type, Rest...> {};
}  // namespace detail

/// The MPL sequence of rows that MSM wants. `mpl::vector<…>` itself ends at 20 rows; this does not.
template <class... Rows>
using Table = typename detail::Append<boost::mpl::vector<>, Rows...>::type;

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
