// The words in which a composition is stated: what connects the machines. What *exists* are types:
// parts (a machine in its place), timers, extended state, packets, knobs. What *happens* are rules:
// a trigger, whose it is, and a body
//
//   template <class W> static void run(W& w);
//
// over a world `w`, which alone knows stores, queues or solvers. The simulator, the explorer, the
// solver and the recorder are such worlds. A body never uses `if`: it says `w.when(condition,
// body)`, so that a world that records or proves can run every body. Effects happen in the order in
// which they are written.
//
// A world has a domain `W::D` (fsm/domain.hpp) and a place: the indices of what it is about. It
// says
//   w(tag)                     the value of a flag, number, fact, switch, delay or packet field, or
//                              what the host answers
//   w.when(condition, body)    the body happens if the condition holds
//   w.feed(part, on<E>, input) the part's outbox
//   w.feed_each(part, on<E>, input, who) to each descriptor d for which who(d), with input(d); an
//                                        outbox of sets
//   w.set_of(term), w.any(set), w.some(term), w.all(term), w.count(term)   over the descriptors of
//                                        the stream
//   w.some_reader(term), w.count_readers(term), w.some_entry(term)   over the open relations of the
//                                             writer, the entries of the participant
//   w.in(part, state)          the machine is in this state
//   w.set(flag or number, value), w.set_each(flag, term)
//   w.renew(part)              the machine is a new one, in its initial state (of descriptors: all)
//   w.after(delay, timer), w.at(time, timer), w.cancel(timer)
//   w.emit(packet, says(…))
//   w.raise(occasion)          the rule of the occasion runs here and now
//   w.call(procedure, …)       effects that several rules have, stated once, see `Procedure`
//   w.perform(step, …)         a step that is stated by its contract only, see `Opaque`
//   w.for_readers(body)        each open relation of the writer, in the order the host keeps
//   w.for_readers_by_number(body)   the same, in ascending order of the peers
//   w.for_descriptors(term, body)   ascending, those for which the term holds then
//   w.for_queue(body)          the queue of the participant, until it is empty
//   w.for_streams(body), w.for_known_peers(body), w.reverse(body)   announcements
// A term is a function of one descriptor: `[](auto& d) { return !d(X{}); }`; besides `d(tag)` it
// may use `d.in(part, state)`, `d.is_in(set)`, `d.is_subject()` (the world is about this one),
// `d.all_up_to(term)` (it holds for this descriptor and every lower one) and
// `d.some_from_here(term)` (for this one or some higher one).
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "fsm/composition/knobs.hpp"
#include "fsm/composition/owner.hpp"
#include "fsm/reflect.hpp"

