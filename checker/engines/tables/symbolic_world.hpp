// The world that executes the rules of a composition on solver expressions: everything of a small
// deployment is there, so that what one event does to others is what the next one reads of them.
// (The derived world, checker/engines/tables/derived_world.hpp, has one descriptor and takes what
// it reads of others as unknown, which is right for any number of steps and too much for two orders
// of two steps: it does not know that both orders read the same.) See
// fsm/composition/vocabulary.hpp for what a world is.
//
// Packing is left out: each descriptor goes alone, in index order, and what only the budget decides
// is the same for all events. So is what packets announce (`Announces`).
#pragma once

#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <boost/pfr.hpp>

#include "checker/engines/tables/symbolic_scope.hpp"
#include "fsm/composition/announcements.hpp"
#include "fsm/composition/heartbeat_clock.hpp"
#include "fsm/composition/reader.hpp"

namespace stormproof::tables {

template <class Composition>
class SymbolicWorld : public SymbolicScope {
 public:
  using Set = Lanes;

  SymbolicWorld(SymbolicRun& run, std::string event, Place place = {})
      : SymbolicScope{run, std::move(event), place} {}

  // Values.
  template <class Tag>
  auto operator()(Tag) {
    using namespace fsm::composition;
    if constexpr (std::is_same_v<Tag, Adaptive> || std::is_same_v<Tag, RunEnds>) {
      return Bool{false};  // the periodic policy; a run that goes on
    } else if constexpr (std::derived_from<Tag, Switch> || std::derived_from<Tag, Answer>) {
      return Bool{run_->knob(Bool::named(name<Tag>()).expr())};
    } else if constexpr (std::derived_from<Tag, Delay> || std::derived_from<Tag, Amount>) {
      return Int{run_->knob(Int::named(name<Tag>()).expr())};
    } else if constexpr (std::derived_from<Tag, Fact>) {
      return Tag::of(*this);
    } else if constexpr (requires { typename Tag::IsFlag; }) {
      return Bool{run_->truth(variable<Tag>())};
    } else if constexpr (requires { typename Tag::IsNumber; }) {
      return Int{run_->number(variable<Tag>())};
    } else {
      return input<Tag>();
    }
  }
  template <class T>
  Int operator()(fsm::composition::Pending<T>) {
    return Int{run_->number(pending<T>())};
  }
  template <class P, class S>
  Bool in(P, fsm::composition::Is<S>) {
    return Bool{machine<P>()[fsm::Reflect<typename P::Machine>::template id<S>]};
  }
  [[nodiscard]] Bool is_in(const Set& set) const {
    return set.of.empty() ? Bool{false} : set.of[static_cast<std::size_t>(place_.descriptor)];
  }
  [[nodiscard]] Bool is_subject() const { return Bool{place_.descriptor == subject_}; }
  Bool choice(const char* words) {
    return Bool{run_->knob(Bool::named(words + place_.text()).expr())};
  }

  // Quantifiers.
  static Bool any(const Set& set) {
    Exprs cases;
    for (const Bool& lane : set.of) cases.push_back(lane.expr());
    return Bool{any_of(cases).simplify()};
  }
  template <class Term>
  Set set_of(Term&& term) {
    Set set;
    each([&](SymbolicWorld& d) { set.of.push_back(Bool{term(d)}); });
    return set;
  }
  template <class Term>
  Bool some(Term&& term) {
    return any(set_of(term));
  }
  template <class Term>
  Bool all(Term&& term) {
    return !some([&](auto& d) { return !Bool{term(d)}; });
  }
  template <class Term>
  Int count(Term&& term) {
    Int total;
    for (const Bool& lane : set_of(term).of) total = total + D::select(lane, 1, 0);
    return total;
  }
  template <class Term>
  Bool some_reader(Term&& term) {
    Exprs cases;
    at_readers([&](SymbolicWorld& r) {
      cases.push_back((r(typename Composition::IsOpen{}) && Bool{term(r)}).expr());
    });
    return Bool{any_of(cases).simplify()};
  }
  template <class Term>
  Bool some_entry(Term&& term) {
    Exprs cases;
    at_entries([&](SymbolicWorld& entry) { cases.push_back(Bool{term(entry)}.expr()); });
    return Bool{any_of(cases).simplify()};
  }
  template <class Term>
  Bool all_up_to(Term&& term) {
    Set set = set_of(term);
    set.of.resize(static_cast<std::size_t>(place_.descriptor) + 1);
    for (Bool& lane : set.of) lane = !lane;
    return !any(set);
  }
  template <class Term>
  Bool some_from_here(Term&& term) {
    Set set = set_of(term);
    set.of.erase(set.of.begin(), set.of.begin() + place_.descriptor);
    return any(set);
  }

