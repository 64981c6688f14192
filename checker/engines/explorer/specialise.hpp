// Specialises a recorded program (checker/engines/explorer/specialised.hpp). What only a host knows
// is what it is in an explored world: the present is 0, the run does not end, the participants are
// on different hosts, and what a contract leaves open does not happen.
#pragma once

#include <map>
#include <optional>
#include <string_view>

#include "checker/engines/explorer/packing.hpp"
#include "checker/engines/explorer/slot_fields.hpp"
#include "checker/engines/explorer/specialised.hpp"
#include "model/dds_profile.hpp"
#include "model/mutation.hpp"

namespace stormproof::explorer {

/// Whether HEARTBEATs say what exists: ACKNACKs list nothing else then.
[[nodiscard]] bool announces(const fsm::program::Program& program);

class Specialiser {
 public:
  using Program = fsm::program::Program;
  using Ref = fsm::program::Ref;
  using Term = Specialised::Term;
  using Step = Specialised::Step;
  using Steps = Specialised::Steps;
  using Act = Specialised::Act;

  Specialiser(const Program& program, const model::DdsProfile& dds, const model::Mutation& mistakes,
              Packing& host);

  /// All rules that the explorer runs; nothing has its place yet.
  [[nodiscard]] Specialised specialise();

 private:
  using Tag = fsm::program::Tag;
  using Register = fsm::program::Register;
  using Owner = fsm::program::Owner;
  using Change = fsm::composition::EffectMutation::Change;
  using Op = fsm::program::Op;
  using Refs = std::vector<Ref>;

  void number_registers();
  void find_short_circuits();
  [[nodiscard]] Steps rule(const fsm::program::Rule& rule);
  [[nodiscard]] Steps acknack(bool is_initial);

  // Terms.
  Ref add(const Term& term);
  Ref constant(std::int64_t value) { return add({.op = Op::integer, .value = value}); }
  [[nodiscard]] std::optional<std::int64_t> known(Ref ref) const;
  Ref negation(Ref a);
  Ref joined(Op op, Ref a, Ref b);
  Ref select(Ref condition, Ref then, Ref otherwise);
  Ref read(Tag tag);
  /// Within one term a part has one value, and stands once, however often it is used.
  Ref term(Ref ref);
  Ref made_of(const fsm::program::Term& term);
  [[nodiscard]] std::int64_t knob(Tag tag) const;

  // Steps.
  void take_all(const fsm::program::Steps& steps) {
    for (const fsm::program::Step& step : steps) take(step);
  }
  void take(const fsm::program::Step& step);
  void let(const fsm::program::Step& step);
  void when(Ref condition, const fsm::program::Steps& body);
  void loop(Act act, Ref which, const fsm::program::Step& step, Owner at);
  void effect(const fsm::program::Step& step);
  template <class Body>
  void reverse(Body&& body);
  void act_for_every_reader(const fsm::program::Step& step);
  void clear_outbox(const fsm::program::Step& step);
  void act(const fsm::program::Step& step, Change change, bool keeps_outbox = true);
  void feed(const fsm::program::Step& step, bool keeps_outbox);
  void ask(const fsm::program::Step& step);
  void hear(const fsm::program::Step& step);
  void set(const fsm::program::Step& step);
  void start(const fsm::program::Step& step, Change change);
  void emit(const fsm::program::Step& step);
  void enter(const fsm::program::Step& step);
  [[nodiscard]] Change change_of(const fsm::program::Step& step) const;
  void put(Step step) { into_->push_back(std::move(step)); }
  /// The same of an effect on something that a relation, a writer or a pair has.
  void put_on(Tag tag, Step step) {
    const bool is_here = thing(tag).owner == fsm::composition::owner::participant || !is_reverse_;
    if (!is_here) put({.act = Act::overflow});
    put(std::move(step));
  }
  /// What `body` puts.
  template <class Body>
  Steps steps_of(Body&& body) {
    Steps steps;
    Steps* const outer = std::exchange(into_, &steps);
    body();
    into_ = outer;
    return steps;
  }
  [[nodiscard]] const fsm::program::Thing& thing(Tag tag) const { return program_.things[tag]; }

  const Program& program_;
  const model::DdsProfile& dds_;
  const model::Mutation& mistakes_;
  Packing& host_;
  const bool announces_;
  const bool defers_;  ///< an effect comes after the next one
  Specialised result_;
  std::vector<Register> first_;  ///< by register: its value or the first field of its outbox
  std::map<Ref, Ref> made_;      ///< parts of the term that is being made
  unsigned depth_ = 0;           ///< of its parts
  Refs value_;                   ///< by register: what it is, if that needs no register
  /// By register: the first condition that C++ may decide without what was read into it.
  Refs short_circuits_;
  const Refs* input_ = nullptr;  ///< of the machine that is fed
  Steps* into_ = nullptr;
  Owner here_{};             ///< what the rule is about
  bool is_reverse_ = false;  ///< at the other end
  bool makes_mistakes_ = true;
};

/// What its steps change.
[[nodiscard]] std::vector<fsm::program::Tag> changed_things(Specialised& specialised);
/// Steps that nobody notices go: what is read, or asked of a machine, and not used.
void drop_unused(Specialised& specialised);
/// Everything gets its place.
void place(Specialised& specialised, const Layout& layout);

}  // namespace stormproof::explorer
