// What the recorder (fsm/program/recorder.hpp) does that does not depend on what a rule speaks of:
// where the next step goes, registers, and what names an effect.
#pragma once

#include <string_view>
#include <utility>

#include "fsm/composition/trail.hpp"
#include "fsm/program/value.hpp"

namespace stormproof::fsm::program {

class StepRecorder {
 public:
  using Site = composition::Site;

  explicit StepRecorder(Program& program) : program_{program} {}

  /// The steps of `body`, whose effects are named within `scope`.
  template <class Body>
  Steps record(std::string_view scope, Body&& body) {
    Steps steps;
    Steps* const list = std::exchange(into_, &steps);
    const composition::Trail trail =
        std::exchange(trail_, composition::Trail{composition::Digest{scope}});
    const unsigned effects = std::exchange(effects_, 0);
    body();
    effects_ = effects;
    trail_ = trail;
    into_ = list;
    return steps;
  }

 protected:
  [[nodiscard]] Program& program() { return program_; }

  Tag new_thing(const Thing& thing);
  /// Its place among the machines, or the next one.
  [[nodiscard]] std::size_t machine_named(std::string_view name) const;
  Register new_register(Tag part = no_thing);
  [[nodiscard]] bool is_knob(Tag tag) const;

  /// The value as it is now. In a term of another place it is what it is there.
  Value let(const Value& value);
  Value over(Op op, const Value& a) { return let(Value::make({.op = op, .a = a.ref()})); }
  [[nodiscard]] static Value in_register(Register reg, const Value& was) {
    return Value::make({.op = Op::let, .reg = reg, .a = was.ref()});
  }
  /// Runs a term that is about another place. Throws std::logic_error if it has in it what an
  /// enclosing term has read, which would be read anew where this one is evaluated.
  template <class Term>
  auto inside(Term&& term) {
    const bool outer = std::exchange(reads_here_, false);
    const std::size_t from = std::exchange(inner_from_, program_.terms.size());
    const auto result = term();
    if constexpr (std::is_same_v<decltype(result), const Value>) refuse_outer(result.ref());
    inner_from_ = from;
    reads_here_ = outer;
    return result;
  }

  void add(Step step) {
    if (step.what >= Do::feed) step.number = ++effects_;
    into_->push_back(std::move(step));
  }
  template <class Body>
  void block(Step step, Site site, Body&& body) {
    const composition::Trail outer = std::exchange(trail_, trail_.inside(site));
    step.key = trail_.key(composition::Digest{word_of(step.what)});
    step.file = site.file;
    step.line = site.line;
    Steps* const list = std::exchange(into_, &step.body);
    body();
    into_ = list;
    trail_ = outer;
    add(std::move(step));
  }
  [[nodiscard]] EffectKey key_of(Do what, std::string_view target, Site site) const {
    return trail_.inside(site).key(composition::Digest{word_of(what)}, composition::Digest{target});
  }
  /// The place of the procedure; it is recorded with `body` unless that has been done.
  template <class Body>
  std::size_t aside(Procedure procedure, Body&& body) {
    const std::size_t known = known_procedure(procedure);
    if (known < program_.procedures.size()) return known;
    program_.procedures.push_back(procedure);  // those that it calls stand behind it
    program_.procedures[known].body = record(procedure.name, body);
    return known;
  }

 private:
  /// Its place, or the next one. Throws std::logic_error if it was given outboxes of other parts.
  [[nodiscard]] std::size_t known_procedure(const Procedure& procedure) const;
  void refuse_outer(Ref ref) const;

  Program& program_;
  Steps* into_ = nullptr;
  composition::Trail trail_{""};
  unsigned effects_ = 0;        ///< of the rule or procedure so far
  bool reads_here_ = true;      ///< what is read is a step of the rule
  std::size_t inner_from_ = 0;  ///< the first term that is made in the term of another place
};

}  // namespace stormproof::fsm::program
