// The world that derives: it runs the rules of a composition over solver expressions, for one
// generic descriptor, once for us and once for every kind of other, and makes each a step of a
// transition system (checker/engines/tables/derivation.hpp says by which rules). See
// fsm/composition/vocabulary.hpp for what a world is. Delays play no part unless time does
// (checker/engines/tables/derived_time.hpp). What only a host knows is unknown, and so are numbers,
// but for those of our place that were declared before.
#pragma once

#include <type_traits>

#include "checker/engines/tables/derived_packets.hpp"
#include "checker/engines/tables/derived_place.hpp"
#include "checker/engines/tables/derived_timers.hpp"

namespace stormproof::tables {

template <class Composition_>
class DerivedWorld : public DerivedPlace {
 public:
  using Composition = Composition_;
  /// Where rules for which that matters stand: those with a mistake that reaches other readers.
  static constexpr composition::Owner place = composition::owner::relation;
  using Set = Bool;  ///< whether our descriptor is in it

  using DerivedPlace::DerivedPlace;

  // Values.
  template <class Tag>
  auto operator()(Tag tag) {
    using namespace composition;
    if constexpr (std::derived_from<Tag, Switch>) {
      return knob<Bool>(tag);
    } else if constexpr (std::derived_from<Tag, Delay>) {
      // That of a deployment is no knob of the profile.
      if constexpr (model::is_knob<Tag>) return knob<Int>(tag);
      return Int{derivation().unknown_count()};
    } else if constexpr (std::derived_from<Tag, Fact>) {
      return Tag::of(*this);
    } else if constexpr (requires { typename Tag::IsFlag; }) {
      return is_foreign(Tag::owner) ? unknown() : Bool{derivation().now(tag_name<Tag>())};
    } else if constexpr (requires { typename Tag::IsNumber; }) {
      if (!is_foreign(Tag::owner) && derivation().has(tag_name<Tag>())) {
        return Int{derivation().now(tag_name<Tag>())};
      }
      return Int{derivation().unknown_count()};
    } else if constexpr (std::derived_from<Tag, PacketNumber>) {
      return Int{derivation().unknown_count()};
    } else if constexpr (std::derived_from<Tag, DescriptorField> ||
                         std::derived_from<Tag, PacketField>) {
      const bool of_descriptor = std::derived_from<Tag, DescriptorField>;
      if (of_descriptor && is_foreign({composition::owner::descriptor_index})) return unknown();
      const auto said = packet_->find(tag_name<Tag>());  // what it has no field for is not said
      return said == packet_->end() ? Bool{false} : Bool{said->second};
    } else if constexpr (std::derived_from<Tag, Amount>) {
      if (std::is_same_v<Tag, Now> && derived_->time != nullptr) return Int{derived_->time->now()};
      return Int{derivation().unknown_count()};
    } else {
      static_assert(std::derived_from<Tag, Answer>);
      return unknown();
    }
  }
  template <class T>
  Int operator()(composition::Pending<T>) {
    if (is_foreign(T::owner)) return Int{derivation().unknown_count()};
    return Int{derivation().now(DerivedTimer<T>{*derived_}.counter())};
  }
  template <class P, class S>
  Bool in(P, composition::Is<S>) {
    constexpr auto state = fsm::Reflect<typename P::Machine>::template id<S>;
    return is_foreign(P::owner) ? unknown() : Bool{derivation().now(state_name<P>(state))};
  }
  static Bool is_in(const Set& set) { return set; }
  [[nodiscard]] Bool is_subject() const { return Bool{subject_is_ours_}; }
  Bool choice(const char*) { return unknown(); }

  // Quantifiers: ours, or an unknown.
  Bool any(const Set& set) { return or_others(set); }
  template <class Term>
  Set set_of(Term&& term) {
    DerivedWorld d = ours(composition::owner::descriptor_index);
    return Set{term(d)};
  }
  template <class Term>
  Bool some(Term&& term) {
    return or_others(set_of(term));
  }
  template <class Term>
  Bool all(Term&& term) {
    return !or_others(!set_of(term));
  }
  template <class Term>
  Int count(Term&& term) {
    const Expr own = set_of(term).expr();
    if (derivation().number()) return Int{derivation().count_of_first(own)};
    return with_others(own);
  }
  template <class Term>
  Bool some_reader(Term&& term) {
    DerivedWorld r = ours(composition::owner::peer_index);
    return or_others(r(typename Composition::IsOpen{}) && Bool{term(r)});
  }
  template <class Term>
  Int count_readers(Term&& term) {
    DerivedWorld r = ours(composition::owner::peer_index);
    return with_others((r(typename Composition::IsOpen{}) && Bool{term(r)}).expr());
  }
  template <class Term>
  Bool some_entry(Term&& term) {
    DerivedWorld e = ours(composition::owner::stream_index | composition::owner::descriptor_index);
    return or_others(Bool{term(e)});
  }
  /// Of our descriptor, and all below it.
  template <class Term>
  Bool all_up_to(Term&& term) {
    return Bool{term(*this)} && unknown();
  }
  template <class Term>
  Bool some_from_here(Term&& term) {
    return or_others(Bool{term(*this)});
  }

