// A world around another one, which tells a watcher of each effect before it happens, and makes its
// mistake at one of them (fsm/composition/trail.hpp). A run without a watcher has none of this.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>

#include "fsm/composition/heartbeat_clock.hpp"
#include "fsm/composition/reader.hpp"
#include "fsm/composition/trail.hpp"

namespace stormproof::fsm::composition {

/// Who watches the effects of a run.
class Watcher {
 public:
  using Change = EffectMutation::Change;

  virtual ~Watcher() = default;
  /// The effect is about to happen.
  virtual void happens(EffectKey) {}
  /// A condition is about to be decided.
  virtual void decides(EffectKey, bool /*holds*/) {}
  /// What to do wrong at the effect, condition or loop.
  [[nodiscard]] virtual Change change_of(EffectKey) const { return Change::none; }

  /// An effect that comes after the next one.
  void defer(std::function<void()> effect) { deferred_ = std::move(effect); }
  /// An effect has happened, or the rule is over.
  void go_on() {
    if (deferred_) std::exchange(deferred_, nullptr)();
  }

 private:
  std::function<void()> deferred_;
};

/// The name of an argument that is a tag; of another one, nothing.
template <class Arg>
std::string_view name_of_tag() {
  if constexpr (std::is_empty_v<Arg>) return name_of<Arg>();
  return {};
}
/// The name of a procedure, with the argument that makes it another one.
template <class P, class... Args>
std::string scope_of() {
  std::string text{name_of<P>()};
  for (const std::string_view tag : {std::string_view{}, name_of_tag<Args>()...}) {
    if (!tag.empty()) text.append(" ").append(tag);
  }
  return text;
}

template <class W>
class WatchedWorld {
 public:
  using D = typename W::D;
  using Bool = typename W::Bool;
  using Int = typename W::Int;
  using Set = typename W::Set;
  using Composition = typename W::Composition;
  using Change = EffectMutation::Change;

  WatchedWorld(const W& world, Watcher& watcher, const Trail& trail)
      : world_{world}, watcher_{&watcher}, trail_{trail} {}

  // Values.
  template <class Tag>
  auto operator()(Tag tag) {
    return world_(tag);
  }
  template <class P, class S>
  auto in(P part, Is<S> state) {
    return world_.in(part, state);
  }
  auto any(const Set& set) { return world_.any(set); }
  template <class Term>
  auto set_of(Term&& term) {
    return world_.set_of(term);
  }
  template <class Term>
  auto some(Term&& term) {
    return world_.some(term);
  }
  template <class Term>
  auto all(Term&& term) {
    return world_.all(term);
  }
  template <class Term>
  auto count(Term&& term) {
    return world_.count(term);
  }
  template <class Term>
  auto some_reader(Term&& term) {
    return world_.some_reader(term);
  }
  template <class Term>
  auto count_readers(Term&& term) {
    return world_.count_readers(term);
  }
  template <class Term>
  auto some_entry(Term&& term) {
    return world_.some_entry(term);
  }

  // Conditions and loops.
  template <class Body>
  void when(const Bool& condition, Body&& body, Site site = Site::here()) {
    const Trail outer = std::exchange(trail_, trail_.inside(site));
    const EffectKey key = trail_.key("when");
    watcher_->decides(key, condition);
    const Change change = watcher_->change_of(key);
    world_.when(change == Change::negated  ? Bool(!condition)
                : change == Change::always ? Bool(true)
                                           : condition,
                body);
    trail_ = outer;
  }
  template <class Body>
  void for_readers(Body&& body, Site site = Site::here()) {
    world_.for_readers(each(body, site));
  }
  template <class Body>
  void for_readers_by_number(Body&& body, Site site = Site::here()) {
    world_.for_readers_by_number(each(body, site));
  }
  template <class Term, class Body>
  void for_descriptors(Term&& term, Body&& body, Site site = Site::here()) {
    world_.for_descriptors(term, each(body, site));
  }
  template <class Body>
  void for_queue(Body&& body, Site site = Site::here()) {
    world_.for_queue(each(body, site));
  }
  template <class Body>
  void for_streams(Body&& body, Site site = Site::here()) {
    world_.for_streams(each(body, site));
  }
  template <class Body>
  void for_known_peers(Body&& body, Site site = Site::here()) {
    world_.for_known_peers(each(body, site));
  }
  template <class Body>
  void reverse(Body&& body, Site site = Site::here()) {
    world_.reverse([&](auto& back) {
      auto inside = around(back, trail_.inside(site));
      body(inside);
    });
  }

