// The world that executes rules (fsm/composition): each effect is done at once, by the host. It
// knows where it is (`place`: the indices of what it is about) and what a rule can say; the host
// has the state, the machines, the packets and the clock, by these names:
//
//   Composition, Packet                  whose rules these are, and what its packets are
//   topology()                           the numbers of pairs and relations
//   knob(tag), answer(tag, world)        of a switch or delay; of what only a host knows
//   profiles()                           if participants may have different ones (profiles.hpp)
//   value(tag, n), assign(tag, n[, d], value)        of a flag or number of owner n
//   assign_each(tag, n, set), or assign_word(tag, n, k, bits) for each word, ascending
//   word(tag, n, k)                      64 descriptors of a flag; of a field of `packet`
//   said(tag, packet)                    a field of a packet as a whole
//   fact(tag, world)                     if it keeps a fact up to date instead of evaluating it
//   driver(part), state(part, n)         of a machine
//   renew(part, n)                       if rules renew machines
//   bits(part), lane_order(part)         of the machines of descriptors, and which of those that
//                                        meet different inputs come first; moved(part, …) tells
//                                        of each class that has taken a step
//   schedule(timer, n, time), pending(timer, n), cancel(timer, n)
//   is_due(timer, event), owner_of(timer, event)     if its timers are events of a queue
//   emit(packet, world, sayings)         sends it
//   perform(step, world, …)              an opaque step
//   watcher()                            if somebody can watch the effects: who does, or nobody
//   readers(w), readers_by_number(w)     the open relations of a writer
//   writer_layout(), samples_of(w)       if participants have other writers than one for each
//                                        stream: how they are numbered, how much each has
//   for_queue(i, visit)                  visit(writer, descriptor) until the queue is empty
//   pair_of_control(n), writer_of_control(n)   of control-only relation n
//   participant_of_control(w), readers_of_control(w)   of such a writer: whose, its open relations
//   stands_at(site)                      if it asks where in the source the next effect stands
//   choice(), decide(choice, body), partition(set, body)   if it executes contracts
//
// What follows of this from what a composition declares, a host has from its store: `Kept`
// (model/engine/kept.hpp) and, in the simulator, `Stored` (model/engine/stored.hpp). The
// simulator's hosts are in model/paper, model/fastdds and model/cyclone, those of a captured
// relation in checker/evidence/conform, and the audit's of runs in props/monitors/auditor.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include <boost/pfr.hpp>

#include "fsm/composition/announcements.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "fsm/composition/watched_world.hpp"
#include "fsm/domain.hpp"
#include "model/engine/composition_knobs.hpp"
#include "model/engine/descriptor_set.hpp"
#include "model/engine/lanes.hpp"
#include "model/engine/timer_kinds.hpp"
#include "model/engine/topology.hpp"
#include "model/engine/writer_layout.hpp"

namespace stormproof::model {

using comp::Owner;

/// Of hosts that do not ask where effects stand in the source. One that does has a function
/// `stands_at(site)`, which is called before each effect.
struct Anywhere {
  static constexpr Anywhere here() { return {}; }
};
template <class Host>
using SiteFor = std::conditional_t < requires(Host& host) {
  host.stands_at(comp::Site{});
}
, comp::Site, Anywhere > ;

/// The outbox of many descriptors: who asks for what.
struct SetDomain {
  using Bool = DescriptorSet;
};

/// 64 descriptors of a stream, as terms see them.
template <class World>
class DescriptorLanes {
 public:
  using D = LaneDomain;
  using Bool = Lanes;

  DescriptorLanes(World& world, std::uint32_t k) : world_{world}, k_{k} {}

