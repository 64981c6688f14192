// How a reader executes a program: steps in their order, terms over any domain (fsm/domain.hpp),
// with mistakes at effects as a run has them (fsm/composition/watched_world.hpp). The reader `Self`
// is a place, which is copied to get to others; it says what a thing is there and what an effect
// does:
//   Bool, Int, Set, D                         its domain
//   read(tag) -> Value, pending(tag) -> Int, in(part, state) -> Bool, choice(words) -> Bool,
//   is_subject() -> Bool, is_in(set) -> Bool, any(set) -> Bool
//   set_of(term) -> Set, some, all, some_reader, some_entry, all_up_to, some_from_here -> Bool,
//   count, count_readers -> Int               `term` is a function of a place -> Bool
//   when(condition, body), partition(set, body(part)), for_…(body(place)), reverse(body(place)),
//   for_descriptors(term, body(place))
//   feed(step), feed_each(step) -> the values of an outbox, with inputs(step) at the place
//   renew, cancel, raise(tag), set(tag, Value), set_each(tag, term), after(delay, timer),
//   at(Int, timer), emit(step)
//   note(step)                                the effect is about to happen
//   within(scope, body)                       the effects of another rule, procedure or contract
// Facts are evaluated by their definitions; a reader that keeps one does not ask for it.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "fsm/program/execution.hpp"

namespace stormproof::fsm::program {

template <class Self, class Domain, class Set_>
class Interpreter {
 public:
  using D = Domain;
  using Bool = typename D::Bool;
  using Int = typename D::Int;
  using Set = Set_;
  using Value = AnyValue<Bool, Int, Set>;
  using Values = std::vector<Value>;
  using Change = composition::EffectMutation::Change;

  explicit Interpreter(Execution<Value>& execution)
      : execution_{&execution}, makes_mistakes_{!execution.mistakes.empty()} {}

  void run_rule(const Rule& rule) {
    run(rule.body);
    go_on();
  }
  void run(const Steps& steps) {
    for (const Step& step : steps) take(step);
  }

  /// What the term is now, at this place.
  Value evaluate(Ref ref) {
    const Term& term = program().terms[ref];
    switch (term.op) {
      case Op::truth:
        return Bool(term.value != 0);
      case Op::integer:
        return Int(term.value);
      case Op::let:
        return registers()[term.reg].at(0);
      case Op::outbox: {
        const Values& values = registers()[term.reg];
        return values.empty() ? Value{} : values[static_cast<std::size_t>(term.value)];
      }
      default:
        break;
    }
    if (known_ == nullptr) return compute(term);
    const auto known = known_->find(ref);
    if (known != known_->end()) return known->second;
    return known_->emplace(ref, compute(term)).first->second;
  }
  /// The same of a term about this place. No term: it is true.
  Value evaluate_inner(Ref ref) {
    if (ref == no_term) return Bool(true);
    return anew([&] { return evaluate(ref); });
  }
  /// The input of a machine.
  Values inputs(const Step& step) {
    const auto all = [&] {
      Values values;
      for (const Given& given : step.with) values.push_back(evaluate(given.value));
      return values;
    };
    return step.what == Do::feed_each ? anew(all) : all();
  }
  /// The terms of guards and actions, over the input of a machine.
  Value evaluate_over(const Values& input, Ref ref) {
    const Values* const outer = std::exchange(input_, &input);
    Value value = evaluate_inner(ref);  // which uses much of it more than once
    input_ = outer;
    return value;
  }
  /// An inner term, for quantifiers.
  static auto term(Ref ref) {
    return [ref](auto& place) { return place.evaluate_inner(ref).truth(); };
  }

  [[nodiscard]] const Program& program() const { return execution_->program; }
  [[nodiscard]] const Thing& thing(Tag tag) const { return program().things[tag]; }
  [[nodiscard]] std::string name(Tag tag) const { return std::string{thing(tag).name}; }

 protected:
  [[nodiscard]] std::vector<Values>& registers() const { return execution_->registers; }

 private:
  Self& self() { return static_cast<Self&>(*this); }

