// The world that writes Promela: it runs a rule once, for one relation, and every effect becomes a
// statement. See fsm/composition/vocabulary.hpp for what a world is. Loops over descriptors are
// unrolled; the only reader of the writer is ours, if it is open, and its queue has only our
// entries. Steps that are stated by their contracts happen by their contracts, with one packet for
// each descriptor.
//
// What is left out, and what that means:
//   * times: a timer is pending or not, and may be due at any time, which covers all delays. Of
//     several pending ones of a kind one is kept (those that a rule counts are counted), as of
//     several equal packets on their way: executions in which the second one finds something to do
//     that the first has not done are not in the model.
//   * what only a host decides (`Answer`, `choice`) is no: the run goes on after completion, no
//     HEARTBEAT rides in DATA or follows it because a budget is used up.
//   * numbers, which only times depend on under the periodic policy.
// A rule that would decide by a time is an error, not another model (std::logic_error); so is one
// that decides by what it has changed itself since it read it, as a mistake at an effect can make
// it.
#pragma once

#include <cctype>
#include <string>
#include <tuple>
#include <type_traits>

#include <boost/pfr.hpp>

#include "checker/engines/promela/script.hpp"
#include "checker/engines/promela/table_macros.hpp"
#include "model/engine/composition_knobs.hpp"
#include "model/mutation.hpp"

namespace stormproof::promela {

namespace composition = fsm::composition;

/// A single letter is written small, because X and U are operators of the claims.
template <class T>
std::string name() {
  std::string text{fsm::name_of<T>()};
  if (text.size() == 1) text[0] = static_cast<char>(std::tolower(text[0]));
  return text;
}

/// Whether a descriptor has one, so that it is a bit or an element of something.
template <class T>
inline constexpr bool of_descriptors = (T::owner.indices & composition::owner::descriptor_index) !=
                                       0;

/// Whether DATA and the like are at their source for a while, because a rule waits for them to
/// leave it.
template <class Composition, class P>
inline constexpr bool leaves_later = []<class... Rs>(fsm::TypeList<Rs...>) {
  return (std::is_same_v<typename Rs::Trigger, composition::LeftSource<P>> || ...);
}(typename Composition::Exchange{});

template <class Composition_>
class PromelaWorld {
 public:
  using Composition = Composition_;
  using D = Written;
  using Bool = Truth;
  using Int = Number;
  using Set = Lanes;
  static constexpr composition::Owner place = composition::owner::relation;

  PromelaWorld(Script& script, const model::DdsProfile& dds, const model::Mutation& mistakes,
               int descriptor = 0)
      : script_{&script},
        dds_{&dds},
        mistakes_{&mistakes},
        descriptor_{descriptor},
        subject_{descriptor} {}

  // Values.
  template <class Tag>
  auto operator()(Tag tag) {
    using namespace composition;
    if constexpr (std::derived_from<Tag, Switch>) {
      return Truth{model::knob_value(tag, *dds_)};
    } else if constexpr (std::derived_from<Tag, Delay>) {
      return Number{model::knob_value(tag, *dds_)};
    } else if constexpr (std::derived_from<Tag, Fact>) {
      return Tag::of(*this);
    } else if constexpr (requires { typename Tag::IsFlag; }) {
      return flag<Tag>();
    } else if constexpr (std::derived_from<Tag, DescriptorField>) {
      return field(name<Tag>(), true);
    } else if constexpr (std::derived_from<Tag, PacketField>) {
      return field(name<Tag>(), false);
    } else if constexpr (std::derived_from<Tag, Answer>) {
      return Truth{false};
    } else {
      return Number::unknown();
    }
  }
  template <class T>
  Number operator()(composition::Pending<T>) {
    return script_->is_found("due " + name<T>()) ? script_->number(name<T>()) : Number{0};
  }
  template <class P, class S>
  Truth in(P, composition::Is<S>) {
    declare<P>();
    return script_->equals(state<P>(), TableMacros<typename P::Machine>::state(fsm::name_of<S>()));
  }
  [[nodiscard]] Truth is_in(const Set& set) const {
    return set.of.empty() ? Truth{false} : set.of[static_cast<std::size_t>(descriptor_)];
  }
  [[nodiscard]] Truth is_subject() const { return descriptor_ == subject_; }
  static Truth choice(const char*) { return false; }

  // Quantifiers.
  static Truth any(const Set& set) { return set.any(); }
  template <class Term>
  Set set_of(Term&& term) {
    Set set;
    each([&](PromelaWorld& d) { set.of.push_back(Truth{term(d)}); });
    return set;
  }
  template <class Term>
  Truth some(Term&& term) {
    return set_of(term).any();
  }
  template <class Term>
  Truth all(Term&& term) {
    return !some([&](auto& d) { return !Truth{term(d)}; });
  }
  template <class Term>
  Number count(Term&& term) {
    Number total;
    for (const Truth& lane : set_of(term).of) total = total + Number::of(lane);
    return total;
  }
  template <class Term>
  Truth some_reader(Term&& term) {
    return (*this)(typename Composition::IsOpen{}) && Truth{term(*this)};
  }
  template <class Term>
  Truth some_entry(Term&& term) {
    return some(term);
  }
  template <class Term>
  Truth all_up_to(Term&& term) {
    Truth all = true;
    each([&](PromelaWorld& d) { all = all && (d.descriptor_ > descriptor_ || Truth{term(d)}); });
    return all;
  }
  template <class Term>
  Truth some_from_here(Term&& term) {
    Truth some;
    each([&](PromelaWorld& d) { some = some || (d.descriptor_ >= descriptor_ && Truth{term(d)}); });
    return some;
  }