  template <class Tag>
  Lanes operator()(Tag tag) {
    if constexpr (std::derived_from<Tag, comp::DescriptorField>) {
      return Lanes{world_.host().word(tag, world_.packet(), k_)};
    } else if constexpr (is_of_descriptors<Tag>()) {
      return Lanes{world_.host().word(tag, world_.template number<Tag::owner>(), k_)};
    } else {
      return Lanes{static_cast<bool>(world_(tag))};
    }
  }
  template <class P, class S>
  Lanes in(P part, comp::Is<S>) {
    return Lanes{
        world_.host().bits(part).in_state(world_.template number<comp::owner::relation>(), k_,
                                          fsm::Reflect<typename P::Machine>::template id<S>)};
  }
  [[nodiscard]] Lanes is_in(const DescriptorSet& set) const { return Lanes{set.word(k_)}; }
  [[nodiscard]] Lanes is_subject() const {
    const std::uint32_t d = world_.descriptor();
    return Lanes{d / 64 == k_ ? std::uint64_t{1} << d % 64 : 0};
  }
  /// The term holds for the descriptor and for every lower one.
  template <class Term>
  Lanes all_up_to(Term&& term) {
    for (std::uint32_t k = 0; k < k_; ++k) {
      DescriptorLanes lower{world_, k};
      if (~term(lower).bits != 0) return false;
    }
    const int first = std::countr_one(term(*this).bits);
    return first == 64 ? Lanes{true} : Lanes{(std::uint64_t{1} << first) - 1};
  }
  /// The term holds for the descriptor or for some higher one.
  template <class Term>
  Lanes some_from_here(Term&& term) {
    for (std::uint32_t k = world_.word_count() - 1; k > k_; --k) {
      DescriptorLanes higher{world_, k};
      if ((term(higher).bits & world_.valid(k)) != 0) return true;
    }
    const std::uint64_t bits = term(*this).bits & world_.valid(k_);
    return bits == 0 ? Lanes{false} : Lanes{~std::uint64_t{0} >> std::countl_zero(bits)};
  }

 private:
  template <class Tag>
  static constexpr bool is_of_descriptors() {
    if constexpr (requires { Tag::owner; }) {
      return (Tag::owner.indices & comp::owner::descriptor_index) != 0;
    } else {
      return false;
    }
  }

  World& world_;
  std::uint32_t k_;
};

/// Constant where writers are those of the two streams.
template <class Host>
[[nodiscard]] constexpr WriterLayout layout_of(const Host& host) {
  if constexpr (requires { host.writer_layout(); }) {
    return host.writer_layout();
  } else {
    return {};
  }
}

template <class Host_, Owner place_>
class RunningWorld {
 public:
  static constexpr Owner place = place_;
  using Host = Host_;
  using D = fsm::Plain;
  using Bool = bool;
  using Int = std::int64_t;
  using Set = DescriptorSet;
  using Composition = typename Host::Composition;
  using Site = SiteFor<Host>;
  /// A reader of the writer; with a descriptor if this has one.
  using Reader = RunningWorld<Host, place == comp::owner::control_writer
                                        ? comp::owner::control_relation
                                        : Owner{static_cast<std::uint8_t>(
                                              place.indices | comp::owner::relation.indices)}>;

  /// `subject` is the number of what the world is about; with a descriptor, the number of its
  /// relation or writer.
  RunningWorld(Host& host, std::uint32_t subject, const typename Host::Packet* packet = nullptr,
               std::uint32_t descriptor = 0)
      : host_{host}, packet_{packet}, subject_{subject}, descriptor_{descriptor} {}