  // Conditions and loops.
  template <class Body>
  void when(const Bool& condition, Body&& body) {
    const Expr outer = path_;
    path_ = (path_ && condition.expr()).simplify();
    if (derived_->happens || !path_.is_false()) body();
    path_ = outer;
  }
  template <class Body>
  void for_readers_by_number(Body&& body) {
    for_readers(body);
  }
  template <class Body>
  void for_readers(Body&& body) {
    around(composition::owner::peer_index,
           [&](DerivedWorld& r) { r.when(r(typename Composition::IsOpen{}), [&] { body(r); }); });
  }
  template <class Body>
  void for_queue(Body&& body) {
    around(composition::owner::stream_index | composition::owner::descriptor_index,
           [&](DerivedWorld& entry) {
             entry.when(entry(typename Composition::IsQueued{}), [&] { body(entry); });
           });
  }
  template <class Term, class Body>
  void for_descriptors(Term&& term, Body&& body) {
    // What is done for one may end the loop for those after it, and differ from what was done
    // before.
    constexpr int different_others = 2;
    around(
        composition::owner::descriptor_index,
        [&](DerivedWorld& d) { d.when(Bool{term(d)}, [&] { body(d); }); }, different_others);
  }
  /// The part that has our descriptor, if the set has it, and others before and after it.
  template <class Body>
  void partition(const Set& set, Body&& body) {
    const unsigned first = derived_->number;
    const auto others = [&] { when(unknown(), [&] { body(Set{false}); }); };
    others();
    again(first, [&] { body(set); });
    again(first, others);
  }
  template <class Body>
  void for_streams(Body&& body) {
    around(composition::owner::stream_index, body);
  }
  template <class Body>
  void for_known_peers(Body&& body) {
    around(composition::owner::peer_index,
           [&](DerivedWorld& peer) { peer.when(unknown(), [&] { body(peer); }); });
  }
  /// Another pair: that of another one may be ours.
  template <class Body>
  void reverse(Body&& body) {
    const Foreign pair = composition::owner::pair.indices;
    const unsigned first = derived_->number;
    DerivedWorld back = *this;
    back.foreign_ = static_cast<Foreign>(foreign_ | pair);
    back.is_reverse_ = (foreign_ & pair) == 0;
    body(back);
    if ((foreign_ & pair) == 0) return;
    DerivedWorld us = ours(pair);
    us.is_reverse_ = false;
    again(first, [&] { us.when(unknown(), [&] { body(us); }); });
  }

  // Effects.
  template <class P, class E>
  auto feed(P, composition::On<E>, const typename P::Machine::Io::template Input<D>& input = {}) {
    effect();
    return step<P, E>(path_, input);
  }
  template <class P, class E, class Input = decltype(composition::no_input),
            class Who = decltype(composition::everyone)>
  auto feed_each(P, composition::On<E>, Input input = {}, Who who = {}) {
    DerivedWorld d = ours(composition::owner::descriptor_index);
    const typename P::Machine::Io::template Input<D> in = input(d);
    const Expr when = (path_ && Bool{who(d)}.expr()).simplify();
    derived_->effect(when, d.foreign_ == 0);
    return d.template step<P, E>(when, in);
  }
  /// The machines of this place, of all descriptors, are new ones.
  template <class P>
  void renew(P) {
    effect();
    const DerivedWorld d = ours(composition::owner::descriptor_index);
    if (!d.is_foreign(P::owner)) d.template start_anew<P>(path_);
  }
  template <class V, class Value>
  void set(V, const Value& value) {
    effect();
    assign<V>(value);
  }
  template <class V, class Term>
  void set_each(V, Term&& term) {
    effect();
    DerivedWorld d = ours(composition::owner::descriptor_index);
    d.template assign<V>(Bool{term(d)});
  }
  template <class Wait, class T>
  void after(Wait wait, T) {
    effect();
    if (is_foreign(T::owner)) return;
    DerivedTimer<T> timer{*derived_};
    if (derived_->time == nullptr) return timer.started(path_, {});
    timer.started(path_, Int{derived_->time->now()} + (*this)(wait));
  }
  template <class T>
  void at(const Int& due, T) {
    effect();
    if (!is_foreign(T::owner)) DerivedTimer<T>{*derived_}.started(path_, due);
  }
  template <class T>
  void cancel(T) {
    effect();
    if (!is_foreign(T::owner)) DerivedTimer<T>{*derived_}.cancelled(path_);
  }
  template <class P, class... Sayings>
  void emit(P, const std::tuple<Sayings...>& sayings) {
    effect();
    if (is_foreign(P::owner)) return;
    DerivedPacket<P>{*derived_}.emitted(path_, contents<P>(sayings));
  }
  /// What the packet would say now; fields that it says nothing of are missing.
  template <class P, class... Sayings>
  Says contents(const std::tuple<Sayings...>& sayings) {
    Says says;
    DerivedWorld d = ours(composition::owner::descriptor_index);
    std::apply([&](const auto&... each) { (d.say(says, each), ...); }, sayings);
    return says;
  }
  template <class O>
  void raise(O) {
    effect();
    if (derived_->happens && !is_foreign(O::owner)) {
      derivation().assign("raised " + tag_name<O>(), path_, Bool{true}.expr());
    }
    const std::string back = raised_back(tag_name<O>());
    if (is_reverse_ && !is_foreign(without_pair(O::owner)) && derivation().has(back)) {
      derivation().assign(back, path_, Bool{true}.expr());
    }
  }
  template <class P, class... Args>
  void call(P, const Args&... args) {
    effect();
    aside<P, Args...>([&] { P::body(*this, args...); });
  }
  template <class Step, class... Args>
  void perform(Step, const Args&... args) {
    effect();
    aside<Step, Args...>([&] { Step::contract(*this, args...); });
  }

