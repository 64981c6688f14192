// Steps: what is called stands where it is called, and mistakes are made here.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "checker/engines/explorer/specialise.hpp"
#include "fsm/program/interpreter.hpp"

namespace stormproof::explorer {

using fsm::program::Do;
using fsm::program::no_term;
using fsm::program::no_thing;
using fsm::program::Thing;
using From = Specialised::From;
namespace owner = fsm::composition::owner;

Specialiser::Change Specialiser::change_of(const fsm::program::Step& step) const {
  if (!makes_mistakes_) return Change::none;
  const auto mistake =
      std::ranges::find(mistakes_.effects, step.key, &fsm::composition::EffectMutation::key);
  return mistake == mistakes_.effects.end() ? Change::none : mistake->change;
}

// Conditions and loops.

void Specialiser::take(const fsm::program::Step& step) {
  const auto with = [&](Owner other) {
    return Owner{static_cast<std::uint8_t>(here_.indices | other.indices)};
  };
  switch (step.what) {
    case Do::let:
      let(step);
      break;
    case Do::when: {
      const Change change = change_of(step);
      const Ref condition = change == Change::always ? constant(1) : term(step.value);
      when(change == Change::negated ? negation(condition) : condition, step.body);
      break;
    }
    case Do::partition: {  // one part
      const Ref set = term(step.value);
      put({.act = Act::let, .value = set, .reg = first_[step.reg]});
      value_[step.reg] = no_term;
      when(add({.op = Op::any, .a = set}), step.body);
      break;
    }
    case Do::for_readers:
    case Do::for_readers_by_number:
      loop(Act::for_readers, no_term, step, with(owner::relation));
      break;
    case Do::for_descriptors:
      loop(Act::for_descriptors, term(step.value), step, with(owner::descriptor));
      break;
    case Do::for_queue:
      loop(Act::for_queue, no_term, step, owner::entry);
      break;
    case Do::reverse:
      reverse([&] { take_all(step.body); });
      break;
    case Do::for_streams:
    case Do::for_known_peers:
      throw std::logic_error{"a loop over what is not explored"};
    default:
      effect(step);
  }
}
void Specialiser::let(const fsm::program::Step& step) {
  const Ref value = term(step.value);
  const Term made = result_.terms[value];
  value_[step.reg] = value;
  if (made.from == From::host && host_.is_decided_by_reading(static_cast<unsigned>(made.value))) {
    const Ref condition = short_circuits_[step.reg];
    if (condition == no_term) value_[step.reg] = no_term;
    put({.act = Act::decide,
         .value = condition == no_term ? value : term(condition),
         .reg = first_[step.reg]});
  } else if (!known(value)) {
    value_[step.reg] = no_term;
    put({.act = Act::let, .value = value, .reg = first_[step.reg]});
  }
}
void Specialiser::find_short_circuits() {
  short_circuits_.assign(first_.size(), no_term);
  const auto look = [&](const auto& self, Ref ref, Ref condition) -> void {
    if (ref == no_term) return;
    const fsm::program::Term& term = program_.terms[ref];
    if (term.op == Op::let && short_circuits_[term.reg] == no_term) {
      short_circuits_[term.reg] = condition;
    }
    if (term.op == Op::let || term.op == Op::select) return;
    for (const Ref part : {term.a, term.b, term.c}) self(self, part, condition);
  };
  for (Ref ref = 0; ref < program_.terms.size(); ++ref) {
    const fsm::program::Term& term = program_.terms[ref];
    if (term.op == Op::both || term.op == Op::either) look(look, term.b, ref);
  }
}
void Specialiser::when(Ref condition, const fsm::program::Steps& body) {
  const auto always = known(condition);
  if (always == 0) return;
  if (always) return take_all(body);
  Steps steps = steps_of([&] { take_all(body); });
  put({.act = Act::when, .value = condition, .body = std::move(steps)});
}
void Specialiser::loop(Act act, Ref which, const fsm::program::Step& step, Owner at) {
  const Owner outer = std::exchange(here_, at);
  Steps body = steps_of([&] { take_all(step.body); });
  here_ = outer;
  put({.act = act,
       .first_only = change_of(step) == Change::first_only,
       .value = which,
       .body = std::move(body)});
}

/// If there are no two ends, there is nothing in the reverse direction.
template <class Body>
void Specialiser::reverse(Body&& body) {
  if (!host_.has_two_ends()) return body();
  is_reverse_ = !is_reverse_;
  put({.act = Act::reverse, .body = steps_of(body)});
  is_reverse_ = !is_reverse_;
}

// Effects, and mistakes at them (fsm/composition/watched_world.hpp).

void Specialiser::effect(const fsm::program::Step& step) {
  const Change change = change_of(step);
  switch (change) {
    case Change::drop:
      return clear_outbox(step);
    case Change::twice:
      act(step, Change::none);
      act(step, Change::none, step.what != Do::feed_each);
      break;
    case Change::after_next: {
      const bool can_wait =
          step.what != Do::feed && step.what != Do::feed_each && step.what < Do::raise;
      if (!can_wait) return;
      put({.act = Act::defer, .body = steps_of([&] { act(step, Change::none); })});
      return;
    }
    case Change::every_reader:
      if (here_ == owner::relation) act_for_every_reader(step);
      break;
    case Change::reversed:
      if (here_ == owner::relation || here_ == owner::pair) {
        reverse([&] { act(step, Change::none); });
      }
      break;
    default:
      act(step, change);
      break;
  }
  if (defers_ && makes_mistakes_) put({.act = Act::go_on});
}
/// An outbox is that of the first one.
void Specialiser::act_for_every_reader(const fsm::program::Step& step) {
  clear_outbox(step);
  const auto has_been_first = static_cast<Register>(result_.registers++);
  const Ref later = add({.op = Op::let, .reg = has_been_first});
  const auto becomes = [&](std::int64_t value) {
    put({.act = Act::let, .value = constant(value), .reg = has_been_first});
  };
  const auto act_if = [&](Ref condition, bool is_first) {
    Steps steps = steps_of([&] {
      act(step, Change::none, is_first || step.what != Do::feed_each);
      becomes(1);
    });
    put({.act = Act::when, .value = condition, .body = std::move(steps)});
  };
  becomes(0);
  Steps body = steps_of([&] {
    act_if(later, false);
    act_if(negation(later), true);
  });
  put({.act = Act::for_readers, .body = std::move(body)});
}
void Specialiser::clear_outbox(const fsm::program::Step& step) {
  if (step.what != Do::feed && step.what != Do::feed_each) return;
  const std::size_t fields = program_.machine_of(step.target).outputs.size();
  for (Register k = 0; k < fields; ++k) {
    put({.act = Act::let, .value = constant(0), .reg = first_[step.reg] + k});
  }
}
void Specialiser::act(const fsm::program::Step& step, Change change, bool keeps_outbox) {
  switch (step.what) {
    case Do::feed:
    case Do::feed_each:
      return feed(step, keeps_outbox);
    case Do::renew:
      throw std::logic_error{"machines that are renewed are not explored"};
    case Do::set:
      return set(step);
    case Do::set_each:
      return put_on(step.target,
                    {.act = Act::set_each, .tag = step.target, .value = term(step.value)});
    case Do::after:
    case Do::at:
      return start(step, change);
    case Do::cancel:
      if (!what_of(thing(step.target))) return;
      throw std::logic_error{"slots of a frame are not cancelled"};
    case Do::emit:
      return emit(step);
    case Do::raise: {
      const auto* const rule = program_.rule_for(fsm::program::Trigger::happens, step.target);
      if (rule != nullptr) take_all(rule->body);
      return;
    }
    default:
      return enter(step);
  }
}

/// A procedure, or a step: as the host does it, or by its contract, in which no mistakes are made.
void Specialiser::enter(const fsm::program::Step& step) {
  const fsm::program::Procedure& procedure = program_.procedures[step.procedure];
  Refs arguments;
  for (std::size_t k = 0; k < step.with.size(); ++k) {
    const fsm::program::Procedure::Parameter& parameter = procedure.parameters[k];
    const Ref given = step.with[k].value;
    if (parameter.is_outbox) {
      first_[parameter.reg] = first_[program_.terms[given].reg];
    } else {
      arguments.push_back(value_[parameter.reg] = term(given));
    }
  }
  const bool outer = makes_mistakes_;
  makes_mistakes_ = outer && !procedure.is_contract;
  Specialised::Action action =
      procedure.is_contract ? host_.action(procedure.name) : Specialised::Action{};
  if (action) {
    Steps contract = steps_of([&] { take_all(procedure.body); });
    put({.act = Act::perform,
         .with = std::move(arguments),
         .action = std::move(action),
         .body = std::move(contract)});
  } else {
    take_all(procedure.body);
  }
  makes_mistakes_ = outer;
}

}  // namespace stormproof::explorer
