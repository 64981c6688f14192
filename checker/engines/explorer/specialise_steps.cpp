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
      value_[step.reg] = term(step.value);
      if (known(value_[step.reg])) break;
      put({.act = Act::let, .value = value_[step.reg], .reg = first_[step.reg]});
      value_[step.reg] = no_term;
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
    case Do::reverse:  // there is nothing in the reverse direction
      take_all(step.body);
      break;
    case Do::for_streams:
    case Do::for_known_peers:
      throw std::logic_error{"a loop over what is not explored"};
    default:
      effect(step);
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
      return put({.act = Act::set_each, .tag = step.target, .value = term(step.value)});
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

/// Rows that can fire, the last one of the table first, as in Boost.MSM.
void Specialiser::feed(const fsm::program::Step& step, bool keeps_outbox) {
  const fsm::program::Machine& machine = program_.machine_of(step.target);
  const bool each = step.what == Do::feed_each;
  Refs input;
  for (const fsm::program::Given& given : step.with) input.push_back(term(given.value));
  Step made{.act = each                                    ? Act::feed_each
                   : is_of_descriptors(thing(step.target)) ? Act::feed_one
                                                           : Act::feed,
            .tag = step.target};
  if (each) {
    made.value = step.value == no_term ? constant(1) : term(step.value);
    // What the writer takes from an ACKNACK is what it is told first.
    if (machine.events[step.event] == "AckNackReceived") made.asked = input.at(0);
  }
  const Refs* const outer = std::exchange(input_, &input);
  auto rows = rows_of(machine, mistakes_.tables);
  std::ranges::reverse(rows);
  for (const fsm::program::Machine::Row& row : rows) {
    if (row.event != step.event) continue;
    Specialised::Row taken{.source = row.source,
                           .target = row.target,
                           .guard = row.guard == no_term ? constant(1) : term(row.guard),
                           .out = {}};
    if (row.negated) taken.guard = negation(taken.guard);
    if (known(taken.guard) == 0) continue;
    for (std::size_t k = 0; k < row.out.size() && keeps_outbox; ++k) {
      if (row.out[k] == no_term) continue;
      taken.out.emplace_back(first_[step.reg] + static_cast<Register>(k), term(row.out[k]));
    }
    made.rows.push_back(std::move(taken));
  }
  input_ = outer;
  for (std::size_t k = 0; k < machine.outputs.size() && keeps_outbox; ++k) {
    made.outbox.push_back(first_[step.reg] + static_cast<Register>(k));
  }
  put(std::move(made));
  if (announces_ && thing(step.target).name == "Reader") hear(step);
}
/// A reader that takes DATA or a HEARTBEAT hears of descriptors.
void Specialiser::hear(const fsm::program::Step& step) {
  const fsm::program::Machine& machine = program_.machine_of(step.target);
  const std::string_view event = machine.events[step.event];
  const auto hears_if = [&](What packet, std::string_view field) {
    const auto found =
        std::ranges::find(machine.outputs, field, &fsm::program::Machine::Field::name);
    const auto k = static_cast<Register>(found - machine.outputs.begin());
    put({.act = Act::when,
         .value = add({.op = Op::let, .reg = first_[step.reg] + k}),
         .body = {{.act = Act::hear, .event = packet}}});
  };
  if (event == "DataReceived") hears_if(What::data, "take_data");
  if (event == "HeartbeatReceived") hears_if(What::heartbeat, "schedule_acknack");
}

void Specialiser::set(const fsm::program::Step& step) {
  const Thing& it = thing(step.target);
  Step made{.tag = step.target, .value = term(step.value)};
  made.act = it.kind == Thing::Kind::number ? Act::set_number
             : is_of_descriptors(it)        ? Act::set_member
                                            : Act::set_truth;
  // Doubling without end, the explored world would never come back to a state.
  if (it.name == "LastDelay") made.most = knob(program_.find("InitialDelay")) << last_doubling;
  put(std::move(made));
}

/// A timer, as the rule has it or at another time.
void Specialiser::start(const fsm::program::Step& step, Change change) {
  const Thing& timer = thing(step.target);
  const auto event = what_of(timer);
  if (!event) return;
  const bool is_period = timer.name == "HeartbeatExpiry";
  const auto delay = [&] {
    if (change == Change::at_once) return constant(0);
    if (change == Change::other_delay) {
      return constant(knob(is_period ? program_.response_delay : program_.heartbeat_period));
    }
    return step.what == Do::after ? constant(knob(step.wait)) : term(step.value);
  };
  put({.act = Act::schedule,
       .event = *event,
       .owner = timer.owner,
       .tag = timer.counted ? step.target : no_thing,
       .value = delay()});
}

void Specialiser::emit(const fsm::program::Step& step) {
  const auto what = what_of_packet(program_, step.target);
  if (!what) throw std::logic_error{"a packet that is not explored"};
  Step made{.act = Act::emit, .event = *what};
  for (std::size_t k = 0; k < step.with.size(); ++k) {
    const SlotField& field = slot_field(thing(step.fields[k]));
    made.says.push_back({field.as, field.flag, term(step.with[k].value)});
  }
  put(std::move(made));
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
      procedure.is_contract ? action_of_(thing(step.target).name) : Specialised::Action{};
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
