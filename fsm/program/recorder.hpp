// The world that records: it runs every rule once, with terms for values
// (fsm/program/value.hpp), and keeps what happens as the steps of a program. See
// fsm/composition/vocabulary.hpp for what a world is, and fsm/program/program.hpp for what becomes
// of its words. Nothing is folded: a condition that is `true` is one, as the pages show it.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "fsm/composition/vocabulary.hpp"
#include "fsm/program/machine.hpp"
#include "fsm/program/record_steps.hpp"
#include "fsm/program/thing_of.hpp"

namespace stormproof::fsm::program {

class Recorder : public StepRecorder {
 public:
  using D = Terms;
  using Bool = Value;
  using Int = Value;
  using Set = Value;
  using Site = composition::Site;

  using StepRecorder::StepRecorder;

  // Values.
  template <class T>
  Value operator()(T) {
    const Tag it = tag<T>();
    const Value value = Value::make({.op = Op::read, .tag = it});
    return is_knob(it) ? value : let(value);
  }
  template <class T>
  Value operator()(composition::Pending<T>) {
    return let(Value::make({.op = Op::pending, .tag = tag<T>()}));
  }
  template <class P, class S>
  Value in(P, composition::Is<S>) {
    constexpr auto state = Reflect<typename P::Machine>::template id<S>;
    return let(Value::make({.op = Op::in_state, .tag = tag<P>(), .value = state}));
  }
  Value is_in(const Value& set) { return over(Op::is_in, set); }
  Value is_subject() { return let(Value::make({.op = Op::subject})); }
  Value choice(const char* words) { return let(Value::make({.op = Op::choice, .words = words})); }
  Value any(const Value& set) { return over(Op::any, set); }
  template <class F>
  Value set_of(F&& term) {
    return over(Op::set_of, inner(term));
  }
  template <class F>
  Value some(F&& term) {
    return over(Op::some, inner(term));
  }
  template <class F>
  Value all(F&& term) {
    return over(Op::all, inner(term));
  }
  template <class F>
  Value count(F&& term) {
    return over(Op::count, inner(term));
  }
  template <class F>
  Value some_reader(F&& term) {
    return over(Op::some_reader, inner(term));
  }
  template <class F>
  Value count_readers(F&& term) {
    return over(Op::count_readers, inner(term));
  }
  template <class F>
  Value some_entry(F&& term) {
    return over(Op::some_entry, inner(term));
  }
  template <class F>
  Value all_up_to(F&& term) {
    return over(Op::all_up_to, inner(term));
  }
  template <class F>
  Value some_from_here(F&& term) {
    return over(Op::some_from_here, inner(term));
  }

  // Conditions and loops.
  template <class Body>
  void when(const Value& condition, Body&& body, Site site = Site::here()) {
    block({.what = Do::when, .value = condition.ref()}, site, body);
  }
  template <class Body>
  void for_readers(Body&& body, Site site = Site::here()) {
    loop(Do::for_readers, body, site);
  }
  template <class Body>
  void for_readers_by_number(Body&& body, Site site = Site::here()) {
    loop(Do::for_readers_by_number, body, site);
  }
  template <class F, class Body>
  void for_descriptors(F&& term, Body&& body, Site site = Site::here()) {
    const Ref which = inner(term).ref();
    block({.what = Do::for_descriptors, .value = which}, site, [&] { body(*this); });
  }
  template <class Body>
  void for_queue(Body&& body, Site site = Site::here()) {
    loop(Do::for_queue, body, site);
  }
  template <class Body>
  void for_streams(Body&& body, Site site = Site::here()) {
    loop(Do::for_streams, body, site);
  }
  template <class Body>
  void for_known_peers(Body&& body, Site site = Site::here()) {
    loop(Do::for_known_peers, body, site);
  }
  template <class Body>
  void reverse(Body&& body, Site site = Site::here()) {
    loop(Do::reverse, body, site);
  }
  template <class Body>
  void partition(const Value& set, Body&& body, Site site = Site::here()) {
    const Register part = new_register();
    block({.what = Do::partition, .value = set.ref(), .reg = part}, site,
          [&] { body(in_register(part, set)); });
  }