  // Terms.
  template <class Evaluate>
  auto anew(Evaluate&& evaluate_all) {
    std::map<Ref, Value> known;
    auto* const outer = std::exchange(known_, &known);
    auto result = evaluate_all();
    known_ = outer;
    return result;
  }
  Value compute(const Term& term) {
    const auto a = [&] { return evaluate(term.a); };
    switch (term.op) {
      case Op::read: {
        const Thing& it = thing(term.tag);
        return it.kind == Thing::Kind::fact ? evaluate_inner(it.definition) : self().read(term.tag);
      }
      case Op::pending:
        return self().pending(term.tag);
      case Op::in_state:
        return self().in(term.tag, static_cast<StateId>(term.value));
      case Op::input:
        return input_->at(static_cast<std::size_t>(term.value));
      case Op::named:
        return a();
      case Op::choice:
        return self().choice(term.words);
      case Op::subject:
        return self().is_subject();
      case Op::is_in:
        return self().is_in(a().set());
      case Op::any:
        return self().any(a().set());
      case Op::negation:
        return !a().truth();
      case Op::both: {
        const Bool left = a().truth();
        return left && evaluate(term.b).truth();
      }
      case Op::either: {
        const Bool left = a().truth();
        return left || evaluate(term.b).truth();
      }
      case Op::select: {
        const Bool condition = a().truth();
        const Int then = evaluate(term.b).number();
        return D::select(condition, then, evaluate(term.c).number());
      }
      default:
        return term.op < Op::set_of ? compute_numbers(term) : compute_over_others(term);
    }
  }
  /// The right side first, as compiled rules do: unknowns have the numbers in which they are met.
  Value compute_numbers(const Term& term) {
    const Int b = evaluate(term.b).number();
    const Int a = evaluate(term.a).number();
    return of_numbers<Value>(term.op, a, b);
  }
  Value compute_over_others(const Term& term_) {
    const auto inner = term(term_.a);
    switch (term_.op) {
      case Op::set_of:
        return self().set_of(inner);
      case Op::some:
        return self().some(inner);
      case Op::all:
        return self().all(inner);
      case Op::count:
        return self().count(inner);
      case Op::some_reader:
        return self().some_reader(inner);
      case Op::count_readers:
        return self().count_readers(inner);
      case Op::some_entry:
        return self().some_entry(inner);
      case Op::all_up_to:
        return self().all_up_to(inner);
      default:
        return self().some_from_here(inner);
    }
  }

  // Steps.
  void take(const Step& step) {
    const auto body = [&] { run(step.body); };
    switch (step.what) {
      case Do::let:
        registers()[step.reg] = {evaluate(step.value)};
        break;
      case Do::when: {
        const Bool condition = evaluate(step.value).truth();
        const Change change = change_of(step);
        self().when(change == Change::negated  ? Bool(!condition)
                    : change == Change::always ? Bool(true)
                                               : condition,
                    body);
        break;
      }
      case Do::partition:
        self().partition(evaluate(step.value).set(), [&](const Set& part) {
          registers()[step.reg] = {part};
          body();
        });
        break;
      default:
        step.what < Do::feed ? loop(step) : effect(step);
    }
  }
  void loop(const Step& step) {
    const bool first_only = change_of(step) == Change::first_only;
    int number = 0;
    const auto each = [&](Self& place) {
      if (!first_only || number++ == 0) place.run(step.body);
    };
    switch (step.what) {
      case Do::for_readers:
        return self().for_readers(each);
      case Do::for_readers_by_number:
        return self().for_readers_by_number(each);
      case Do::for_descriptors:
        return self().for_descriptors(term(step.value), each);
      case Do::for_queue:
        return self().for_queue(each);
      case Do::for_streams:
        return self().for_streams(each);
      case Do::for_known_peers:
        return self().for_known_peers(each);
      default:
        return self().reverse([&](Self& back) { back.run(step.body); });
    }
  }

