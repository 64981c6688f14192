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

#include <string>
#include <tuple>
#include <type_traits>

#include <boost/pfr.hpp>

#include "checker/engines/promela/promela_place.hpp"
#include "model/engine/composition_knobs.hpp"
#include "model/mutation.hpp"

namespace stormproof::promela {

/// Whether DATA and the like are at their source for a while, because a rule waits for them to
/// leave it.
template <class Composition, class P>
inline constexpr bool leaves_later = []<class... Rs>(fsm::TypeList<Rs...>) {
  return (std::is_same_v<typename Rs::Trigger, composition::LeftSource<P>> || ...);
}(typename Composition::Exchange{});

template <class Composition_>
class PromelaWorld : public PromelaPlace {
 public:
  using Composition = Composition_;
  using D = Written;
  using Bool = Truth;
  using Int = Number;
  using Set = Lanes;
  static constexpr composition::Owner place = composition::owner::relation;

  PromelaWorld(Script& script, const model::DdsProfile& dds, const model::Mutation& mistakes,
               int descriptor = 0)
      : PromelaPlace{script, mistakes.tables, descriptor}, dds_{&dds} {}

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

 private:
  template <class Body>
  void each(Body&& body) {
    for (unsigned d = 0; d < script_->descriptors(); ++d) {
      PromelaWorld world = *this;
      world.descriptor_ = static_cast<int>(d);
      body(world);
    }
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

  const model::DdsProfile* dds_;
  Script* ours_ = nullptr;  ///< in the other direction: the model
};

}  // namespace stormproof::promela