  // Conditions and loops.
  template <class Body>
  void when(const Bool& condition, Body&& body) {
    const Expr outer = path_;
    path_ = (path_ && condition.expr()).simplify();
    if (!path_.is_false()) body();
    path_ = outer;
  }
  template <class Body>
  void for_readers_by_number(Body&& body) {
    for_readers(body);
  }
  template <class Body>
  void for_readers(Body&& body) {
    at_readers(
        [&](SymbolicWorld& r) { r.when(r(typename Composition::IsOpen{}), [&] { body(r); }); });
  }
  template <class Body>
  void for_queue(Body&& body) {
    at_entries([&](SymbolicWorld& entry) {
      entry.when(entry(typename Composition::IsQueued{}), [&] { body(entry); });
    });
  }
  template <class Body>
  void for_streams(Body&& body) {
    for (int s = 0; s < run_->extent().streams; ++s) {
      SymbolicWorld world = *this;
      world.place_.stream = s;
      body(world);
    }
  }
  /// Those whom this participant has recognised.
  template <class Body>
  void for_known_peers(Body&& body) {
    at_readers([&](SymbolicWorld& pair) {
      const Bool known = pair.turned()(fsm::composition::Recognised{});
      pair.when(known, [&] { body(pair); });
    });
  }
  template <class Body>
  void reverse(Body&& body) {
    SymbolicWorld back = turned();
    body(back);
  }
  template <class Term, class Body>
  void for_descriptors(Term&& term, Body&& body) {
    const Set set = set_of(term);
    each([&](SymbolicWorld& d) { d.when(d.is_in(set), [&] { body(d); }); });
  }
  template <class Body>
  void partition(const Set& set, Body&& body) {
    const int outer = place_.descriptor;
    for (std::size_t d = 0; d < set.of.size(); ++d) {
      Set part{std::vector<Bool>(set.of.size())};
      part.of[d] = Bool{true};
      place_.descriptor = static_cast<int>(d);
      when(set.of[d], [&] { body(part); });
    }
    place_.descriptor = outer;
  }

