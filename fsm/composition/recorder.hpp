// The world that records: it runs every rule once, with conditions and values in words, and lists
// what happens. See fsm/composition/vocabulary.hpp for what a world is.
#pragma once

#include <algorithm>
#include <concepts>
#include <string>
#include <type_traits>

#include <boost/pfr.hpp>

#include "fsm/composition/composition_info.hpp"
#include "fsm/composition/outbox.hpp"
#include "fsm/composition/said.hpp"
#include "fsm/composition/trail.hpp"
#include "fsm/composition/vocabulary.hpp"

namespace stormproof::fsm::composition {

/// The name of a tag, without namespaces and template arguments.
template <class T>
constexpr std::string_view label() {
  return name_of<T>();
}
[[nodiscard]] std::string_view label(Owner owner);

template <class T>
struct TriggerWords;
template <class P>
struct TriggerWords<Received<P>> {
  static constexpr std::string_view text = "received";
};
template <class P>
struct TriggerWords<LeftSource<P>> {
  static constexpr std::string_view text = "left";
};
template <class T>
struct TriggerWords<Due<T>> {
  static constexpr std::string_view text = "due";
};
template <class O>
struct TriggerWords<Happens<O>> {
  static constexpr std::string_view text = "happens";
};

class Recorder {
 public:
  using D = Words;
  using Bool = Said;
  using Int = Said;
  using Set = Said;

  explicit Recorder(CompositionInfo& into) : into_{into} {}

  /// Runs `R` once.
  template <class R>
  void record() {
    using Cause = typename R::Trigger::Cause;
    RuleInfo rule{std::string{label<R>()},
                  TriggerWords<typename R::Trigger>::text,
                  label<Cause>(),
                  label(R::owner),
                  {}};
    rule_ = &rule;
    trail_ = Trail{label<R>()};
    R::run(*this);
    into_.rules.push_back(std::move(rule));
  }

  // Values.
  template <class Tag>
  Said operator()(Tag) {
    if constexpr (std::derived_from<Tag, Fact>) define<Tag>();
    return Said{std::string{label<Tag>()}};
  }
  template <class T>
  Said operator()(Pending<T>) {
    return Said{"pending " + std::string{label<T>()}, Said::Binding::loose};
  }
  template <class P, class S>
  Said in(P, Is<S>) {
    return Said{std::string{label<P>()} + " in " + std::string{label<S>()}, Said::Binding::loose};
  }
  Said is_in(const Said& set) { return set.as("in " + set.text()); }
  Said is_subject() { return Said{"it is this descriptor", Said::Binding::loose}; }
  Said choice(const char* words) {
    return Said{"maybe " + std::string{words}, Said::Binding::loose};
  }
  Said any(const Said& set) { return set.as("some " + set.text()); }
  template <class Term>
  Said set_of(Term&& term) {
    return said("those with ", term);
  }
  template <class Term>
  Said some(Term&& term) {
    return said("some d: ", term);
  }
  template <class Term>
  Said all(Term&& term) {
    return said("each d: ", term);
  }
  template <class Term>
  Said count(Term&& term) {
    return said("number of d: ", term);
  }
  template <class Term>
  Said some_reader(Term&& term) {
    return said("some reader: ", term);
  }
  template <class Term>
  Said count_readers(Term&& term) {
    return said("number of readers: ", term);
  }
  template <class Term>
  Said some_entry(Term&& term) {
    return said("some entry: ", term);
  }
  template <class Term>
  Said all_up_to(Term&& term) {
    return said("all up to it: ", term);
  }
  template <class Term>
  Said some_from_here(Term&& term) {
    return said("it or a later one: ", term);
  }

  // Conditions and loops.
  template <class Body>
  void when(const Said& condition, Body&& body, Site site = Site::here()) {
    use(condition);
    if (condition.text() == "true") {
      const Trail outer = std::exchange(trail_, trail_.inside(site));
      body();
      trail_ = outer;
    } else {
      within("when", "if " + condition.text(), site, body);
    }
  }
  template <class Body>
  void for_readers(Body&& body, Site site = Site::here()) {
    within("for", "for each open reader", site, [&] { body(*this); });
  }
  template <class Body>
  void for_readers_by_number(Body&& body, Site site = Site::here()) {
    within("for", "for each open reader by number", site, [&] { body(*this); });
  }
  template <class Term, class Body>
  void for_descriptors(Term&& term, Body&& body, Site site = Site::here()) {
    within("for", "for each d: " + term(*this).text(), site, [&] { body(*this); });
  }
  template <class Body>
  void for_queue(Body&& body, Site site = Site::here()) {
    within("for", "for each entry of the queue", site, [&] { body(*this); });
  }
  template <class Body>
  void for_streams(Body&& body, Site site = Site::here()) {
    within("for", "for each stream", site, [&] { body(*this); });
  }
  template <class Body>
  void for_known_peers(Body&& body, Site site = Site::here()) {
    within("for", "for each known peer", site, [&] { body(*this); });
  }
  template <class Body>
  void reverse(Body&& body, Site site = Site::here()) {
    within("for", "in the reverse direction", site, [&] { body(*this); });
  }
  template <class Body>
  void partition(const Said& set, Body&& body, Site site = Site::here()) {
    use(set);
    within("for", "for each part of " + set.text(), site, [&] { body(set); });
  }

