// The reader of a program that writes Promela: it executes a rule once, for one relation, and every
// effect becomes a statement. Loops over descriptors are
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

#include <memory>
#include <string>
#include <vector>

#include "checker/engines/promela/script.hpp"
#include "checker/engines/promela/table_macros.hpp"
#include "fsm/program/interpreter.hpp"
#include "model/dds_profile.hpp"
#include "model/mutation.hpp"

namespace stormproof::promela {

/// The name of a thing as a variable. A single letter is written small, because X and U are
/// operators of the claims.
[[nodiscard]] std::string variable_name(const fsm::program::Thing& thing);

/// Whether a descriptor has one, so that it is a bit or an element of something.
[[nodiscard]] bool is_of_descriptors(const fsm::program::Thing& thing);

/// Whether a rule waits for packets of the kind to leave their source, where they are for a while.
[[nodiscard]] bool leaves_later(const fsm::program::Program& program, fsm::program::Tag packet);

class PromelaWorld : public fsm::program::Interpreter<PromelaWorld, Written, Lanes> {
 public:
  using Tag = fsm::program::Tag;
  using Step = fsm::program::Step;
  using Execution = fsm::program::Execution<Value>;

  PromelaWorld(Execution& execution, Script& script, const model::DdsProfile& dds,
               const model::Mutation& mistakes, int descriptor = 0)
      : Interpreter{execution},
        script_{&script},
        dds_{&dds},
        mistakes_{&mistakes.tables},
        descriptor_{descriptor},
        subject_{descriptor} {}

  /// The part is in the model, in its initial state.
  void declare(Tag part);
  /// The rule is about this packet.
  void look_at(Tag packet) { packet_ = variable(packet); }

  // Values.
  Value read(Tag tag);
  Number pending(Tag timer);
  Truth in(Tag part, fsm::StateId state);
  [[nodiscard]] Truth is_in(const Lanes& set) const;
  [[nodiscard]] Truth is_subject() const { return descriptor_ == subject_; }
  static Truth choice(std::string_view) { return false; }

  // Quantifiers.
  static Truth any(const Lanes& set) { return set.any(); }
  template <class Term>
  Lanes set_of(Term&& term) {
    Lanes set;
    each([&](PromelaWorld& d) { set.of.push_back(term(d)); });
    return set;
  }
  template <class Term>
  Truth some(Term&& term) {
    return set_of(term).any();
  }
  template <class Term>
  Truth all(Term&& term) {
    return !some([&](PromelaWorld& d) { return !term(d); });
  }
  template <class Term>
  Number count(Term&& term) {
    Number total;
    for (const Truth& lane : set_of(term).of) total = total + Number::of(lane);
    return total;
  }
  template <class Term>
  Truth some_reader(Term&& term) {
    return is_open() && term(*this);
  }
  template <class Term>
  Number count_readers(Term&& term) {
    return Number::of(some_reader(term));
  }
  template <class Term>
  Truth some_entry(Term&& term) {
    return some(term);
  }
  template <class Term>
  Truth all_up_to(Term&& term) {
    Truth all = true;
    each([&](PromelaWorld& d) { all = all && (d.descriptor_ > descriptor_ || term(d)); });
    return all;
  }
  template <class Term>
  Truth some_from_here(Term&& term) {
    Truth some;
    each([&](PromelaWorld& d) { some = some || (d.descriptor_ >= descriptor_ && term(d)); });
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
    when(is_open(), [&] { body(*this); });
  }
  template <class Body>
  void for_streams(Body&& body) {
    body(*this);
  }
  /// Announcements are no part of the model.
  template <class Body>
  void for_known_peers(Body&&) {}
  /// What happens in the other direction of the pair is no part of the model; what happens in its
  /// other direction is.
  template <class Body>
  void reverse(Body&& body) {
    PromelaWorld back = *this;
    back.discarded_ = std::make_shared<Script>(*script_);
    back.script_ = ours_ != nullptr ? ours_ : back.discarded_.get();
    back.ours_ = ours_ != nullptr ? nullptr : script_;
    body(back);
  }
  template <class Body>
  void for_queue(Body&& body) {
    each([&](PromelaWorld& entry) {
      entry.subject_ = entry.descriptor_;
      entry.when(entry.flag(program().is_queued), [&] { body(entry); });
    });
  }
  template <class Term, class Body>
  void for_descriptors(Term&& term, Body&& body) {
    each([&](PromelaWorld& d) { d.when(term(d), [&] { body(d); }); });
  }
  template <class Body>
  void partition(const Lanes& set, Body&& body) {
    each([&](PromelaWorld& d) {
      Lanes part{std::vector<Truth>(script_->descriptors())};
      part.of[static_cast<std::size_t>(d.descriptor_)] = true;
      when(d.is_in(set), [&] { body(part); });
    });
  }

  // Effects.
  Values feed(const Step& step);
  Values feed_each(const Step& step);
  void renew(Tag part);
  void set(Tag variable, const Value& value);
  template <class Term>
  void set_each(Tag flag, Term&& term) {
    const Lanes set = set_of(term);
    assign(flag, set.any(), set.bitmap().expression());
  }
  void after(Tag, Tag timer) { start(timer); }
  void at(const Number&, Tag timer) { start(timer); }
  void cancel(Tag timer);
  void emit(const Step& step);
  void raise(Tag occasion);
  void note(const Step&) {}
  template <class Body>
  void within(std::string_view, Body&& body) {
    body();
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
  [[nodiscard]] std::string variable(Tag tag) const { return variable_name(thing(tag)); }
  [[nodiscard]] bool is_of_descriptors(Tag tag) const {
    return promela::is_of_descriptors(thing(tag));
  }
  Truth is_open() { return flag(program().is_open); }
  Truth flag(Tag tag);
  [[nodiscard]] Truth field(Tag tag, bool bitmap) const;
  void assign(Tag flag, const Truth& may_hold, const Expression& value);
  void start(Tag timer);
  /// What a packet says of one of its fields; what it does not say is 0.
  Number said(const Step& step, Tag field);

  // Machines.
  [[nodiscard]] TableMacros table(Tag part) const { return {program(), part, *mistakes_}; }
  [[nodiscard]] std::string state(Tag part) const;
  /// The part's table, its outbox empty.
  TableMacros cleared(const Step& step);
  void take(const TableMacros& table, const Step& step, const Values& input);

  Script* script_;
  const model::DdsProfile* dds_;
  const std::vector<fsm::TableMutation>* mistakes_;
  int descriptor_;
  int subject_;  ///< the descriptor that the rule is about
  std::string packet_{};
  Script* ours_ = nullptr;  ///< in the other direction: the model
  std::shared_ptr<Script> discarded_{};
};

}  // namespace stormproof::promela