  // Effects.
  template <class P, class E>
  auto feed(P, fsm::composition::On<E>,
            const typename P::Machine::Io::template Input<D>& input = {}) {
    return step<P, E>(path_, input);
  }
  template <class P, class E, class Input = decltype(fsm::composition::no_input),
            class Who = decltype(fsm::composition::everyone)>
  auto feed_each(P, fsm::composition::On<E>, Input input = {}, Who who = {}) {
    typename P::Machine::Io::template Output<LaneDomain> total;
    each([&](SymbolicWorld& d) {
      const typename P::Machine::Io::template Input<D> in = input(d);
      const auto out = d.template step<P, E>((path_ && Bool{who(d)}.expr()).simplify(), in);
      [&]<std::size_t... I>(std::index_sequence<I...>) {
        (join(boost::pfr::get<I>(total), boost::pfr::get<I>(out)), ...);
      }
      (std::make_index_sequence<boost::pfr::tuple_size_v<decltype(total)>>{});
    });
    return total;
  }
  template <class V, class Value>
  void set(V, const Value& value) {
    if constexpr (requires { typename V::IsFlag; }) {
      assign(run_->truth(variable<V>()), Bool{value}.expr());
    } else {
      assign(run_->number(variable<V>()), Int{value}.expr());
    }
  }
  template <class V, class Term>
  void set_each(V flag, Term&& term) {
    const Set set = set_of(term);
    each([&](SymbolicWorld& d) { d.set(flag, d.is_in(set)); });
  }
  template <class Wait, class T>
  void after(Wait delay, T timer) {
    at((*this)(fsm::composition::Now{}) + (*this)(delay), timer);
  }
  template <class T>
  void at(const Int& time, T) {
    happens<T>("", {time.expr()});
    if constexpr (T::counted) {
      Expr& pending_now = run_->number(pending<T>());
      assign(pending_now, pending_now + 1);
    }
  }
  template <class T>
  void cancel(T) {
    happens<T>(" cancelled", {});
    if constexpr (T::counted) assign(run_->number(pending<T>()), Int{0}.expr());
  }
  template <class P, class... Sayings>
  void emit(P, const std::tuple<Sayings...>& sayings) {
    Exprs content;
    fsm::composition::for_each_type(typename P::Fields{}, [&]<class F>() {
      if constexpr (!std::is_same_v<F, fsm::composition::Announces>) {
        const std::size_t before = content.size();
        std::apply([&](const auto&... each) { (say<F>(content, each), ...); }, sayings);
        if (content.size() == before) say<F>(content, fsm::composition::Says{F{}, Bool{false}});
      }
    });
    happens<P>("", std::move(content));
  }
  /// An occasion is an effect: what its rule does is compared as an event of its own.
  template <class O>
  void raise(O) {
    happens<O>("", {});
  }
  template <class P, class... Args>
  void call(P, const Args&... args) {
    P::body(*this, args...);
  }
  template <class Step, class... Args>
  void perform(Step, const Args&... args) {
    Step::contract(*this, args...);
  }

  /// The event is due: returns whether it can be, as far as counts tell.
  template <class Trigger>
  Bool trigger() {
    using Cause = typename Trigger::Cause;
    if constexpr (std::is_same_v<Trigger, fsm::composition::Due<Cause>>) {
      if constexpr (Cause::counted) {
        Expr& count = run_->number(pending<Cause>());
        const Bool due{count >= 1};
        count = count - 1;
        return due;
      }
    }
    return Bool{true};
  }

 private:
  static void join(Lanes& total, const Bool& one) { total.of.push_back(one); }
  static void join(LaneDomain::Int&, const Int&) {}

  template <class F, class G, class Value>
  void say(Exprs& content, const fsm::composition::Says<G, Value>& saying) {
    if constexpr (std::is_same_v<F, G>) {
      if constexpr (std::derived_from<F, fsm::composition::PacketField>) {
        content.push_back(saying.value.expr());
      } else if constexpr (std::is_same_v<Value, Bool>) {
        const auto descriptors = static_cast<std::size_t>(run_->extent().descriptors);
        content.resize(content.size() + descriptors, saying.value.expr());
      } else {
        for (const Bool& lane : set_of(saying.value).of) content.push_back(lane.expr());
      }
    }
  }

  // Other places.
  template <class Body>
  void each(Body&& body) {
    for (int d = 0; d < run_->extent().descriptors; ++d) {
      SymbolicWorld world = *this;
      world.place_.descriptor = d;
      body(world);
    }
  }
  template <class Body>
  void at_readers(Body&& body) {
    for (int peer = 0; peer <= run_->extent().readers; ++peer) {
      if (peer == place_.participant) continue;
      SymbolicWorld world = *this;
      world.place_.peer = peer;
      body(world);
    }
  }
  [[nodiscard]] SymbolicWorld turned() const {
    SymbolicWorld back = *this;
    std::swap(back.place_.participant, back.place_.peer);
    return back;
  }
  template <class Body>
  void at_entries(Body&& body) {
    for (int s = 0; s < run_->extent().streams; ++s) {
      each([&](SymbolicWorld& entry) {
        entry.place_.stream = s;
        entry.subject_ = entry.place_.descriptor;
        body(entry);
      });
    }
  }
};

}  // namespace stormproof::tables