  [[nodiscard]] Host& host() { return host_; }
  [[nodiscard]] const typename Host::Packet& packet() const { return *packet_; }
  [[nodiscard]] std::uint32_t descriptor() const { return descriptor_; }
  /// The number of the owner of something, seen from here; of a descriptor, that of its relation or
  /// writer.
  template <Owner owner>
  [[nodiscard]] std::uint32_t number() const {
    namespace own = comp::owner;
    constexpr std::uint8_t wanted = owner.indices & ~own::descriptor_index;
    constexpr std::uint8_t here = place.indices & ~own::descriptor_index;
    static_assert((wanted & ~here) == 0, "this cannot be said from here");
    if constexpr (wanted == here) {
      return subject_;
    } else if constexpr (here == own::relation.indices) {
      const std::uint32_t stride = layout().stride;
      const std::uint32_t source = host_.topology().pair(subject_ / stride).source;
      if constexpr (wanted == own::pair.indices) return subject_ / stride;
      if constexpr (wanted == own::writer.indices) return stride * source + subject_ % stride;
      if constexpr (wanted == own::participant.indices) return source;
    } else if constexpr (here == own::control_relation.indices) {
      if constexpr (wanted == own::control_writer.indices) return host_.writer_of_control(subject_);
      if constexpr (wanted == own::pair.indices) return host_.pair_of_control(subject_);
    } else if constexpr (here == own::control_writer.indices) {
      return host_.participant_of_control(subject_);
    } else if constexpr (here == own::writer.indices) {
      return subject_ / layout().stride;
    } else {
      static_assert(here == own::pair.indices);
      return host_.topology().pair(subject_).source;
    }
  }

  // Values.
  template <class Tag>
  auto operator()(Tag tag) {
    if constexpr (std::derived_from<Tag, comp::Switch> || std::derived_from<Tag, comp::Delay>) {
      return knob(tag);
    } else if constexpr (std::derived_from<Tag, comp::Fact>) {
      if constexpr (requires { host_.fact(tag, *this); }) {
        return of_domain(host_.fact(tag, *this));
      } else {
        return Tag::of(*this);
      }
    } else if constexpr (std::derived_from<Tag, comp::PacketField>) {
      return static_cast<bool>(host_.said(tag, *packet_));
    } else if constexpr (std::derived_from<Tag, comp::PacketNumber>) {
      return static_cast<Int>(host_.said(tag, *packet_));
    } else if constexpr (std::derived_from<Tag, comp::Answer>) {
      return static_cast<bool>(host_.answer(tag, *this));
    } else if constexpr (std::derived_from<Tag, comp::Amount>) {
      return static_cast<Int>(host_.answer(tag, *this));
    } else if constexpr (has_descriptor<Tag>()) {
      return (host_.word(tag, number<Tag::owner>(), descriptor_ / 64) >> descriptor_ % 64 & 1) != 0;
    } else {
      return host_.value(tag, number<Tag::owner>());
    }
  }
  template <class T>
  Int operator()(comp::Pending<T>) {
    return host_.pending(T{}, number<T::owner>());
  }
  template <class P, class S>
  bool in(P part, comp::Is<S>) {
    constexpr fsm::StateId wanted = fsm::Reflect<typename P::Machine>::template id<S>;
    if constexpr (has_descriptor<P>()) {
      return host_.bits(part).state_of(number<P::owner>(), descriptor_) == wanted;
    } else {
      return host_.state(part, number<P::owner>()) == wanted;
    }
  }
  static bool any(const Set& set) { return !set.empty(); }
  template <class Term>
  Set set_of(Term&& term) {
    Set set;
    for_words(term, [&](std::uint32_t k, std::uint64_t members) { set.add(k, members); });
    return set;
  }
  template <class Term>
  bool some(Term&& term) {
    const std::uint32_t count = descriptor_count();
    for (std::uint32_t k = 0; 64 * k < count; ++k) {
      if (members(term, k, count) != 0) return true;
    }
    return false;
  }
  template <class Term>
  bool all(Term&& term) {
    return !some([&](auto& d) { return !term(d); });
  }
  template <class Term>
  Int count(Term&& term) {
    Int total = 0;
    for_words(term, [&](std::uint32_t, std::uint64_t found) { total += std::popcount(found); });
    return total;
  }
  template <class Term>
  bool some_reader(Term&& term) {
    for (const std::uint32_t relation : open_relations()) {
      Reader r{host_, relation, packet_, descriptor_};
      if (term(r)) return true;
    }
    return false;
  }

