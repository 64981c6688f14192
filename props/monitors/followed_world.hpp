// The world that follows a run (props/monitors/followed.cpp): plain and scalar, one descriptor
// after the other; facts are evaluated by their definitions, except what a host counts. An effect
// on the state is done; one that an observer sees must be what the run did next, or the host is
// told the difference. The host (props/monitors/followed_rules.hpp) keeps the state and knows what
// the run did.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>
#include <boost/pfr.hpp>

#include "model/engine/timer_kinds.hpp"
#include "model/engine/writer_layout.hpp"
#include "props/monitors/deeds.hpp"

namespace stormproof::props {

namespace comp = fsm::composition;

/// What machines of many descriptors put out: of which of them each truth value is true.
struct DescriptorsDomain {
  using Bool = Descriptors;
};

/// Machines of some descriptors have moved, all between the same states.
struct MovedTogether {
  fsm::StateId before{};
  fsm::StateId after{};
  std::uint32_t first_word = 0;
  std::uint64_t descriptors = 0;
};
/// What one event of a machine moves; few pairs of states are different.
struct MovedMachines {
  boost::container::small_vector<MovedTogether, 4> list;

  void add(std::uint32_t d, fsm::StateId before, fsm::StateId after) {
    const std::uint64_t bit = std::uint64_t{1} << d % 64;
    for (MovedTogether& one : list) {
      if (one.before != before || one.after != after || one.first_word != d / 64) continue;
      one.descriptors |= bit;
      return;
    }
    list.push_back({before, after, d / 64, bit});
  }
  /// The first one alone.
  [[nodiscard]] MovedTogether least() const {
    MovedTogether first = *std::ranges::min_element(list, {}, [](const MovedTogether& one) {
      return 64 * one.first_word + static_cast<std::uint32_t>(std::countr_zero(one.descriptors));
    });
    first.descriptors &= ~first.descriptors + 1;
    return first;
  }
  void remove(MovedTogether& one, std::uint64_t descriptors) {
    one.descriptors &= ~descriptors;
    if (one.descriptors != 0) return;
    one = list.back();
    list.pop_back();
  }
};

/// The numbers of what a world is about, as far as they are known from there.
struct Place {
  static constexpr std::uint32_t nowhere = UINT32_MAX;

  std::uint32_t participant = 0;
  std::uint32_t pair = nowhere;
  std::uint32_t writer = 0;
  std::uint32_t relation = 0;
  std::uint32_t control = 0;
  std::uint32_t descriptor = 0;

  /// The number of an owner; of one with a descriptor, that of its relation or writer.
  [[nodiscard]] std::uint32_t number(comp::Owner owner) const {
    if (owner == comp::owner::participant) return participant;
    if (owner == comp::owner::pair) return pair;
    if (owner == comp::owner::writer || owner == comp::owner::entry) return writer;
    if (owner == comp::owner::control_relation) return control;
    return relation;
  }
};

template <class Host>
class FollowedWorld {
 public:
  using D = fsm::Plain;
  using Bool = bool;
  using Int = std::int64_t;
  using Set = Descriptors;
  using Composition = typename Host::Composition;
  using Site = comp::Site;

  FollowedWorld(Host& host, const Place& place, const Message* heard)
      : host_{&host}, place_{place}, heard_{heard} {}

  [[nodiscard]] const Place& place() const { return place_; }
  /// What is received.
  [[nodiscard]] const Message& heard() const { return *heard_; }
  [[nodiscard]] FollowedWorld at_relation(std::uint32_t relation) const {
    Place place = host_->relation_place(relation);
    place.descriptor = place_.descriptor;
    return {*host_, place, heard_};
  }