  // Effects.
  template <class P, class E>
  auto feed(P, composition::On<E>, const typename P::Machine::Io::template Input<D>& input = {},
            Site site = Site::here()) {
    return fed<P, E>(effect<P>(Do::feed, site), input);
  }
  template <class P, class E, class Input = decltype(composition::no_input),
            class Who = decltype(composition::everyone)>
  auto feed_each(P, composition::On<E>, Input input = {}, Who who = {}, Site site = Site::here()) {
    Step step = effect<P>(Do::feed_each, site);
    const typename P::Machine::Io::template Input<D> in = inside([&] { return input(*this); });
    using Everyone = std::remove_const_t<decltype(composition::everyone)>;
    if constexpr (!std::is_same_v<std::remove_const_t<Who>, Everyone>) {
      step.value = inner(who).ref();
    }
    return fed<P, E>(std::move(step), in);
  }
  template <class P>
  void renew(P, Site site = Site::here()) {
    add(effect<P>(Do::renew, site));
  }
  template <class V>
  void set(V, const Value& value, Site site = Site::here()) {
    add(effect<V>(Do::set, site, value.ref()));
  }
  template <class V, class F>
  void set_each(V, F&& term, Site site = Site::here()) {
    const Ref value = inner(term).ref();
    add(effect<V>(Do::set_each, site, value));
  }
  template <class Wait, class T>
  void after(Wait, T, Site site = Site::here()) {
    Step step = effect<T>(Do::after, site);
    step.wait = tag<Wait>();
    add(std::move(step));
  }
  template <class T>
  void at(const Value& time, T, Site site = Site::here()) {
    add(effect<T>(Do::at, site, time.ref()));
  }
  template <class T>
  void cancel(T, Site site = Site::here()) {
    add(effect<T>(Do::cancel, site));
  }
  template <class P, class... Sayings>
  void emit(P, const std::tuple<Sayings...>& sayings, Site site = Site::here()) {
    Step step = effect<P>(Do::emit, site);
    std::apply([&](const auto&... each) { (say(step, each), ...); }, sayings);
    add(std::move(step));
  }
  template <class O>
  void raise(O, Site site = Site::here()) {
    add(effect<O>(Do::raise, site));
  }
  template <class P>
  void call(P, Site site = Site::here()) {
    called<P>(effect<P>(Do::call, site), [&] { P::body(*this); });
  }
  template <class P, class Arg>
  void call(P, const Arg& arg, Site site = Site::here()) {
    called<P>(
        effect<P>(Do::call, site), [&](const Arg& formal) { P::body(*this, formal); }, arg);
  }
  template <class S>
  void perform(S, Site site = Site::here()) {
    called<S>(effect<S>(Do::perform, site), [&] { S::contract(*this); });
  }
  template <class S, class Arg>
  void perform(S, const Arg& arg, Site site = Site::here()) {
    called<S>(
        effect<S>(Do::perform, site), [&](const Arg& formal) { S::contract(*this, formal); }, arg);
  }
  template <class S>
  void perform(S, const Value& a, const Value& b, Site site = Site::here()) {
    called<S>(
        effect<S>(Do::perform, site),
        [&](const Value& one, const Value& other) { S::contract(*this, one, other); }, a, b);
  }