namespace stormproof::fsm::composition {

// What there is. ----------------------------------------------------------------------------------

/// A machine in its place: each `owner_` has one.
template <class Machine_, Owner owner_>
struct Part {
  using Machine = Machine_;
  static constexpr Owner owner = owner_;
};

/// Something of its owner that is due later. It may be pending several times; whether it is
/// `counted`, because a rule asks how often, and can be cancelled.
template <Owner owner_, bool counted_ = false>
struct Timer {
  static constexpr Owner owner = owner_;
  static constexpr bool counted = counted_;
};
/// One of a pair or relation that runs at its destination; others do so at the source.
template <Owner owner_>
struct TimerAtDestination : Timer<owner_> {
  using AtDestination = void;
};

/// How often a counted timer of the writer is scheduled, without the time that is happening now.
template <class T>
struct Pending {};

/// State outside the machines: a truth value, or a number. False or 0 at first.
template <Owner owner_>
struct Flag {
  using IsFlag = void;
  static constexpr Owner owner = owner_;
};
template <Owner owner_>
struct Number {
  using IsNumber = void;
  static constexpr Owner owner = owner_;
};

/// What follows from the state, a truth value or a number: `of(w)` is its definition. A world may
/// keep it up to date instead.
struct Fact {};

/// What only the host knows, a truth value or a number: `w(tag)` asks it.
struct Answer {};
struct Amount {};

/// What a packet says of each descriptor of its stream, and of itself, a truth value or a number:
/// the fields that a receiver reads. What is not said is false or 0. A packet may be said to be
/// more than that, which only observers hear.
struct DescriptorField {};
struct PacketField {};
struct PacketNumber {};
template <Owner owner_, class... Fields_>
struct Packet {
  static constexpr Owner owner = owner_;
  using Fields = TypeList<Fields_...>;
};

/// Something that happens to a composition from outside, or that a rule makes happen.
template <Owner owner_>
struct Occasion {
  static constexpr Owner owner = owner_;
};

/// Effects that several rules have: `body(w, …)`.
struct Procedure {};

/// A step that a host may do in its own way. `contract(w, …)` says what it can do, with the effects
/// above and with
///   w.choice("…")               an unknown: it may be so or not
///   w.partition(set, body)      body(part, first) for the parts of some partition of the set, in
///                               order
/// A world without a way of its own runs the contract. A world that is executed beside a run and
/// looks at what that did needs to be told of some steps what they are about:
///   FillsMessage       what the contract emits joins the message that is open, if that goes to the
///                      same readers and has room; otherwise another one, and that is sent
///   SendsMessage       the message that is open is sent
///   SendsBatch         `PlanBatches` has planned it; of which `C` (heartbeat_clock.hpp)
///   ForgetsTopics      it is about the topics of the pair; of which rules (fastdds_life.hpp)
///   LosesAll           it is about all peers, known or not; of which rules (life.hpp)
struct Opaque {};

// When something happens, and the rule for it. ----------------------------------------------------

template <class P>
struct Received {
  using Cause = P;
};
/// The packet has been sent by its source completely.
template <class P>
struct LeftSource {
  using Cause = P;
};
template <class T>
struct Due {
  using Cause = T;
};
template <class O>
struct Happens {
  using Cause = O;
};

/// A rule of its trigger's owner.
template <class Trigger_>
struct Rule {
  using Trigger = Trigger_;
  static constexpr Owner owner = Trigger_::Cause::owner;
};

namespace detail {
template <class Trigger, class Rules>
struct RuleFor;
template <class Trigger, class First, class... Rest>
struct RuleFor<Trigger, TypeList<First, Rest...>> : RuleFor<Trigger, TypeList<Rest...>> {};
template <class Trigger, class First, class... Rest>
requires std::is_same_v<typename First::Trigger, Trigger>
struct RuleFor<Trigger, TypeList<First, Rest...>> {
  using type = First;
};
}  // namespace detail
/// The rule of a composition for a trigger; each has one.
template <class Composition, class Trigger>
using RuleFor = typename detail::RuleFor<Trigger, typename Composition::Rules>::type;

// How effects are written. ------------------------------------------------------------------------

/// An event of a machine, as an argument: `on<reader::DataReceived>`.
template <class E>
struct On {
  using Event = E;
};
template <class E>
inline constexpr On<E> on{};

/// A state of a machine, as an argument: `is<repair::A>`.
template <class S>
struct Is {
  using State = S;
};
template <class S>
inline constexpr Is<S> is{};

/// What a packet says: `says(Says{Initial{}, true}, Says{Listed{}, term})`.
template <class Field_, class Value>
struct Says {
  using Field = Field_;
  Value value;

  constexpr Says(Field_, Value value_) : value{std::move(value_)} {}
};
template <class... Sayings>
constexpr std::tuple<Sayings...> says(Sayings... sayings) {
  return {std::move(sayings)...};
}

/// The term that holds for every descriptor, and the input of events that read none.
inline constexpr auto everyone = [](auto& d) {
  return typename std::remove_cvref_t<decltype(d)>::Bool(true);
};
struct Nothing {
  template <class Input>
  constexpr operator Input() const {
    return {};
  }
};
inline constexpr auto no_input = [](auto&) { return Nothing{}; };

/// Where an effect stands in the source; what identifies it.
struct Site {
  std::string_view file;
  unsigned line = 0;

  [[nodiscard]] static constexpr Site here(const char* file = __builtin_FILE(),
                                           unsigned line = __builtin_LINE()) {
    return {file, line};
  }
  auto operator<=>(const Site&) const = default;
};

/// An outbox field or an event that no rule has a use for, and why: `part`.`name`.
struct Unused {
  std::string_view part;
  std::string_view name;
  std::string_view reason;
};

/// An occasion that no rule raises, or a timer that none starts for the first time, and who does.
struct FromOutside {
  std::string_view name;
  std::string_view reason;
};

/// Calls `f.operator()<T>()` for each type of the list.
template <class F, class... Ts>
constexpr void for_each_type(TypeList<Ts...>, F&& f) {
  (f.template operator()<Ts>(), ...);
}

template <class... Lists>
struct JoinedLists {
  using type = TypeList<>;
};
template <class... As>
struct JoinedLists<TypeList<As...>> {
  using type = TypeList<As...>;
};
template <class... As, class... Bs, class... Rest>
struct JoinedLists<TypeList<As...>, TypeList<Bs...>, Rest...>
    : JoinedLists<TypeList<As..., Bs...>, Rest...> {};
/// One list after the other.
template <class... Lists>
using Joined = typename JoinedLists<Lists...>::type;

}  // namespace stormproof::fsm::composition