  template <class Term>
  Int count_readers(Term&& term) {
    Int total = 0;
    for (const std::uint32_t relation : open_relations()) {
      Reader r{host_, relation, packet_, descriptor_};
      if (term(r)) ++total;
    }
    return total;
  }
  template <class Term>
  bool some_entry(Term&& term) {
    const WriterLayout writers = layout();
    const std::uint32_t first = writers.stride * number<comp::owner::participant>();
    for (std::uint32_t s = 0; s < writers.streams; ++s) {
      RunningWorld<Host, comp::owner::writer> writer{host_, first + s, packet_};
      if (writer.some(term)) return true;
    }
    return false;
  }
  /// What a host makes of a choice of a contract.
  auto choice(const char*) { return host_.choice(); }

  // Conditions and loops.
  template <class Body>
  void when(bool condition, Body&& body) {
    if (condition) body();
  }
  template <class Choice, class Body>
  void when(Choice choice, Body&& body) {
    host_.decide(choice, body);
  }
  template <class Body>
  void partition(const Set& set, Body&& body) {
    host_.partition(set, body);
  }
  template <class Body>
  void for_readers(Body&& body) {
    each_reader(open_relations(), body);
  }
  template <class Body>
  void for_readers_by_number(Body&& body) {
    each_reader(host_.readers_by_number(number<comp::owner::writer>()), body);
  }
  template <class Term, class Body>
  void for_descriptors(Term&& term, Body&& body) {
    const std::uint32_t count = descriptor_count();
    for (std::uint32_t k = 0; 64 * k < count; ++k) {
      std::uint64_t from = ~std::uint64_t{0};
      for (std::uint64_t left = members(term, k, count); left != 0;
           left = members(term, k, count) & from) {
        const int lowest = std::countr_zero(left);
        from = lowest == 63 ? 0 : ~std::uint64_t{0} << (lowest + 1);
        auto d = with_descriptor(64 * k + static_cast<std::uint32_t>(lowest));
        body(d);
      }
    }
  }
  template <class Body>
  void for_queue(Body&& body) {
    host_.for_queue(number<comp::owner::participant>(), [&](std::uint32_t writer, std::uint32_t d) {
      RunningWorld<Host, comp::owner::entry> entry{host_, writer, packet_, d};
      body(entry);
    });
  }
  template <class Body>
  void for_streams(Body&& body) {
    const WriterLayout writers = layout();
    for (std::uint32_t s = 0; s < writers.streams; ++s) {
      RunningWorld<Host, comp::owner::relation> relation{host_, writers.stride * subject_ + s,
                                                         packet_};
      body(relation);
    }
  }
  /// The pairs of the participant with those whom it has recognised.
  template <class Body>
  void for_known_peers(Body&& body) {
    const std::uint32_t i = number<comp::owner::participant>();
    const Topology& topology = host_.topology();
    for (std::uint32_t n = topology.first_pair(i); n < topology.first_pair(i + 1); ++n) {
      if (!host_.value(comp::Recognised{}, topology.pair(n).reverse)) continue;
      RunningWorld<Host, comp::owner::pair> peer{host_, n, packet_};
      body(peer);
    }
  }
  /// From a control-only relation to the other pair of its ends.
  template <class Body>
  void reverse(Body&& body) {
    constexpr bool by_stream = (place.indices & comp::owner::stream_index) != 0;
    const std::uint32_t back = host_.topology().pair(number<comp::owner::pair>()).reverse;
    const std::uint32_t stride = layout().stride;
    RunningWorld<Host, by_stream ? place : comp::owner::pair> world{
        host_, by_stream ? stride * back + subject_ % stride : back, packet_};
    body(world);
  }