  // Values.
  template <class Tag>
  auto operator()(Tag tag) {
    if constexpr (std::derived_from<Tag, comp::Switch> || std::derived_from<Tag, comp::Delay>) {
      return host_->knob(tag);
    } else if constexpr (requires { host_->fact(tag, *this); }) {
      return Int{host_->fact(tag, *this)};
    } else if constexpr (std::derived_from<Tag, comp::Fact>) {
      return Tag::of(*this);
    } else if constexpr (requires { typename Tag::IsFlag; }) {
      return host_->template value<Tag>(place_) != 0;
    } else if constexpr (requires { typename Tag::IsNumber; }) {
      return Int{host_->template value<Tag>(place_)};
    } else if constexpr (std::derived_from<Tag, comp::DescriptorField>) {
      return static_cast<bool>(host_->says(tag, *heard_, place_.descriptor));
    } else if constexpr (std::derived_from<Tag, comp::PacketField>) {
      return static_cast<bool>(host_->says(tag, *heard_));
    } else if constexpr (std::derived_from<Tag, comp::PacketNumber>) {
      return static_cast<Int>(host_->says(tag, *heard_));
    } else if constexpr (std::derived_from<Tag, comp::Answer>) {
      return static_cast<bool>(host_->answer(tag, *this));
    } else {
      return static_cast<Int>(host_->answer(tag, *this));
    }
  }
  template <class T>
  Int operator()(comp::Pending<T>) {
    return host_->pending(model::event_kind_of<T>, place_.number(T::owner));
  }
  template <class P, class S>
  bool in(P, comp::Is<S>) {
    return host_->template state_at<P>(place_) == fsm::Reflect<typename P::Machine>::template id<S>;
  }
  [[nodiscard]] bool is_in(const Set& set) const { return set.has(place_.descriptor); }
  static bool any(const Set& set) { return !set.empty(); }
  template <class Term>
  Set set_of(Term&& term) {
    Set set;
    const std::uint32_t count = host_->descriptor_count(place_.writer);
    FollowedWorld d = *this;
    for (d.place_.descriptor = 0; d.place_.descriptor < count;) {
      const std::uint32_t first = d.place_.descriptor;
      const std::uint32_t end = std::min(count, first + 64);
      std::uint64_t members = 0;
      for (; d.place_.descriptor < end; ++d.place_.descriptor) {
        members |= std::uint64_t{term(d)} << (d.place_.descriptor - first);
      }
      set.add(first / 64, members);
    }
    return set;
  }
  template <class Term>
  bool some(Term&& term) {
    FollowedWorld first = *this;
    first.place_.descriptor = 0;
    return first.some_from_here(term);
  }
  template <class Term>
  bool all(Term&& term) {
    return !some([&](auto& d) { return !term(d); });
  }
  template <class Term>
  Int count(Term&& term) {
    Int total = 0;
    each_descriptor([&](FollowedWorld& d) { total += term(d) ? 1 : 0; });
    return total;
  }
  /// How many descriptors there are before the first of which the term does not hold; it holds of
  /// none after that one.
  template <class Term>
  std::uint32_t count_of_first(Term&& term) {
    FollowedWorld d = *this;
    std::uint32_t held = 0;
    for (std::uint32_t end = host_->descriptor_count(place_.writer); held < end;) {
      d.place_.descriptor = std::midpoint(held, end);
      if (term(d)) {
        held = d.place_.descriptor + 1;
      } else {
        end = d.place_.descriptor;
      }
    }
    return held;
  }
  template <class Term>
  bool all_up_to(Term&& term) {
    FollowedWorld d = *this;
    for (d.place_.descriptor = 0; d.place_.descriptor <= place_.descriptor; ++d.place_.descriptor) {
      if (!term(d)) return false;
    }
    return true;
  }
  template <class Term>
  bool some_from_here(Term&& term) {
    const std::uint32_t count = host_->descriptor_count(place_.writer);
    FollowedWorld d = *this;
    for (; d.place_.descriptor < count; ++d.place_.descriptor) {
      if (term(d)) return true;
    }
    return false;
  }
  template <class Term>
  bool some_reader(Term&& term) {
    return std::ranges::any_of(host_->readers(place_.writer), [&](std::uint32_t relation) {
      FollowedWorld r = at_relation(relation);
      return term(r);
    });
  }
  template <class Term>
  Int count_readers(Term&& term) {
    return std::ranges::count_if(host_->readers(place_.writer), [&](std::uint32_t relation) {
      FollowedWorld r = at_relation(relation);
      return term(r);
    });
  }
  template <class Term>
  bool some_entry(Term&& term) {
    for (std::uint32_t s = 0; s < writers().streams; ++s) {
      const std::uint32_t writer = writers().stride * place_.participant + s;
      FollowedWorld w{*host_, host_->writer_place(writer), heard_};
      if (w.some(term)) return true;
    }
    return false;
  }

  // Conditions and loops.
  template <class Body>
  void when(bool condition, Body&& body) {
    if (condition) body();
  }
  template <class Body>
  void for_readers(Body&& body) {
    for_relations(host_->readers(place_.writer), body);
  }
  template <class Body>
  void for_readers_by_number(Body&& body) {
    std::vector<std::uint32_t> relations = host_->readers(place_.writer);
    std::ranges::sort(relations);
    for_relations(relations, body);
  }
  template <class Term, class Body>
  void for_descriptors(Term&& term, Body&& body) {
    each_descriptor([&](FollowedWorld& d) {
      if (term(d)) body(d);
    });
  }
  template <class Body>
  void for_queue(Body&& body) {
    while (const auto entry = host_->next_in_queue(place_.participant)) {
      FollowedWorld e{*host_, *entry, heard_};
      body(e);
    }
  }
  template <class Body>
  void for_streams(Body&& body) {
    for_relations(host_->streams_of(place_.pair), body);
  }
  template <class Body>
  void for_known_peers(Body&& body) {
    for (const std::uint32_t pair : host_->known_peers(place_.participant)) {
      FollowedWorld peer{*host_, host_->pair_place(pair), heard_};
      body(peer);
    }
  }
  template <class Body>
  void reverse(Body&& body) {
    const std::uint32_t reverse = host_->topology().pair(place_.pair).reverse;
    FollowedWorld back =
        at_relation(writers().stride * reverse + place_.relation % writers().stride);
    body(back);
  }

