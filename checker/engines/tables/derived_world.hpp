// The reader of a program that derives: it executes rules over solver expressions, for one generic
// descriptor, once for us and once for every kind of other, and makes each a step of a transition
// system (checker/engines/tables/derivation.hpp says by which rules). A place is which indices are
// ours and under which condition the rule gets there. Delays play no part unless time does
// (checker/engines/tables/derived_time.hpp). What only a host knows is unknown, and so are numbers,
// but for those of our place that were declared before.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "checker/engines/tables/derived_packets.hpp"
#include "checker/engines/tables/derived_timers.hpp"
#include "fsm/program/interpreter.hpp"

namespace stormproof::tables {

/// A set is whether our descriptor is in it.
class DerivedWorld
    : public fsm::program::Interpreter<DerivedWorld, smt::Symbolic, smt::SymbolicBool> {
 public:
  using Tag = fsm::program::Tag;
  using Step = fsm::program::Step;
  using Thing = fsm::program::Thing;
  using Execution = fsm::program::Execution<Value>;
  using Says = DerivedTime::Says;

  DerivedWorld(Execution& execution, Derived& derived, Foreign foreign, std::string_view scope = {})
      : Interpreter{execution},
        derived_{&derived},
        foreign_{foreign},
        subject_is_ours_{(foreign & owner::descriptor_index) == 0},
        scope_{scope} {}

  /// What makes the rule possible for us.
  void trigger(const fsm::program::Rule& rule);
  /// What an ACKNACK would say now.
  Says bitmap();

  // Values.
  Value read(Tag tag);
  Int pending(Tag timer);
  Bool in(Tag part, fsm::StateId state);
  static Bool is_in(const Bool& set) { return set; }
  [[nodiscard]] Bool is_subject() const { return Bool{subject_is_ours_}; }
  Bool choice(std::string_view) { return unknown(); }

  // Quantifiers: ours, or an unknown.
  Bool any(const Bool& set) { return or_others(set); }
  template <class Term>
  Bool set_of(Term&& term) {
    DerivedWorld d = ours(owner::descriptor_index);
    return term(d);
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
    return or_others(of_reader(term));
  }
  template <class Term>
  Int count_readers(Term&& term) {
    return with_others(of_reader(term).expr());
  }
  template <class Term>
  Bool some_entry(Term&& term) {
    DerivedWorld e = ours(owner::stream_index | owner::descriptor_index);
    return or_others(term(e));
  }
  /// Of our descriptor, and all below it.
  template <class Term>
  Bool all_up_to(Term&& term) {
    const Bool own = term(*this);
    return own && unknown();
  }
  template <class Term>
  Bool some_from_here(Term&& term) {
    return or_others(term(*this));
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
    around(owner::peer_index,
           [&](DerivedWorld& r) { r.when(r.read(program().is_open).truth(), [&] { body(r); }); });
  }
  template <class Body>
  void for_queue(Body&& body) {
    around(owner::stream_index | owner::descriptor_index, [&](DerivedWorld& entry) {
      entry.when(entry.read(program().is_queued).truth(), [&] { body(entry); });
    });
  }
  template <class Term, class Body>
  void for_descriptors(Term&& term, Body&& body) {
    // What is done for one may end the loop for those after it, and differ from what was done
    // before.
    constexpr int different_others = 2;
    around(
        owner::descriptor_index, [&](DerivedWorld& d) { d.when(term(d), [&] { body(d); }); },
        different_others);
  }
  /// The part that has our descriptor, if the set has it, and others before and after it.
  template <class Body>
  void partition(const Bool& set, Body&& body) {
    const auto others = [&] { when(unknown(), [&] { body(Bool{false}); }); };
    others();
    body(set);
    others();
  }
  template <class Body>
  void for_streams(Body&& body) {
    around(owner::stream_index, body);
  }
  template <class Body>
  void for_known_peers(Body&& body) {
    around(owner::peer_index,
           [&](DerivedWorld& peer) { peer.when(unknown(), [&] { body(peer); }); });
  }
  /// Another pair: that of another one may be ours.
  template <class Body>
  void reverse(Body&& body) {
    const Foreign pair = owner::pair.indices;
    DerivedWorld back = *this;
    back.foreign_ = static_cast<Foreign>(foreign_ | pair);
    back.is_reverse_ = (foreign_ & pair) == 0;
    body(back);
    if ((foreign_ & pair) == 0) return;
    DerivedWorld us = ours(pair);
    us.is_reverse_ = false;
    us.when(unknown(), [&] { body(us); });
  }

  // Effects.
  void note(const Step& step);
  Values feed(const Step& step) { return take(step, path_, inputs(step)); }
  Values feed_each(const Step& step);
  void renew(Tag part);
  void set(Tag variable, const Value& value);
  template <class Term>
  void set_each(Tag flag, Term&& term) {
    DerivedWorld d = ours(owner::descriptor_index);
    d.set(flag, term(d));
  }
  void after(Tag delay, Tag timer);
  void at(const Int& due, Tag timer);
  void cancel(Tag timer);
  void emit(const Step& step);
  void raise(Tag occasion);
  template <class Body>
  void within(std::string_view scope, Body&& body) {
    const std::string_view outer = std::exchange(scope_, scope);
    body();
    scope_ = outer;
  }

 private:
  using Owner = fsm::program::Owner;
  // The same names as in rules.
  struct owner {
    static constexpr Foreign stream_index = fsm::composition::owner::stream_index;
    static constexpr Foreign peer_index = fsm::composition::owner::peer_index;
    static constexpr Foreign descriptor_index = fsm::composition::owner::descriptor_index;
    static constexpr Owner pair = fsm::composition::owner::pair;
  };

  Derivation& derivation() { return derived_->derivation; }
  [[nodiscard]] bool is_foreign(Owner of) const { return (of.indices & foreign_) != 0; }
  [[nodiscard]] bool is_foreign(Tag tag) const { return is_foreign(thing(tag).owner); }
  Bool unknown() { return Bool{derivation().unknown()}; }
  Bool or_others(const Bool& own) {
    return derivation().is(Unsound::others_never_ask) ? own : own || unknown();
  }
  Int with_others(const Expr& own);
  Value knob(const Thing& it);
  Values take(const Step& step, const Expr& when, const Values& input);
  [[nodiscard]] DerivedTimer timer(Tag tag) const { return {thing(tag), *derived_}; }
  [[nodiscard]] DerivedPacket packet(Tag tag) const { return {program(), tag, *derived_}; }
  /// What a packet that arrives says, whether at ours or at another relation.
  void arrives(Tag tag);

  template <class Term>
  Bool of_reader(Term&& term) {
    DerivedWorld r = ours(owner::peer_index);
    const Bool open = r.read(program().is_open).truth();
    return open && term(r);
  }
  /// The same place, but with our own of these indices.
  [[nodiscard]] DerivedWorld ours(Foreign indices) const {
    DerivedWorld world = *this;
    world.foreign_ = static_cast<Foreign>(foreign_ & ~indices);
    return world;
  }
  /// The body for others of each index, so many times, for us, and for others again.
  template <class Body>
  void around(Foreign indices, Body&& body, int times = 1) {
    const auto run_at = [&](Foreign foreign) {
      DerivedWorld world = *this;
      world.foreign_ = foreign;
      world.is_reverse_ =
          is_reverse_ && (foreign & indices) == 0 && (indices & owner::pair.indices) == 0;
      if ((indices & owner::descriptor_index) != 0) {
        world.subject_is_ours_ = (foreign & indices) == 0;
      }
      if (foreign != (foreign_ & ~indices)) {
        world.when(unknown(), [&] { body(world); });
      } else {
        body(world);
      }
    };
    const auto us = static_cast<Foreign>(foreign_ & ~indices);
    const auto others = [&] {
      if (derivation().is(Unsound::loops_for_us_only)) return;
      for (int k = 0; k < times; ++k)
        for (Foreign index = 1; index != 0 && index <= indices;
             index = static_cast<Foreign>(index << 1)) {
          if ((indices & index) != 0) run_at(static_cast<Foreign>(us | index));
        }
    };
    others();
    run_at(us);
    others();
  }

  Derived* derived_;
  Foreign foreign_;
  bool subject_is_ours_;     ///< of a place that is about one descriptor
  bool is_reverse_ = false;  ///< the peer's side of our pair: ours, seen from there
  Expr path_ = Bool{true}.expr();
  std::optional<Says> packet_{};
  std::string_view scope_;  ///< the rule or procedure, which names effects
};

/// The variable that is true in this state of the machine.
[[nodiscard]] std::string state_name(const fsm::program::Program& program, fsm::program::Tag part,
                                     std::size_t state);

}  // namespace stormproof::tables