  // Effects.
  template <class P, class E>
  auto feed(P part, comp::On<E>, const typename P::Machine::Io::template Input<D>& input = {},
            Site site = Site::here()) {
    stands_at(site);
    if constexpr (has_descriptor<P>()) {
      const std::uint32_t relation = number<P::owner>();
      typename P::Machine::Io::template Output<D> output{};
      host_.bits(part).template step<E>(
          relation, descriptor_ / 64, std::uint64_t{1} << descriptor_ % 64, input,
          [&](std::uint64_t it, const auto& out, fsm::StateId before, fsm::StateId after) {
            host_.moved(part, relation, before, after, it);
            output = out;
          });
      return output;
    } else {
      const std::uint32_t n = number<P::owner>();
      return host_.driver(part).template step<E>(host_.state(part, n), input, n);
    }
  }
  template <class P, class E, class Input = decltype(comp::no_input),
            class Who = decltype(comp::everyone)>
  auto feed_each(P part, comp::On<E>, Input input = {}, Who who = {}, Site site = Site::here()) {
    stands_at(site);
    typename P::Machine::Io::template Output<SetDomain> total{};
    auto& bits = host_.bits(part);
    const std::uint32_t relation = number<comp::owner::relation>();
    const std::uint32_t count = descriptor_count();
    for (std::uint32_t k = 0; 64 * k < count; ++k) {
      DescriptorLanes d{*this, k};
      const std::uint64_t members = who(d).bits & bits_below(count, k);
      if (members == 0) continue;
      const auto merge = [&](std::uint64_t same, const auto& output, fsm::StateId before,
                             fsm::StateId after) {
        host_.moved(part, relation, before, after, same);
        merge_outbox(total, k, same, output);
      };
      if constexpr (std::is_same_v<Input, std::remove_const_t<decltype(comp::no_input)>>) {
        bits.template step<E>(relation, k, members, {}, merge);
      } else {
        const typename P::Machine::Io::template Input<LaneDomain> lanes = input(d);
        bits.template step_each<E>(relation, k, members, lanes, Host::lane_order(part), merge);
      }
    }
    return total;
  }
  template <class P>
  void renew(P part, Site site = Site::here()) {
    stands_at(site);
    host_.renew(part, number<P::owner>());
  }
  template <class V, class Value>
  void set(V variable, Value to) {
    if constexpr (has_descriptor<V>()) {
      host_.assign(variable, number<V::owner>(), descriptor_, to);
    } else {
      host_.assign(variable, number<V::owner>(), to);
    }
  }
  template <class V, class Term>
  void set_each(V flag, Term&& term) {
    const std::uint32_t n = number<V::owner>();
    if constexpr (requires { host_.assign_word(flag, n, std::uint32_t{}, std::uint64_t{}); }) {
      for_words(term, [&](std::uint32_t k, std::uint64_t holds) {
        host_.assign_word(flag, n, k, holds);
      });
    } else {
      host_.assign_each(flag, n, set_of(term));
    }
  }
  template <class Wait, class T>
  void after(Wait wait, T timer, Site site = Site::here()) {
    stands_at(site);
    host_.schedule(timer, number<T::owner>(), host_.now() + knob(wait));
  }
  template <class T>
  void at(Int time, T timer, Site site = Site::here()) {
    stands_at(site);
    host_.schedule(timer, number<T::owner>(), time);
  }
  template <class T>
  void cancel(T timer) {
    host_.cancel(timer, number<T::owner>());
  }
  template <class P, class... Sayings>
  void emit(P packet, const std::tuple<Sayings...>& sayings, Site site = Site::here()) {
    stands_at(site);
    host_.emit(packet, *this, sayings);
  }
  template <class O>
  void raise(O) {
    comp::RuleFor<Composition, comp::Happens<O>>::run(*this);
  }
  template <class P, class... Args>
  void call(P, const Args&... args) {
    P::body(*this, args...);
  }
  template <class Step>
  void perform(Step step, Site site = Site::here()) {
    stands_at(site);
    host_.perform(step, *this);
  }
  template <class Step, class A>
  void perform(Step step, const A& a, Site site = Site::here()) {
    stands_at(site);
    host_.perform(step, *this, a);
  }
  template <class Step, class A, class B>
  void perform(Step step, const A& a, const B& b, Site site = Site::here()) {
    stands_at(site);
    host_.perform(step, *this, a, b);
  }