  /// What a packet would say.
  template <class F, class V>
  Given given(const composition::Says<F, V>& saying) {
    if constexpr (std::is_same_v<V, Value>) {
      return {saying.value.ref(), false};
    } else {
      return {inner(saying.value).ref(), true};
    }
  }
  /// The thing that a tag names. A packet in a contract that a composition takes from another one
  /// (the paper's `Generate` has HEARTBEATs) is its own of that name.
  template <class T>
  Tag tag() {
    const auto [entry, fresh] = tags_.try_emplace(&identity<T>, no_thing);
    if constexpr (requires { typename T::Fields; }) {
      const Tag known = fresh ? program().find(name_of<T>()) : no_thing;
      if (known != no_thing && program().things[known].kind == Thing::Kind::packet) {
        return entry->second = known;
      }
    }
    if (fresh) {
      const Tag it = entry->second = new_thing(thing_of<T>());
      if constexpr (requires { typename T::Machine; }) {
        const std::size_t machine = machine_named(name_of<typename T::Machine>());
        program().things[it].machine = machine;
        if (machine == program().machines.size()) {
          program().machines.push_back(recorded_machine<typename T::Machine>());
        }
      } else if constexpr (std::derived_from<T, composition::Fact>) {
        const Ref definition = inner([](auto& w) { return Value{T::of(w)}; }).ref();
        program().things[it].definition = definition;
      } else if constexpr (requires { typename T::Fields; }) {
        std::vector<Tag> fields;
        composition::for_each_type(typename T::Fields{},
                                   [&]<class F>() { fields.push_back(tag<F>()); });
        program().things[it].fields = std::move(fields);
      }
      return it;
    }
    return entry->second;
  }

 private:
  template <class T>
  static constexpr char identity = 0;

  template <class Target>
  Step effect(Do what, Site site, Ref value = no_term) {
    return {.what = what,
            .target = tag<Target>(),
            .value = value,
            .key = key_of(what, name_of<Target>(), site),
            .file = site.file,
            .line = site.line};
  }
  template <class Body>
  void loop(Do what, Body&& body, Site site) {
    block({.what = what}, site, [&] { body(*this); });
  }
  template <class F>
  Value inner(F&& term) {
    return inside([&] { return Value{term(*this)}; });
  }
  template <class F, class V>
  void say(Step& step, const composition::Says<F, V>& saying) {
    step.fields.push_back(tag<F>());
    step.with.push_back(given(saying));
  }
  template <class P, class E>
  auto fed(Step step, const typename P::Machine::Io::template Input<D>& input) {
    step.event = Reflect<typename P::Machine>::template event_id<E>;
    for (const Ref ref : refs_of(input, program().machine_of(step.target).inputs)) {
      step.with.push_back({ref, step.what == Do::feed_each});
    }
    step.reg = new_register(step.target);
    const auto out = outbox<typename P::Machine::Io::template Output<D>>(step.reg, step.target);
    add(std::move(step));
    return out;
  }
  template <class Outbox>
  static Outbox outbox(Register reg, Tag part) {
    Outbox out;
    std::int64_t k = 0;
    for_each_value<Value>(out, [&](Value& value) {
      value = Value::make({.op = Op::outbox, .tag = part, .reg = reg, .value = k++});
    });
    return out;
  }
  /// A procedure or contract is recorded once for each tag that it is given; values and outboxes
  /// become parameters.
  template <class P, class Body, class... Args>
  void called(Step step, Body&& body, const Args&... args) {
    Procedure procedure{std::string{name_of<P>()}, step.what == Do::perform, {}, {}};
    std::int64_t number = 0;
    [[maybe_unused]] const auto formal = [&]<class Arg>(const Arg& arg) -> Arg {
      ++number;
      if constexpr (std::is_empty_v<Arg>) {
        step.argument = name_of<Arg>();
        procedure.name.append(" ").append(step.argument);
        return arg;
      } else if constexpr (std::is_same_v<Arg, Value>) {
        step.with.push_back({arg.ref(), false});
        procedure.parameters.push_back({new_register(), false});
        return in_register(procedure.parameters.back().reg,
                           Value::make({.op = Op::argument, .value = number}));
      } else {
        const Ref first = boost::pfr::get<0>(arg).ref();
        const Tag part = program().terms[first].tag;
        step.with.push_back({first, false});
        procedure.parameters.push_back({new_register(part), true});
        return outbox<Arg>(procedure.parameters.back().reg, part);
      }
    };
    const std::tuple<Args...> formals{formal(args)...};
    step.procedure = aside(std::move(procedure), [&] { std::apply(body, formals); });
    add(std::move(step));
  }

  std::map<const char*, Tag> tags_;
};

}  // namespace stormproof::fsm::program