  // Effects.
  template <class P, class E>
  auto feed(P, On<E>, const typename P::Machine::Io::template Input<D>& = {},
            Site site = Site::here()) {
    effect<P>("feed", std::string{label<E>()}, site);
    return outbox_of<P>();
  }
  template <class P, class E, class Input = decltype(no_input), class Who = decltype(everyone)>
  auto feed_each(P, On<E>, Input = {}, Who who = {}, Site site = Site::here()) {
    std::string detail{label<E>()};
    if constexpr (!std::is_same_v<std::remove_const_t<Who>,
                                  std::remove_const_t<decltype(everyone)>>) {
      detail += " where " + who(*this).text();
    }
    effect<P>("feed each", detail, site);
    return outbox_of<P>();
  }
  template <class P>
  void renew(P, Site site = Site::here()) {
    effect<P>("renew", "", site);
  }
  template <class V>
  void set(V, const Said& value, Site site = Site::here()) {
    use(value);
    effect<V>("set", value.text(), site);
  }
  template <class V, class Term>
  void set_each(V, Term&& term, Site site = Site::here()) {
    const Said value = term(*this);
    use(value);
    effect<V>("set each", value.text(), site);
  }
  template <class Wait, class T>
  void after(Wait, T, Site site = Site::here()) {
    effect<T>("after", std::string{label<Wait>()}, site);
  }
  template <class T>
  void at(const Said& time, T, Site site = Site::here()) {
    use(time);
    effect<T>("at", time.text(), site);
  }
  template <class T>
  void cancel(T, Site site = Site::here()) {
    effect<T>("cancel", "", site);
  }
  template <class P, class... Sayings>
  void emit(P, const std::tuple<Sayings...>& sayings, Site site = Site::here()) {
    std::string detail;
    std::apply([&](const auto&... each) { ((detail += contents(detail, each)), ...); }, sayings);
    effect<P>("emit", detail, site);
  }
  template <class O>
  void raise(O, Site site = Site::here()) {
    effect<O>("raise", "", site);
  }
  template <class P>
  void call(P, Site site = Site::here()) {
    effect<P>("call", "", site);
    aside(into_.procedures, std::string{label<P>()}, [&] { P::body(*this); });
  }
  template <class P, class Arg>
  void call(P, const Arg& arg, Site site = Site::here()) {
    const std::string argument = word(arg);
    effect<P>("call", argument, site);
    aside(into_.procedures, std::string{label<P>()} + (argument.empty() ? "" : " " + argument),
          [&] { P::body(*this, arg); });
  }
  template <class Step>
  void perform(Step, Site site = Site::here()) {
    step<Step>("", site);
  }
  template <class Step, class Arg>
  void perform(Step, const Arg& arg, Site site = Site::here()) {
    step<Step>(word(arg), site, arg);
  }
  template <class Step>
  void perform(Step, const Said& a, const Said& b, Site site = Site::here()) {
    step<Step>(word(a) + ", " + word(b), site, a, b);
  }

