// The world that derives: it runs the rules of a composition over solver expressions, for one
// generic descriptor, once for us and once for every kind of other, and makes each a step of a
// transition system (checker/engines/tables/derivation.hpp says by which rules). See
// fsm/composition/vocabulary.hpp for what a world is. Delays play no part unless time does
// (checker/engines/tables/derived_time.hpp); numbers and what only a host knows are unknowns.
#pragma once

#include <functional>
#include <optional>
#include <type_traits>

#include "checker/engines/tables/derivation.hpp"
#include "checker/engines/tables/derived_time.hpp"
#include "checker/engines/tables/effect_system.hpp"
#include "checker/engines/tables/machine_step.hpp"
#include "model/engine/composition_knobs.hpp"

namespace stormproof::tables {

namespace composition = fsm::composition;

/// What is derived: rules with the mistakes of a mutant, under the knobs of a profile.
struct Derived {
  const model::DdsProfile& dds;
  const model::Mutation& mistakes;
  Derivation& derivation;
  /// Called when our relation's writer or reader emits a packet: its name, when, and what it says
  /// of our descriptor and of itself.
  std::function<void(std::string_view, const Expr&, const std::map<std::string, Expr>&)> emitted{};
  /// Called when a packet arrives at our relation.
  std::function<void(std::string_view, const std::map<std::string, Expr>&)> received{};
  /// Called at the end of each step, with whether an ACKNACK would list our descriptor now.
  std::function<void(const Expr&)> ended{};
  /// Called for each effect at our own place: its id (EffectInfo::id) and when it happens. With it,
  /// all rules are derived, also those that only announce and those of control-only relations, and
  /// occasions only happen once they are raised.
  std::function<void(const std::string&, const Expr&)> happens{};
  /// Called for each knob that is read: what stands for it; without it, the knob's value does.
  std::function<Expr(const Knob&)> knob{};
  /// With it, things under way have deadlines.
  DerivedTime* time = nullptr;

  /// Effects are counted as the recorder does (fsm/composition/recorder.hpp): within a rule,
  /// procedure or step, each once, however often it runs.
  std::string within{};
  unsigned number = 0;
};

template <class T>
std::string tag_name() {
  return std::string{fsm::name_of<T>()};
}

/// Whether something else than the rules causes it, at least for the first time.
template <class T, class Composition>
bool comes_from_outside() {
  return std::ranges::any_of(Composition::from_outside,
                             [](const auto& cause) { return cause.name == fsm::name_of<T>(); });
}

template <class Composition_>
class DerivedWorld {
 public:
  using Composition = Composition_;
  /// Where rules for which that matters stand: those with a mistake that reaches other readers.
  static constexpr composition::Owner place = composition::owner::relation;
  using D = smt::Symbolic;
  using Bool = smt::SymbolicBool;
  using Int = smt::SymbolicInt;
  using Set = Bool;  ///< whether our descriptor is in it

  DerivedWorld(Derived& derived, Foreign foreign)
      : derived_{&derived},
        foreign_{foreign},
        subject_is_ours_{(foreign & composition::owner::descriptor_index) == 0} {}