  // Conditions and loops.
  template <class Body>
  void when(const Truth& condition, Body&& body) {
    script_->when(condition, body);
  }
  template <class Body>
  void for_readers_by_number(Body&& body) {
    for_readers(body);
  }
  template <class Body>
  void for_readers(Body&& body) {
    when((*this)(typename Composition::IsOpen{}), [&] { body(*this); });
  }
  template <class Body>
  void for_streams(Body&& body) {
    body(*this);
  }
  /// What happens in the other direction of the pair is no part of the model; what happens in its
  /// other direction is.
  template <class Body>
  void reverse(Body&& body) {
    PromelaWorld back = *this;
    Script discarded = *script_;
    back.script_ = ours_ != nullptr ? ours_ : &discarded;
    back.ours_ = ours_ != nullptr ? nullptr : script_;
    body(back);
  }
  template <class Body>
  void for_queue(Body&& body) {
    each([&](PromelaWorld& entry) {
      entry.subject_ = entry.descriptor_;
      entry.when(entry(typename Composition::IsQueued{}), [&] { body(entry); });
    });
  }
  template <class Term, class Body>
  void for_descriptors(Term&& term, Body&& body) {
    each([&](PromelaWorld& d) { d.when(Truth{term(d)}, [&] { body(d); }); });
  }
  template <class Body>
  void partition(const Set& set, Body&& body) {
    each([&](PromelaWorld& d) {
      Set part{std::vector<Truth>(script_->descriptors())};
      part.of[static_cast<std::size_t>(d.descriptor_)] = true;
      when(d.is_in(set), [&] { body(part); });
    });
  }

  // Effects.
  template <class P, class E>
  auto feed(P, composition::On<E>, const typename P::Machine::Io::template Input<D>& input = {}) {
    Table<P> table = cleared<P, E>();
    typename P::Machine::Io::template Output<D> output;
    step<P, E>(table, input);
    for_each_asked<E>(table, output, [&](Truth& field, const std::string& outbox) {
      field = of_descriptors<P> ? script_->bit(outbox, descriptor_) : script_->truth(outbox);
    });
    return output;
  }
  template <class P, class E, class Input = decltype(composition::no_input),
            class Who = decltype(composition::everyone)>
  auto feed_each(P, composition::On<E>, Input input = {}, Who who = {}) {
    Table<P> table = cleared<P, E>();
    typename P::Machine::Io::template Output<LaneDomain> output;
    each([&](PromelaWorld& d) {
      const typename P::Machine::Io::template Input<D> in = input(d);
      d.when(Truth{who(d)}, [&] { d.template step<P, E>(table, in); });
    });
    for_each_asked<E>(table, output, [&](Lanes& field, const std::string& outbox) {
      each([&](PromelaWorld& d) { field.of.push_back(script_->bit(outbox, d.descriptor_)); });
    });
    return output;
  }
  template <class V, class Value>
  void set(V, const Value& value) {
    if constexpr (requires { typename V::IsFlag; }) {
      const Truth to{value};
      if (of_descriptors<V>) {
        Set all = set_of([](auto& d) { return d(V{}); });
        all.of[static_cast<std::size_t>(descriptor_)] = to;
        assign<V>(to, all.bitmap().expression());
      } else {
        assign<V>(to, to.expression());
      }
    }
  }
  template <class V, class Term>
  void set_each(V, Term&& term) {
    const Set set = set_of(term);
    assign<V>(set.any(), set.bitmap().expression());
  }
  template <class Wait, class T>
  void after(Wait, T) {
    start<T>();
  }
  template <class T>
  void at(const Number&, T) {
    start<T>();
  }
  template <class T>
  void cancel(T) {
    if (script_->is_found("due " + name<T>())) script_->assign(name<T>(), Number{0}.expression());
  }
  template <class P, class... Sayings>
  void emit(P, const std::tuple<Sayings...>& sayings) {
    script_->find("sent " + name<P>());
    composition::for_each_type(typename P::Fields{}, [&]<class F>() {
      Number value;
      std::apply([&](const auto&... each) { ((say<F>(value, each)), ...); }, sayings);
      const std::string field = variable_of(name<P>(), name<F>());
      script_->find_said(field, value);
      if (script_->is_kept(field)) script_->assign(field, value.expression());
    });
    script_->send(Store{name<P>(), leaves_later<Composition, P>}.name());
  }
  template <class O>
  void raise(O) {
    composition::RuleFor<Composition, composition::Happens<O>>::run(*this);
  }
  template <class P, class... Args>
  void call(P, const Args&... args) {
    P::body(*this, args...);
  }
  template <class Step, class... Args>
  void perform(Step, const Args&... args) {
    Step::contract(*this, args...);
  }