  /// How many words the descriptors of the stream take, and which bits of word k mean one.
  [[nodiscard]] std::uint32_t word_count() const { return words_for(descriptor_count()); }
  [[nodiscard]] std::uint64_t valid(std::uint32_t k) const {
    return bits_below(descriptor_count(), k);
  }

 private:
  template <class Tag>
  [[nodiscard]] auto knob(Tag tag) const {
    if constexpr (is_knob<Tag> && requires { host_.profiles(); }) {
      if (host_.profiles().are_mixed()) [[unlikely]]
        return owned_knob(tag);
    }
    return host_.knob(tag);
  }
  /// As the participant has it whose value counts.
  template <class Tag>
  [[nodiscard]] auto owned_knob(Tag tag) const {
    const auto [source, destination] = ends();
    const auto of = [&](std::uint32_t i) { return knob_value(tag, host_.profiles().of(i)); };
    if constexpr (std::derived_from<Tag, comp::OfBothEnds>) {
      return of(source) && of(destination);
    } else {
      return of(std::derived_from<Tag, comp::OfDestination> ? destination : source);
    }
  }
  /// Source and destination; where there is one participant, it is both.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> ends() const {
    constexpr std::uint8_t here = place.indices & ~comp::owner::descriptor_index;
    if constexpr (here == comp::owner::relation.indices || here == comp::owner::pair.indices ||
                  here == comp::owner::control_relation.indices) {
      const Pair& pair = host_.topology().pair(number<comp::owner::pair>());
      return {pair.source, pair.destination};
    } else if constexpr (here == comp::owner::participant.indices) {
      return {subject_, subject_};
    } else {
      const std::uint32_t i = number<comp::owner::participant>();
      return {i, i};
    }
  }
  [[gnu::always_inline]] void stands_at([[maybe_unused]] Site site) {
    if constexpr (!std::is_same_v<Site, Anywhere>) host_.stands_at(site);
  }
  static Bool of_domain(bool value) { return value; }
  static Int of_domain(std::uint32_t value) { return value; }
  template <class Tag>
  static constexpr bool has_descriptor() {
    return (Tag::owner.indices & comp::owner::descriptor_index) != 0;
  }
  [[nodiscard]] constexpr WriterLayout layout() const { return layout_of(host_); }
  [[nodiscard, gnu::always_inline]] std::uint32_t descriptor_count() const {
    const std::uint32_t writer = number<comp::owner::writer>();
    if constexpr (requires { host_.samples_of(writer); }) {
      return host_.samples_of(writer);
    } else {
      return host_.topology().descriptor_count(writer / 2, streams[writer % 2]);
    }
  }
  /// Those descriptors of word k, out of `count`, for which the term holds.
  template <class Term>
  std::uint64_t members(Term&& term, std::uint32_t k, std::uint32_t count) {
    DescriptorLanes d{*this, k};
    return Lanes{term(d)}.bits & bits_below(count, k);
  }
  template <class Term, class Visit>
  void for_words(Term&& term, Visit&& visit) {
    const std::uint32_t count = descriptor_count();
    for (std::uint32_t k = 0; 64 * k < count; ++k) visit(k, members(term, k, count));
  }
  auto with_descriptor(std::uint32_t d) const {
    return RunningWorld<Host, Owner{static_cast<std::uint8_t>(place.indices |
                                                              comp::owner::descriptor_index)}>{
        host_, subject_, packet_, d};
  }
  [[nodiscard]] decltype(auto) open_relations() const {
    if constexpr (place == comp::owner::control_writer) {
      return host_.readers_of_control(subject_);
    } else {
      return host_.readers(number<comp::owner::writer>());
    }
  }
  template <class Relations, class Body>
  void each_reader(const Relations& relations, Body& body) {
    for (const std::uint32_t relation : relations) {
      Reader r{host_, relation, packet_, descriptor_};
      body(r);
    }
  }
  template <class Outbox, class Output>
  static void merge_outbox(Outbox& total, std::uint32_t k, std::uint64_t same,
                           const Output& output) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((boost::pfr::get<I>(output) ? boost::pfr::get<I>(total).add(k, same) : void()), ...);
    }
    (std::make_index_sequence<boost::pfr::tuple_size_v<Outbox>>{});
  }

  Host& host_;
  const typename Host::Packet* packet_;
  std::uint32_t subject_;
  std::uint32_t descriptor_;
};