  // Values.
  template <class Tag>
  auto operator()(Tag tag) {
    using namespace composition;
    if constexpr (std::derived_from<Tag, Switch>) {
      return knob<Bool>(tag);
    } else if constexpr (std::derived_from<Tag, Delay>) {
      return knob<Int>(tag);
    } else if constexpr (std::derived_from<Tag, Fact>) {
      return Tag::of(*this);
    } else if constexpr (requires { typename Tag::IsFlag; }) {
      return is_foreign(Tag::owner) ? unknown() : Bool{derivation().now(tag_name<Tag>())};
    } else if constexpr (requires { typename Tag::IsNumber; }) {
      return Int{derivation().unknown_count()};
    } else if constexpr (std::derived_from<Tag, DescriptorField> ||
                         std::derived_from<Tag, PacketField>) {
      return Bool{packet_->at(tag_name<Tag>())};
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
    return Int{derivation().now(counter<T>())};
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
    const Expr own = number_of(set_of(term).expr());
    if (derivation().is(Unsound::others_never_ask)) return Int{own};
    return Int{own + derivation().unknown_count()};
  }
  template <class Term>
  Bool some_reader(Term&& term) {
    DerivedWorld r = ours(composition::owner::peer_index);
    return or_others(r(typename Composition::IsOpen{}) && Bool{term(r)});
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
    around(composition::owner::descriptor_index,
           [&](DerivedWorld& d) { d.when(Bool{term(d)}, [&] { body(d); }); });
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
    body(back);
    if ((foreign_ & pair) == 0) return;
    DerivedWorld us = ours(pair);
    again(first, [&] { us.when(unknown(), [&] { body(us); }); });
  }

  // Effects.
  template <class P, class E>
  auto feed(P, composition::On<E>, const typename P::Machine::Io::template Input<D>& input = {}) {
    effect(path_);
    return step<P, E>(path_, input);
  }
  template <class P, class E, class Input = decltype(composition::no_input),
            class Who = decltype(composition::everyone)>
  auto feed_each(P, composition::On<E>, Input input = {}, Who who = {}) {
    DerivedWorld d = ours(composition::owner::descriptor_index);
    const typename P::Machine::Io::template Input<D> in = input(d);
    const Expr when = (path_ && Bool{who(d)}.expr()).simplify();
    d.effect(when);
    return d.template step<P, E>(when, in);
  }
  template <class V, class Value>
  void set(V, const Value& value) {
    effect(path_);
    assign<V>(value);
  }
  template <class V, class Term>
  void set_each(V, Term&& term) {
    effect(path_);
    DerivedWorld d = ours(composition::owner::descriptor_index);
    d.template assign<V>(Bool{term(d)});
  }
  template <class Wait, class T>
  void after(Wait wait, T) {
    effect(path_);
    if (derived_->time == nullptr) return start<T>({});
    start<T>(Int{derived_->time->now()} + (*this)(wait));
  }
  template <class T>
  void at(const Int& due, T) {
    effect(path_);
    start<T>(due);
  }
  template <class T>
  void cancel(T) {
    effect(path_);
    if (is_foreign(T::owner)) return;
    const Expr none = Int{0}.expr();
    derivation().assign("pending " + tag_name<T>(), path_, none);
    derivation().assign(counter<T>(), path_, none);
  }
  template <class P, class... Sayings>
  void emit(P, const std::tuple<Sayings...>& sayings) {
    effect(path_);
    if (is_foreign(P::owner)) return;
    const std::map<std::string, Expr> says = contents<P>(sayings);
    if (derived_->emitted) derived_->emitted(tag_name<P>(), path_, says);
    if (derived_->time != nullptr) derived_->time->emitted(tag_name<P>(), path_, says);
    for (const auto& [name, content] : all_contents<P>()) {
      Expr is = path_;
      for (const auto& [field, value] : content) {
        const Expr said = says.contains(field) ? says.at(field) : Bool{}.expr();
        is = is && (value ? said : !said);
      }
      derivation().assign(name, is.simplify(), Bool{true}.expr());
    }
  }
  /// What the packet would say now; fields that it says nothing of are missing.
  template <class P, class... Sayings>
  std::map<std::string, Expr> contents(const std::tuple<Sayings...>& sayings) {
    std::map<std::string, Expr> says;
    DerivedWorld d = ours(composition::owner::descriptor_index);
    std::apply([&](const auto&... each) { (d.say(says, each), ...); }, sayings);
    return says;
  }
  template <class O>
  void raise(O) {
    effect(path_);
    if (derived_->happens && !is_foreign(O::owner)) {
      derivation().assign("raised " + tag_name<O>(), path_, Bool{true}.expr());
    }
  }
  template <class P, class... Args>
  void call(P, const Args&... args) {
    effect(path_);
    aside<P, Args...>([&] { P::body(*this, args...); });
  }
  template <class Step, class... Args>
  void perform(Step, const Args&... args) {
    effect(path_);
    aside<Step, Args...>([&] { Step::contract(*this, args...); });
  }

  // Triggers: what makes the rule possible for us.
  template <class Trigger>
  void trigger() {
    trigger_of(Trigger{});
  }

  // Names of variables.
  template <class P>
  static std::string state_name(std::size_t state) {
    return tag_name<P>() + "=" + std::string{fsm::Reflect<typename P::Machine>::state_names[state]};
  }
  using Content = std::vector<std::pair<std::string, bool>>;
  /// "sent AckNack Listed" and what that packet says, for each content that P can have.
  template <class P>
  static std::vector<std::pair<std::string, Content>> all_contents() {
    std::vector<std::pair<std::string, Content>> all{{"sent " + tag_name<P>(), {}}};
    composition::for_each_type(typename P::Fields{}, [&]<class F>() {
      const std::size_t count = all.size();
      for (std::size_t k = 0; k < count; ++k) {
        all.push_back(all[k]);
        all.back().first += " " + tag_name<F>();
        all.back().second.emplace_back(tag_name<F>(), true);
        all[k].second.emplace_back(tag_name<F>(), false);
      }
    });
    return all;
  }

 private:
  Derivation& derivation() { return derived_->derivation; }
  [[nodiscard]] bool is_foreign(composition::Owner owner) const {
    return (owner.indices & foreign_) != 0;
  }
  Bool unknown() { return Bool{derivation().unknown()}; }
  Bool or_others(const Bool& own) {
    return derivation().is(Unsound::others_never_ask) ? own : own || unknown();
  }
  static Expr number_of(const Expr& condition) {
    return z3::ite(condition, Int{1}.expr(), Int{0}.expr());
  }

  template <class Value, class Tag>
  Value knob(Tag tag) {
    if (!derived_->knob) return Value{model::knob_value(tag, derived_->dds)};
    return Value{derived_->knob({tag_name<Tag>(), [tag](const model::DdsProfile& dds) {
                                   return Value{model::knob_value(tag, dds)}.expr();
                                 }})};
  }

  /// An effect happens here `when`.
  void effect(const Expr& when) {
    if (!derived_->happens) return;
    const std::string id = derived_->within + "." + std::to_string(++derived_->number);
    if (foreign_ == 0) derived_->happens(id, when);
  }
  /// The same effects once more, from number `first` on.
  template <class Body>
  void again(unsigned first, Body&& body) {
    derived_->number = first;
    body();
  }
  /// The effects of a procedure or step, which is named like in the recorder.
  template <class P, class... Args, class Body>
  void aside(Body&& body) {
    if (!derived_->happens) return body();
    std::string name = tag_name<P>();
    [[maybe_unused]] const auto add = [&]<class Arg>() {
      if constexpr (std::is_empty_v<Arg>) name += " " + tag_name<Arg>();
    };
    (add.template operator()<Args>(), ...);
    std::swap(derived_->within, name);
    const unsigned number = std::exchange(derived_->number, 0);
    body();
    derived_->within = name;
    derived_->number = number;
  }
  template <class V, class Value>
  void assign(const Value& value) {
    if constexpr (requires { typename V::IsFlag; }) {
      if (!is_foreign(V::owner)) derivation().assign(tag_name<V>(), path_, Bool{value}.expr());
    }
  }

  /// The same place, but with our own of these indices.
  DerivedWorld ours(Foreign indices) const {
    DerivedWorld world = *this;
    world.foreign_ = static_cast<Foreign>(foreign_ & ~indices);
    return world;
  }
  /// The body for others of each index, for us, and for others again.
  template <class Body>
  void around(Foreign indices, Body&& body) {
    const auto run = [&](Foreign foreign) {
      DerivedWorld world = *this;
      world.foreign_ = foreign;
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
      for (Foreign index = 1; index != 0 && index <= indices;
           index = static_cast<Foreign>(index << 1)) {
        if ((indices & index) != 0) again(first, [&] { run(static_cast<Foreign>(us | index)); });
      }
    };
    others();
    again(first, [&] { run(us); });
    others();
  }

  template <class P, class E>
  auto step(const Expr& when, const typename P::Machine::Io::template Input<D>& input) {
    using Step = MachineStep<typename P::Machine>;
    const Step machine{derived_->mistakes.tables};
    OneHot before;
    for (std::size_t k = 0; k < Step::states; ++k) {
      before.push_back(is_foreign(P::owner) ? derivation().unknown()
                                            : derivation().now(state_name<P>(k)));
    }
    const auto effect = machine.template step<E>(before, input, when);
    if (!is_foreign(P::owner)) {
      for (std::size_t k = 0; k < Step::states; ++k) {
        derivation().now(state_name<P>(k)) = effect.next[k];
      }
    }
    return effect.outbox();
  }

  /// How often T is scheduled, as the rules count: a variable of its own only if a mistake makes
  /// that differ from how often it is in the queue.
  template <class T>
  [[nodiscard]] std::string counter() const {
    return (copies<T>() == 1 ? "pending " : "counted ") + tag_name<T>();
  }
  /// How many events get into the queue when one is scheduled: 1 without a mistake.
  template <class T>
  [[nodiscard]] int copies() const {
    int copies = 1;
    for (const model::EventMutation& mistake : derived_->mistakes.events) {
      if (mistake.kind != model::event_kind_of<T>) continue;
      if (mistake.change == model::EventMutation::Change::forget) copies = 0;
      if (mistake.change == model::EventMutation::Change::duplicate) copies = 2;
    }
    return copies;
  }
  /// How much later than the rules say, ns: 0 without a mistake.
  template <class T>
  [[nodiscard]] Int late() const {
    Int late = 0;
    for (const model::EventMutation& mistake : derived_->mistakes.events) {
      if (mistake.kind != model::event_kind_of<T>) continue;
      if (mistake.change == model::EventMutation::Change::shift) late = mistake.by.count();
    }
    return late;
  }
  template <class T>
  void start(const Int& due) {
    if (is_foreign(T::owner)) return;
    const std::string pending = "pending " + tag_name<T>();
    if (derived_->time != nullptr && copies<T>() > 0) {
      derived_->time->started(tag_name<T>(), path_, (due + late<T>()).expr());
    }
    if constexpr (T::counted) {
      derivation().assign(pending, path_, derivation().now(pending) + copies<T>());
      if (counter<T>() != pending) {
        derivation().assign(counter<T>(), path_, derivation().now(counter<T>()) + 1);
      }
    } else if (copies<T>() > 0) {
      derivation().assign(pending, path_, Bool{true}.expr());
      derivation().assign("started " + tag_name<T>(), path_, Bool{true}.expr());
    }
  }

  template <class F, class Value>
  void say(std::map<std::string, Expr>& says, const composition::Says<F, Value>& saying) {
    if constexpr (std::is_same_v<Value, Bool>) {
      says.insert_or_assign(tag_name<F>(), saying.value.expr());
    } else {
      says.insert_or_assign(tag_name<F>(), Bool{saying.value(*this)}.expr());
    }
  }

  template <class P>
  void arrives() {
    std::map<std::string, Expr> says;
    composition::for_each_type(typename P::Fields{}, [&]<class F>() {
      says.emplace(tag_name<F>(), derivation().input(tag_name<F>()));
    });
    if (!is_foreign(P::owner)) {
      Exprs cases;
      for (const auto& [name, content] : all_contents<P>()) {
        Expr is = derivation().now(name);
        for (const auto& [field, value] : content) {
          is = is && (value ? says.at(field) : !says.at(field));
        }
        cases.push_back(is);
      }
      if (derived_->mistakes.live_bitmaps && std::is_same_v<P, typename Composition::AckNack>) {
        read_live(says);
      } else {
        derivation().require(any_of(cases));
      }
      if (derivation().is(Unsound::packets_arrive_once)) {
        for (const auto& content : all_contents<P>()) {
          derivation().now(content.first) = Bool{false}.expr();
        }
      }
      if (derived_->received) derived_->received(tag_name<P>(), says);
    }
    packet_ = says;
  }
  /// The mistake of a bitmap that is read when it arrives: some ACKNACK has been sent, and says
  /// what
  /// it would say now.
  void read_live(const std::map<std::string, Expr>& says) {
    using AckNack = typename Composition::AckNack;
    const std::string initial = tag_name<composition::IsInitial>();
    Exprs cases;
    for (const auto& [name, content] : all_contents<AckNack>()) {
      const bool is_initial = std::ranges::find(content, std::pair{initial, true}) != content.end();
      cases.push_back(derivation().now(name) &&
                      (is_initial ? says.at(initial) : !says.at(initial)));
    }
    derivation().require(any_of(cases));
    for (const auto& [field, value] : contents<AckNack>(Composition::bitmap())) {
      if (field != initial) derivation().require(says.at(field) == value);
    }
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
    if (is_foreign(T::owner)) return;
    const std::string pending = "pending " + tag_name<T>();
    if (derived_->time != nullptr) derived_->time->fires(tag_name<T>());
    if constexpr (T::counted) {
      derivation().require(derivation().now(pending) >= 1);
      derivation().now(pending) = derivation().now(pending) - 1;
      if (counter<T>() != pending) {
        Expr& counted = derivation().now(counter<T>());
        counted = z3::ite(counted > 0, counted - 1, counted);
      }
    } else {
      derivation().require(derivation().now("started " + tag_name<T>()));
      derivation().now(pending) = Bool{false}.expr();  // nothing is surely pending any more
    }
  }
  template <class O>
  void trigger_of(composition::Happens<O>) {
    if (!derived_->happens || is_foreign(O::owner) || comes_from_outside<O, Composition>()) return;
    derivation().require(derivation().now("raised " + tag_name<O>()));
  }

 private:
  Derived* derived_;
  Foreign foreign_;
  bool subject_is_ours_;  ///< of a place that is about one descriptor
  Expr path_ = Bool{true}.expr();
  std::optional<std::map<std::string, Expr>> packet_;
};

}  // namespace stormproof::tables