  /// The part is in the model, in its initial state.
  template <class P>
  void declare() {
    const std::string initial = Table<P>::state(fsm::name_of<typename P::Machine::initial_state>());
    const std::string count =
        of_descriptors<P> ? fmt::format("[{}]", script_->descriptors()) : std::string{};
    script_->define(Table<P>::states());
    script_->declare(fmt::format("byte {}{} = {};\n", name<P>(), count, initial));
  }
  /// The rule is about this packet.
  void look_at(const std::string& packet) { packet_ = packet; }

 private:
  template <class P>
  using Table = TableMacros<typename P::Machine>;

  template <class Body>
  void each(Body&& body) {
    for (unsigned d = 0; d < script_->descriptors(); ++d) {
      PromelaWorld world = *this;
      world.descriptor_ = static_cast<int>(d);
      body(world);
    }
  }

  // Flags, timers and packets.
  template <class V>
  Truth flag() {
    if (!script_->is_found("set " + name<V>())) return false;
    return of_descriptors<V> ? script_->bit(name<V>(), descriptor_) : script_->truth(name<V>());
  }
  template <class V>
  void assign(const Truth& may_hold, const Expression& value) {
    if (!may_hold.is(false)) script_->find("set " + name<V>());
    if (!script_->is_found("set " + name<V>())) return;
    script_->declare((of_descriptors<V> ? "byte " : "bool ") + name<V>() + ";\n");
    script_->assign(name<V>(), value);
  }
  template <class T>
  void start() {
    script_->find("due " + name<T>());
    script_->declare((T::counted ? "byte " : "bool ") + name<T>() + ";  /* pending */\n");
    if constexpr (T::counted) {
      script_->write(fmt::format("assert({} < 255)", name<T>()));  // a byte can count it
      script_->assign(name<T>(), (script_->number(name<T>()) + 1).expression());
    } else {
      script_->assign(name<T>(), Truth{true}.expression());
    }
  }
  [[nodiscard]] Truth field(const std::string& field, bool bitmap) const {
    const std::string variable = variable_of(packet_, field);
    if (!script_->is_said(variable)) return false;
    return bitmap ? script_->bit(variable, descriptor_) : script_->truth(variable);
  }
  template <class F, class G, class Value>
  void say(Number& said, const composition::Says<G, Value>& saying) {
    if constexpr (!std::is_same_v<F, G>) {
      return;
    } else if constexpr (std::derived_from<F, composition::PacketField>) {
      said = Number::of(Truth{saying.value});
    } else if constexpr (std::is_same_v<Value, Truth>) {
      said = set_of([&](auto&) { return saying.value; }).bitmap();
    } else {
      said = set_of(saying.value).bitmap();
    }
  }

  // Machines.
  template <class P>
  [[nodiscard]] std::string state() const {
    return of_descriptors<P> ? fmt::format("{}[{}]", name<P>(), descriptor_) : name<P>();
  }
  /// The part's table, its outbox empty.
  template <class P, class E>
  Table<P> cleared() {
    declare<P>();
    Table<P> table{mistakes_->tables};
    typename P::Machine::Io::template Output<D> output;
    for_each_asked<E>(table, output, [&](Truth&, const std::string& outbox) {
      script_->declare("hidden byte " + outbox + ";\n");
      script_->assign(outbox, Number{0}.expression());
    });
    script_->define(table.macro(fsm::Reflect<typename P::Machine>::template event_id<E>));
    return table;
  }
  template <class P, class E>
  void step(const Table<P>& table, const typename P::Machine::Io::template Input<D>& input) {
    std::string call = fmt::format(
        "{}({}, {}", table.name(fsm::Reflect<typename P::Machine>::template event_id<E>),
        state<P>(), of_descriptors<P> ? descriptor_ : 0);
    for (const Truth& finding : table.template findings<E>(input)) {
      call += ", " + script_->say(finding.expression());
    }
    script_->write(call + ")");
    script_->changed(state<P>());
    typename P::Machine::Io::template Output<D> output;
    for_each_asked<E>(table, output,
                      [&](Truth&, const std::string& outbox) { script_->changed(outbox); });
  }
  /// Visits the fields of an outbox that the event can raise, with their variables.
  template <class E, class Macros, class Output, class Visit>
  static void for_each_asked(const Macros& table, Output& output, Visit&& visit) {
    constexpr auto event = fsm::Reflect<typename Macros::Of>::template event_id<E>;
    boost::pfr::for_each_field(output, [&](auto& field, std::size_t k) {
      if constexpr (std::is_invocable_v<Visit, decltype(field), std::string>) {
        if (table.asks(event, k)) visit(field, table.outbox(k));
      }
    });
  }

  Script* script_;
  const model::DdsProfile* dds_;
  const model::Mutation* mistakes_;
  int descriptor_;
  int subject_;             ///< the descriptor that the rule is about
  Script* ours_ = nullptr;  ///< in the other direction: the model
  std::string packet_;
};

}  // namespace stormproof::promela