  // Effects.
  template <class P, class E>
  auto feed(P, comp::On<E>, const typename P::Machine::Io::template Input<D>& input = {},
            Site site = Site::here()) {
    fsm::RowId row = fsm::no_row;
    const fsm::StateId before = host_->template state<P>(place_);
    const auto output = host_->template step<P, E>(place_, input, row);
    if (row == fsm::no_row) return output;
    MovedTogether moved{before, host_->template state<P>(place_)};
    if constexpr ((P::owner.indices & comp::owner::descriptor_index) != 0) {
      moved.first_word = place_.descriptor / 64;
      moved.descriptors = std::uint64_t{1} << place_.descriptor % 64;
    }
    host_->expect(host_->template move_at<P>(place_, name_of<E>, moved), site);
    return output;
  }
  template <class P, class E, class Input = decltype(comp::no_input),
            class Who = decltype(comp::everyone)>
  auto feed_each(P, comp::On<E>, Input input = {}, Who who = {}, Site site = Site::here()) {
    typename P::Machine::Io::template Output<DescriptorsDomain> total{};
    MovedMachines moved;
    each_descriptor([&](FollowedWorld& d) {
      if (!who(d)) return;
      fsm::RowId row = fsm::no_row;
      const fsm::StateId before = host_->template state<P>(d.place_);
      const typename P::Machine::Io::template Input<D> in = input(d);
      const auto output = host_->template step<P, E>(d.place_, in, row);
      if (row != fsm::no_row) {
        moved.add(d.place_.descriptor, before, host_->template state<P>(d.place_));
      }
      [&]<std::size_t... I>(std::index_sequence<I...>) {
        ((boost::pfr::get<I>(output) ? boost::pfr::get<I>(total).add(d.place_.descriptor) : void()),
         ...);
      }
      (std::make_index_sequence<boost::pfr::tuple_size_v<decltype(total)>>{});
    });
    host_->template expect_moves<P>(place_, name_of<E>, moved, site);
    return total;
  }
  template <class P>
  void renew(P, Site site = Site::here()) {
    host_->template renew<P>(*this, site);
  }
  template <class V, class Value>
  void set(V, Value to, Site = Site::here()) {
    host_->template assign<V>(place_, to);
  }
  template <class V, class Term>
  void set_each(V, Term&& term, Site = Site::here()) {
    host_->template assign_each<V>(place_, set_of(term));  // known before any changes
    host_->all_are_set(V{}, place_);
  }
  template <class Wait, class T>
  void after(Wait wait, T timer, Site site = Site::here()) {
    at((*this)(comp::Now{}) + (*this)(wait), timer, site);
  }
  template <class T>
  void at(Int time, T timer, Site site = Site::here()) {
    host_->expect_timer(timer, place_.number(T::owner), model::Nanoseconds{time}, site);
  }
  template <class T>
  void cancel(T, Site = Site::here()) {
    host_->cancel(model::event_kind_of<T>, place_.number(T::owner));
  }
  template <class P, class... Sayings>
  void emit(P packet, const std::tuple<Sayings...>& sayings, Site site = Site::here()) {
    host_->emit(packet, *this, sayings, site);
  }
  template <class O>
  void raise(O, Site = Site::here()) {
    comp::RuleFor<Composition, comp::Happens<O>>::run(*this);
  }
  template <class P, class... Args>
  void call(P, const Args&... args) {
    P::body(*this, args...);
  }
  template <class Step>
  void perform(Step, Site site = Site::here()) {
    do_step<Step>(site);
  }
  template <class Step, class A>
  void perform(Step, const A& a, Site site = Site::here()) {
    do_step<Step>(site, a);
  }
  template <class Step, class A, class B>
  void perform(Step, const A& a, const B& b, Site site = Site::here()) {
    do_step<Step>(site, a, b);
  }

 private:
  [[nodiscard]] model::WriterLayout writers() const { return host_->writers(); }
  /// In the host's own way, or as the contract says.
  template <class Step, class... Args>
  void do_step(Site site, const Args&... args) {
    host_->looks_at(site);
    if constexpr (requires { host_->perform(Step{}, *this, args...); }) {
      host_->perform(Step{}, *this, args...);
    } else {
      Step::contract(*this, args...);
    }
  }
  template <class Body>
  void each_descriptor(Body&& body) {
    const std::uint32_t count = host_->descriptor_count(place_.writer);
    FollowedWorld d = *this;
    for (d.place_.descriptor = 0; d.place_.descriptor < count; ++d.place_.descriptor) body(d);
  }
  template <class Relations, class Body>
  void for_relations(const Relations& relations, Body& body) {
    for (const std::uint32_t relation : relations) {
      FollowedWorld r = at_relation(relation);
      body(r);
    }
  }
  template <class E>
  static constexpr std::string_view name_of = fsm::name_of<E>();

  Host* host_;
  Place place_;
  const Message* heard_;
};

}  // namespace stormproof::props