/// What a packet says of a field; each field is said once.
template <class Field, class... Sayings>
const auto& said_of(const std::tuple<Sayings...>& sayings) {
  constexpr std::array<bool, sizeof...(Sayings)> same{
      std::is_same_v<typename Sayings::Field, Field>...};
  constexpr auto k = static_cast<std::size_t>(std::ranges::find(same, true) - same.begin());
  return std::get<k>(sayings).value;
}

/// Runs the rule of a trigger for the owner `subject`.
template <class Trigger, class Host>
void run_rule(Host& host, std::uint32_t subject, const typename Host::Packet* packet = nullptr,
              std::uint32_t descriptor = 0) {
  using Rule = comp::RuleFor<typename Host::Composition, Trigger>;
  RunningWorld<Host, Rule::owner> world{host, subject, packet, descriptor};
  if constexpr (requires { host.watcher(); }) {
    if (comp::Watcher* watcher = host.watcher(); watcher != nullptr) [[unlikely]] {
      comp::WatchedWorld watched{world, *watcher, comp::Trail{comp::digest_of<Rule>}};
      Rule::run(watched);
      watcher->go_on();
      return;
    }
  }
  Rule::run(world);
}

/// Runs the rule of the timer that the event is, if it is still wanted. Whether it is one.
template <class Host>
bool run_due(Host& host, const Event& event) {
  bool is_timer = false;
  comp::for_each_type(typename Host::Composition::Timers{}, [&]<class T>() {
    if (event.kind != event_kind_of<T>) return;
    is_timer = true;
    if (host.is_due(T{}, event)) run_rule<comp::Due<T>>(host, host.owner_of(T{}, event));
  });
  return is_timer;
}

/// The participant that has the timer of number n: which one follows from the timer's owner.
template <class T, class Host>
std::uint32_t actor_of(const Host& host, std::uint32_t n) {
  namespace own = comp::owner;
  const std::uint32_t stride = layout_of(host).stride;
  if constexpr (T::owner == own::participant) {
    return n;
  } else if constexpr (T::owner == own::writer) {
    return n / stride;
  } else if constexpr (T::owner == own::control_writer) {
    return host.participant_of_control(n);
  } else {
    std::uint32_t pair = n;
    if constexpr (T::owner == own::relation) pair = n / stride;
    if constexpr (T::owner == own::control_relation) pair = host.pair_of_control(n);
    const Pair& ends = host.topology().pair(pair);
    constexpr bool at_destination = requires { typename T::AtDestination; };
    return at_destination ? ends.destination : ends.source;
  }
}
/// The participant that acts in the event, if this is a timer.
template <class Host>
std::optional<std::uint32_t> actor_of_timer(const Host& host, const Event& event) {
  std::optional<std::uint32_t> actor;
  comp::for_each_type(typename Host::Composition::Timers{}, [&]<class T>() {
    if (event.kind == event_kind_of<T>) actor = actor_of<T>(host, host.owner_of(T{}, event));
  });
  return actor;
}

}  // namespace stormproof::model