  // Effects.
  template <class P, class E>
  auto feed(P part, On<E> event, const typename P::Machine::Io::template Input<D>& input = {},
            Site site = Site::here()) {
    typename P::Machine::Io::template Output<D> output{};
    effect<P, at_hand>("feed", site, [&](auto& w) {
      const auto answer = w.feed(part, event, input);
      output = answer;
    });
    return output;
  }
  template <class P, class E, class Input = decltype(no_input), class Who = decltype(everyone)>
  auto feed_each(P part, On<E> event, Input input = {}, Who who = {}, Site site = Site::here()) {
    decltype(world_.feed_each(part, event, input, who)) output{};
    bool fed = false;
    effect<P, at_hand>("feed each", site, [&](auto& w) {
      auto answer = w.feed_each(part, event, input, who);
      if (!fed) output = std::move(answer);
      fed = true;
    });
    return output;
  }
  template <class P>
  void renew(P part, Site site = Site::here()) {
    effect<P>("renew", site, [=](auto& w) { w.renew(part); });
  }
  template <class V, class Value>
  void set(V variable, Value to, Site site = Site::here()) {
    effect<V>("set", site, [=](auto& w) { w.set(variable, to); });
  }
  template <class V, class Term>
  void set_each(V flag, Term term, Site site = Site::here()) {
    effect<V>("set each", site, [=](auto& w) { w.set_each(flag, term); });
  }
  template <class Wait, class T>
  void after(Wait wait, T timer, Site site = Site::here()) {
    start<T>("after", site, [=](auto& w) { w.after(wait, timer); });
  }
  template <class T>
  void at(const Int& time, T timer, Site site = Site::here()) {
    start<T>("at", site, [=](auto& w) { w.at(time, timer); });
  }
  template <class T>
  void cancel(T timer, Site site = Site::here()) {
    effect<T>("cancel", site, [=](auto& w) { w.cancel(timer); });
  }
  template <class P, class... Sayings>
  void emit(P packet, const std::tuple<Sayings...>& sayings, Site site = Site::here()) {
    effect<P>("emit", site, [=](auto& w) { w.emit(packet, sayings); });
  }
  template <class O>
  void raise(O, Site site = Site::here()) {
    using Rule = RuleFor<Composition, Happens<O>>;
    effect<O, at_hand>("raise", site, [&](auto& w) {
      auto inside = around(w, Trail{digest_of<Rule>});
      Rule::run(inside);
    });
  }
  template <class P>
  void call(P, Site site = Site::here()) {
    call_with<P>(site);
  }
  template <class P, class Arg>
  void call(P, const Arg& arg, Site site = Site::here()) {
    call_with<P>(site, arg);
  }
  template <class Step>
  void perform(Step step, Site site = Site::here()) {
    effect<Step, at_hand>("perform", site, [&](auto& w) { w.perform(step); });
  }
  template <class Step, class Arg>
  void perform(Step step, const Arg& arg, Site site = Site::here()) {
    effect<Step, at_hand>("perform", site, [&](auto& w) { w.perform(step, arg); });
  }
  template <class Step, class A, class B>
  void perform(Step step, const A& a, const B& b, Site site = Site::here()) {
    effect<Step, at_hand>("perform", site, [&](auto& w) { w.perform(step, a, b); });
  }

 private:
  /// Whether an effect can wait for another one: one whose outbox or arguments are at hand now
  /// cannot.
  enum Patience { can_wait, at_hand };

  /// Does `act` to the world, with the mistake that is to be made at it.
  template <class Target, Patience patience = can_wait, class Act>
  void effect(Digest kind, Site site, Act act) {
    const EffectKey key = trail_.inside(site).key(kind, digest_of<Target>);
    watcher_->happens(key);
    switch (watcher_->change_of(key)) {
      case Change::drop:
        return;
      case Change::twice:
        act(world_);
        act(world_);
        break;
      case Change::after_next:
        if constexpr (patience == can_wait) {
          watcher_->defer([act, w = world_]() mutable { act(w); });
        }
        return;
      case Change::every_reader:
        if constexpr (W::place == owner::relation) world_.for_readers(act);
        break;
      case Change::reversed:
        if constexpr (W::place == owner::relation || W::place == owner::pair) world_.reverse(act);
        break;
      default:
        act(world_);
        break;
    }
    watcher_->go_on();
  }
  /// The start of a timer, as the rule has it (`usual`) or at another time.
  template <class T, class Usual>
  void start(Digest kind, Site site, Usual usual) {
    using Other =
        std::conditional_t<std::is_same_v<T, HeartbeatExpiry>, ResponseDelay, HeartbeatPeriod>;
    const Change change = watcher_->change_of(trail_.inside(site).key(kind, digest_of<T>));
    effect<T>(kind, site, [=](auto& w) {
      if (change == Change::at_once) {
        w.at(w(Now{}), T{});
      } else if (change == Change::other_delay) {
        w.after(Other{}, T{});
      } else {
        usual(w);
      }
    });
  }
  template <class P, class... Args>
  void call_with(Site site, const Args&... args) {
    static const Trail beginning{Digest{scope_of<P, Args...>()}};
    effect<P, at_hand>("call", site, [&](auto& w) {
      auto inside = around(w, beginning);
      P::body(inside, args...);
    });
  }
  template <class Inner>
  auto around(Inner& inner, const Trail& trail) {
    return WatchedWorld<Inner>{inner, *watcher_, trail};
  }
  /// `body` for each world of a loop.
  template <class Body>
  auto each(Body& body, Site site) {
    const Trail there = trail_.inside(site);
    const bool first_only = watcher_->change_of(there.key("for")) == Change::first_only;
    return [this, &body, there, first_only, number = 0](auto& w) mutable {
      if (first_only && number++ > 0) return;
      auto inside = this->around(w, there);
      body(inside);
    };
  }

  W world_;
  Watcher* watcher_;
  Trail trail_;
};

}  // namespace stormproof::fsm::composition