 private:
  template <class Term>
  Said said(const std::string& words, Term&& term) {
    const Said inner = term(*this);
    return inner.as(words + inner.text());
  }
  std::string word(const Said& value) {
    use(value);
    return value.text();
  }
  template <class Tag>
  std::string word(const Tag&) {
    return std::is_empty_v<Tag> ? std::string{label<Tag>()} : "";  // an outbox has no name
  }
  template <class F, class Value>
  std::string contents(const std::string& before, const Says<F, Value>& says) {
    std::string text = before.empty() ? "" : ", ";
    text += std::string{label<F>()} + " = ";
    if constexpr (std::is_same_v<Value, Said>) {
      use(says.value);
      text += says.value.text();
    } else {
      const Said value = says.value(*this);
      use(value);
      text += value.text();
    }
    return text;
  }
  template <class Body>
  void within(std::string_view kind, const std::string& condition, Site site, Body&& body) {
    const Trail outer = std::exchange(trail_, trail_.inside(site));
    blocks_.push_back({condition, ++last_block_, kind, trail_.key(kind)});
    body();
    trail_ = outer;
    blocks_.pop_back();
  }
  void use(const Said& value) {
    for (const std::string& field : value.fields()) {
      if (std::ranges::find(into_.consumed, field) == into_.consumed.end()) {
        into_.consumed.push_back(field);
      }
    }
  }
  template <class Target>
  void effect(std::string_view kind, std::string detail, Site site) {
    std::string_view owner = "";
    if constexpr (requires { Target::owner; }) owner = label(Target::owner);
    rule_->effects.push_back({rule_->id + "." + std::to_string(rule_->effects.size() + 1), kind,
                              label<Target>(), owner, std::move(detail), blocks_, site.file,
                              site.line, trail_.inside(site).key(kind, label<Target>())});
  }
  template <class P>
  auto outbox_of() {
    using Io = typename P::Machine::Io;
    typename Io::template Output<D> out;
    boost::pfr::for_each_field(out, [](Said& field, std::size_t k) {
      field = Said::field(std::string{label<P>()} + "." + std::string{outbox_names<Io>[k]});
    });
    return out;
  }
  template <class F>
  void define() {
    for (const auto& fact : into_.facts) {
      if (fact.first == label<F>()) return;
    }
    into_.facts.emplace_back(label<F>(), "");
    const std::size_t place = into_.facts.size() - 1;
    const Said value = F::of(*this);
    into_.facts[place].second = value.text();
  }
  template <class Step, class... Args>
  void step(const std::string& arguments, Site site, const Args&... args) {
    effect<Step>("perform", arguments, site);
    aside(into_.steps, std::string{label<Step>()} + tags<Args...>(), [&] {
      [&]<unsigned... numbers>(std::integer_sequence<unsigned, numbers...>) {
        Step::contract(*this, in_general(args, numbers + 1)...);
      }
      (std::make_integer_sequence<unsigned, sizeof...(Args)>{});
    });
  }
  /// The names of those arguments that are tags, each of which makes a contract of its own.
  template <class... Args>
  static std::string tags() {
    std::string text;
    [[maybe_unused]] const auto add = [&]<class Arg>() {
      if constexpr (std::is_empty_v<Arg>) text += " " + std::string{label<Arg>()};
    };
    (add.template operator()<Args>(), ...);
    return text;
  }
  /// An argument of a contract, whoever performs the step.
  static Said in_general(const Said&, unsigned number) {
    return Said{"argument " + std::to_string(number)};
  }
  template <class Tag>
  static Tag in_general(const Tag& tag, unsigned) {
    return tag;
  }
  /// Records `body` in `list` under this name, unless that has been done.
  template <class Body>
  void aside(std::vector<RuleInfo>& list, const std::string& name, Body&& body) {
    for (const RuleInfo& known : list) {
      if (known.id == name) return;
    }
    RuleInfo recorded{name, "", "", "", {}};
    list.push_back(recorded);  // what it calls comes after it
    const std::size_t place = list.size() - 1;
    RuleInfo* const outer = std::exchange(rule_, &recorded);
    std::vector<BlockInfo> blocks = std::exchange(blocks_, {});
    const Trail outer_trail = std::exchange(trail_, Trail{name});
    body();
    trail_ = outer_trail;
    blocks_ = std::move(blocks);
    rule_ = outer;
    list[place] = std::move(recorded);
  }

  CompositionInfo& into_;
  RuleInfo* rule_ = nullptr;
  std::vector<BlockInfo> blocks_;
  unsigned last_block_ = 0;
  Trail trail_{""};
};

/// The composition `Composition` as data.
template <class Composition>
CompositionInfo recorded() {
  CompositionInfo info;
  info.name = Composition::name;
  for_each_type(typename Composition::Parts{}, [&]<class P>() {
    using Machine = typename P::Machine;
    const MachineInfo machine = Reflect<Machine>::info();
    const auto& names = outbox_names<typename Machine::Io>;
    info.parts.push_back(
        {label<P>(), machine.name, label(P::owner), machine.events, {names.begin(), names.end()}});
  });
  const auto list = [](std::vector<ThingInfo>& things) {
    return [&things]<class T>() { things.push_back({label<T>(), label(T::owner)}); };
  };
  for_each_type(typename Composition::Timers{}, list(info.timers));
  for_each_type(typename Composition::State{}, list(info.state));
  for_each_type(typename Composition::Packets{}, list(info.packets));
  for_each_type(typename Composition::Occasions{}, list(info.occasions));
  for (const Unused& unused : Composition::unused) {
    info.unused.push_back({unused.part, unused.name, unused.reason});
  }
  for (const FromOutside& cause : Composition::from_outside) {
    info.from_outside.push_back({cause.name, cause.reason});
  }
  Recorder recorder{info};
  for_each_type(typename Composition::Rules{}, [&]<class R>() { recorder.template record<R>(); });
  return info;
}

}  // namespace stormproof::fsm::composition