  // Triggers: what makes the rule possible for us.
  template <class Trigger>
  void trigger() {
    trigger_of(Trigger{});
  }

 private:
  /// The same place, but with our own of these indices.
  DerivedWorld ours(Foreign indices) const {
    DerivedWorld world = *this;
    world.foreign_ = static_cast<Foreign>(foreign_ & ~indices);
    return world;
  }
  /// The body for others of each index, so many times, for us, and for others again.
  template <class Body>
  void around(Foreign indices, Body&& body, int times = 1) {
    const auto run = [&](Foreign foreign) {
      DerivedWorld world = *this;
      world.foreign_ = foreign;
      world.is_reverse_ = is_reverse_ && (foreign & indices) == 0 &&
                          (indices & composition::owner::pair.indices) == 0;
      if ((indices & composition::owner::descriptor_index) != 0) {
        world.subject_is_ours_ = (foreign & indices) == 0;
      }
      if (foreign != (foreign_ & ~indices)) {
        world.when(unknown(), [&] { body(world); });
      } else {
        body(world);
      }
    };
    const auto us = static_cast<Foreign>(foreign_ & ~indices);
    const unsigned first = derived_->number;
    const auto others = [&] {
      if (derivation().is(Unsound::loops_for_us_only)) return;
      for (int k = 0; k < times; ++k)
        for (Foreign index = 1; index != 0 && index <= indices;
             index = static_cast<Foreign>(index << 1)) {
          if ((indices & index) != 0) again(first, [&] { run(static_cast<Foreign>(us | index)); });
        }
    };
    others();
    again(first, [&] { run(us); });
    others();
  }

  template <class F, class Value>
  void say(Says& says, const composition::Says<F, Value>& saying) {
    if constexpr (std::derived_from<F, composition::PacketNumber>) {
      return;
    } else if constexpr (std::is_same_v<Value, Bool>) {
      says.insert_or_assign(tag_name<F>(), saying.value.expr());
    } else {
      says.insert_or_assign(tag_name<F>(), Bool{saying.value(*this)}.expr());
    }
  }

  /// What a packet that arrives says, whether at ours or at another relation.
  template <class P>
  void arrives() {
    const DerivedPacket<P> packet{*derived_};
    Says says = packet.inputs();
    if (!is_foreign(P::owner)) {
      if (derived_->mistakes.live_bitmaps && std::is_same_v<P, typename Composition::AckNack>) {
        packet.arrives_as(says, contents<P>(Composition::bitmap()));
      } else {
        packet.arrives(says);
      }
      if (derived_->received) derived_->received(tag_name<P>(), says);
    }
    packet_ = std::move(says);
  }
  template <class P>
  void trigger_of(composition::Received<P>) {
    arrives<P>();
    if (derived_->time == nullptr || is_foreign(P::owner)) return;
    derived_->time->arrived(tag_name<P>(), *packet_);
  }
  template <class P>
  void trigger_of(composition::LeftSource<P>) {
    arrives<P>();
    if (derived_->time == nullptr || is_foreign(P::owner)) return;
    derived_->time->left(tag_name<P>(), *packet_);
  }
  template <class T>
  void trigger_of(composition::Due<T>) {
    if (!is_foreign(T::owner)) DerivedTimer<T>{*derived_}.fires();
  }
  template <class O>
  void trigger_of(composition::Happens<O>) {
    if (!derived_->happens || is_foreign(O::owner) || comes_from_outside<O, Composition>()) return;
    derivation().require(derivation().now("raised " + tag_name<O>()));
  }
};

}  // namespace stormproof::tables