// Registers and names, and what cannot be a program.
#include "fsm/program/record_steps.hpp"

#include <algorithm>
#include <stdexcept>

namespace stormproof::fsm::program {

Tag StepRecorder::new_thing(const Thing& thing) {
  program_.things.push_back(thing);
  return static_cast<Tag>(program_.things.size() - 1);
}
std::size_t StepRecorder::machine_named(std::string_view name) const {
  const std::vector<Machine>& machines = program_.machines;
  return static_cast<std::size_t>(std::ranges::find(machines, name, &Machine::name) -
                                  machines.begin());
}
Register StepRecorder::new_register(Tag part) {
  program_.registers.push_back({part});
  return static_cast<Register>(program_.registers.size() - 1);
}
bool StepRecorder::is_knob(Tag tag) const {
  const Thing::Kind kind = program_.things[tag].kind;
  return kind == Thing::Kind::toggle || kind == Thing::Kind::delay;
}

Value StepRecorder::let(const Value& value) {
  if (!reads_here_) return value;
  const Register reg = new_register();
  add({.what = Do::let, .value = value.ref(), .reg = reg});
  return in_register(reg, value);
}

std::size_t StepRecorder::known_procedure(const Procedure& procedure) const {
  const auto known = std::ranges::find(program_.procedures, procedure.name, &Procedure::name);
  if (known != program_.procedures.end()) {
    const auto part = [&](const Procedure::Parameter& parameter) {
      return program_.registers[parameter.reg].part;
    };
    if (known->is_contract != procedure.is_contract ||
        !std::ranges::equal(known->parameters, procedure.parameters, {}, part, part)) {
      throw std::logic_error{procedure.name + " is given outboxes of different parts"};
    }
  }
  return static_cast<std::size_t>(known - program_.procedures.begin());
}

void StepRecorder::refuse_outer(Ref ref) const {
  if (ref == no_term) return;
  const Term& term = program_.terms[ref];
  switch (term.op) {
    case Op::truth:
    case Op::integer:
    case Op::let:
    case Op::outbox:
    case Op::argument:
      return;
    case Op::read:
      if (is_knob(term.tag)) return;
      [[fallthrough]];
    case Op::pending:
    case Op::in_state:
    case Op::choice:
    case Op::subject:
    case Op::is_in:
      if (ref < inner_from_) {
        throw std::logic_error{"a term of one place has in it what was read at another"};
      }
      [[fallthrough]];
    default:
      for (const Ref part : {term.a, term.b, term.c}) refuse_outer(part);
  }
}

}  // namespace stormproof::fsm::program