  // Effects, and mistakes at them.
  [[nodiscard]] Change change_of(const Step& step) const {
    if (!makes_mistakes_) return Change::none;
    for (const composition::EffectMutation& mistake : execution_->mistakes) {
      if (mistake.key == step.key) return mistake.change;
    }
    return Change::none;
  }
  /// Whether an effect can wait for another one: one whose outbox or arguments are at hand now
  /// cannot.
  static bool can_wait(const Step& step) {
    return step.what != Do::feed && step.what != Do::feed_each && step.what < Do::raise;
  }
  void effect(const Step& step) {
    const bool is_fed = step.what == Do::feed || step.what == Do::feed_each;
    if (is_fed) registers()[step.reg].clear();
    Values first;  // of several outboxes of sets
    const auto act_at = [&](Self& place) {
      place.act(step, Change::none);
      if (step.what != Do::feed_each) return;
      if (first.empty()) first = registers()[step.reg];
      registers()[step.reg] = first;
    };
    const Change change = change_of(step);
    switch (change) {
      case Change::drop:
        return;
      case Change::twice:
        act_at(self());
        act_at(self());
        break;
      case Change::after_next:
        if (can_wait(step)) defer(step);
        return;
      case Change::every_reader:
        self().for_readers(act_at);
        break;
      case Change::reversed:
        self().reverse(act_at);
        break;
      default:
        act(step, change);
        break;
    }
    go_on();
  }
  void defer(const Step& step) {
    execution_->deferred = [place = self(), values = registers(), &step]() mutable {
      std::swap(place.registers(), values);
      place.act(step, Change::none);
      std::swap(place.registers(), values);
    };
  }
  /// An effect has happened, or the rule is over.
  void go_on() {
    if (execution_->deferred) std::exchange(execution_->deferred, nullptr)();
  }
  void act(const Step& step, Change change) {
    self().note(step);
    switch (step.what) {
      case Do::feed:
        registers()[step.reg] = self().feed(step);
        break;
      case Do::feed_each:
        registers()[step.reg] = self().feed_each(step);
        break;
      case Do::renew:
        return self().renew(step.target);
      case Do::set:
        return self().set(step.target, evaluate(step.value));
      case Do::set_each:
        return self().set_each(step.target, term(step.value));
      case Do::after:
      case Do::at:
        return start(step, change);
      case Do::cancel:
        return self().cancel(step.target);
      case Do::emit:
        return self().emit(step);
      case Do::raise: {
        // Who makes mistakes follows what is raised; otherwise that is the reader's.
        const Rule* const rule = program().rule_for(Trigger::happens, step.target);
        if (!makes_mistakes_ || rule == nullptr) return self().raise(step.target);
        return self().within(rule->name, [&] { run(rule->body); });
      }
      default:
        return enter(step);
    }
  }
  /// A timer, as the rule has it or at another time.
  void start(const Step& step, Change change) {
    if (change == Change::at_once) {
      self().at(self().read(program().now).number(), step.target);
    } else if (change == Change::other_delay) {
      const bool is_period = thing(step.target).name == "HeartbeatExpiry";
      self().after(is_period ? program().response_delay : program().heartbeat_period, step.target);
    } else if (step.what == Do::after) {
      self().after(step.wait, step.target);
    } else {
      self().at(evaluate(step.value).number(), step.target);
    }
  }
  /// A procedure or the contract of a step; in a contract no mistakes are made.
  void enter(const Step& step) {
    const Procedure& procedure = program().procedures[step.procedure];
    for (std::size_t k = 0; k < step.with.size(); ++k) {
      const Procedure::Parameter& parameter = procedure.parameters[k];
      const Ref argument = step.with[k].value;
      registers()[parameter.reg] = parameter.is_outbox ? registers()[program().terms[argument].reg]
                                                       : Values{evaluate(argument)};
    }
    const bool outer = makes_mistakes_;
    makes_mistakes_ = outer && !procedure.is_contract;
    self().within(procedure.name, [&] { run(procedure.body); });
    makes_mistakes_ = outer;
  }

  Execution<Value>* execution_;
  bool makes_mistakes_;
  std::map<Ref, Value>* known_ = nullptr;  ///< what has been evaluated for an inner term
  const Values* input_ = nullptr;
};

}  // namespace stormproof::fsm::program
