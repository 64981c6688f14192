// Rules and terms: knobs, and what follows from them, are constants.
#include "checker/engines/explorer/specialise.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "fsm/program/execution.hpp"
#include "model/engine/program_things.hpp"

namespace stormproof::explorer {

using fsm::program::no_term;
using fsm::program::no_thing;
using fsm::program::Rule;
using fsm::program::Thing;
using fsm::program::Trigger;
using From = Specialised::From;

bool announces(const fsm::program::Program& program) {
  const fsm::program::Tag heartbeat = program.find("Heartbeat");
  return heartbeat != no_thing &&
         std::ranges::any_of(program.things[heartbeat].fields, [&](fsm::program::Tag field) {
           return program.things[field].name == "Announces";
         });
}

Specialiser::Specialiser(const Program& program, const model::DdsProfile& dds,
                         const model::Mutation& mistakes, Packing& host)
    : program_{program},
      dds_{dds},
      mistakes_{mistakes},
      host_{host},
      announces_{announces(program)},
      defers_{std::ranges::any_of(
          mistakes.effects, [](const auto& each) { return each.change == Change::after_next; })} {
  number_registers();
  find_short_circuits();
}

void Specialiser::number_registers() {
  for (const fsm::program::RegisterInfo& info : program_.registers) {
    first_.push_back(static_cast<Register>(result_.registers));
    result_.registers += info.part == no_thing ? 1 : program_.machine_of(info.part).outputs.size();
  }
  value_.assign(first_.size(), no_term);
}

Specialised Specialiser::specialise() {
  for (std::size_t k = 0; k < result_.rules.size(); ++k) {
    const Rule* const found = rule_of(program_, What{static_cast<std::uint8_t>(k)});
    if (found != nullptr) result_.rules.at(k) = rule(*found);
  }
  for (const std::string_view name : host_.occasions()) {
    result_.occasions.emplace_back(name,
                                   rule(*program_.rule_for(Trigger::happens, program_.find(name))));
  }
  for (const bool is_initial : {false, true}) result_.acknacks.at(is_initial) = acknack(is_initial);
  return std::move(result_);
}

Specialiser::Steps Specialiser::rule(const Rule& rule) {
  here_ = rule.owner;
  return steps_of([&] {
    const bool is_counted = rule.trigger == Trigger::due && thing(rule.cause).counted;
    if (is_counted) put({.act = Act::come, .tag = rule.cause});
    take_all(rule.body);
    if (defers_) put({.act = Act::go_on});
  });
}

/// The first of these that some rule emits.
Specialiser::Steps Specialiser::acknack(bool is_initial) {
  const auto says_initial = [&](const fsm::program::Step& step) {
    for (std::size_t k = 0; k < step.fields.size(); ++k) {
      if (thing(step.fields[k]).name == "IsInitial") return known(term(step.with[k].value)) == 1;
    }
    return false;
  };
  const fsm::program::Step* found = nullptr;
  const auto look = [&](const auto& self, const fsm::program::Steps& steps) -> void {
    for (const fsm::program::Step& step : steps) {
      const bool is_one = step.what == fsm::program::Do::emit && step.target == program_.acknack;
      if (is_one && found == nullptr && says_initial(step) == is_initial) found = &step;
      self(self, step.body);
    }
  };
  for (const Rule& rule : program_.rules) look(look, rule.body);
  if (found == nullptr) return {};
  return steps_of([&] { emit(*found); });
}

// Terms.

Specialiser::Ref Specialiser::add(const Term& term) {
  result_.terms.push_back(term);
  return static_cast<Ref>(result_.terms.size() - 1);
}
std::optional<std::int64_t> Specialiser::known(Ref ref) const {
  const Term& term = result_.terms[ref];
  return term.op == Op::integer ? std::optional{term.value} : std::nullopt;
}
Specialiser::Ref Specialiser::negation(Ref a) {
  if (const auto value = known(a)) return constant(*value == 0 ? 1 : 0);
  return add({.op = Op::negation, .a = a});
}
Specialiser::Ref Specialiser::select(Ref condition, Ref then, Ref otherwise) {
  if (const auto value = known(condition)) return *value != 0 ? then : otherwise;
  return add({.op = Op::select, .a = condition, .b = then, .c = otherwise});
}
Specialiser::Ref Specialiser::joined(Op op, Ref a, Ref b) {
  const auto left = known(a);
  const auto right = known(b);
  if (op == Op::both || op == Op::either) {
    // One of the two decides, or does not matter.
    if (left) return (*left != 0) == (op == Op::either) ? a : b;
    if (right) return (*right != 0) == (op == Op::either) ? b : a;
  } else if (left && right) {
    return constant(fsm::program::of_numbers<std::int64_t>(op, *left, *right));
  }
  return add({.op = op, .a = a, .b = b});
}

std::int64_t Specialiser::knob(Tag tag) const {
  return model::knob_value(thing(tag), dds_).value_or(0);
}

Specialiser::Ref Specialiser::read(Tag tag) {
  const Thing& it = thing(tag);
  if (const auto number = host_.keeps(it.name)) {
    return add({.op = Op::read, .from = From::host, .value = *number});
  }
  switch (it.kind) {
    case Thing::Kind::toggle:
    case Thing::Kind::delay:
      return constant(knob(tag));
    case Thing::Kind::fact:
      return term(it.definition);
    case Thing::Kind::flag:
      return add({.op = Op::read,
                  .from = is_of_descriptors(it) ? From::members : From::truth,
                  .tag = tag});
    case Thing::Kind::number:
      return add({.op = Op::read, .from = From::number, .tag = tag});
    case Thing::Kind::descriptor_field:
    case Thing::Kind::packet_field:
    case Thing::Kind::packet_number: {
      const SlotField& field = slot_field(it);
      return add({.op = Op::read, .from = field.as, .value = field.flag});
    }
    default:
      return constant(it.name == "CrossHost" ? 1 : 0);
  }
}

Specialiser::Ref Specialiser::term(Ref ref) {
  const auto known = made_.find(ref);
  if (known != made_.end()) return known->second;
  ++depth_;
  const Ref made = made_of(program_.terms[ref]);
  if (--depth_ == 0) {
    made_.clear();
  } else {
    made_.emplace(ref, made);
  }
  return made;
}
Specialiser::Ref Specialiser::made_of(const fsm::program::Term& it) {
  switch (it.op) {
    case Op::truth:
    case Op::integer:
      return constant(it.value);
    case Op::choice:
      return constant(0);
    case Op::read:
      return read(it.tag);
    case Op::let:
      if (value_[it.reg] != no_term) return value_[it.reg];
      return add({.op = Op::let, .reg = first_[it.reg]});
    case Op::outbox:
      return add({.op = Op::let, .reg = first_[it.reg] + static_cast<Register>(it.value)});
    case Op::input:
      return input_->at(static_cast<std::size_t>(it.value));
    case Op::named:
      return term(it.a);
    case Op::in_state:
      return add({.op = it.op,
                  .from = is_of_descriptors(thing(it.tag)) ? From::members : From::truth,
                  .tag = it.tag,
                  .value = it.value});
    case Op::pending:
    case Op::subject:
      return add({.op = it.op, .tag = it.tag});
    case Op::negation:
      return negation(term(it.a));
    case Op::select: {
      const Ref condition = term(it.a);
      const Ref then = term(it.b);
      return select(condition, then, term(it.c));
    }
    case Op::argument:
      throw std::logic_error{"an argument that is in no register"};
    default:
      break;
  }
  const Ref a = term(it.a);
  if (it.b != no_term) return joined(it.op, a, term(it.b));
  // Of the queue: whether it is empty.
  const Term& inner = result_.terms[a];
  const bool is_queued = inner.op == Op::read && inner.tag == program_.is_queued;
  return add({.op = it.op,
              .tag = it.op == Op::some_entry && is_queued ? program_.is_queued : no_thing,
              .a = a});
}

}  // namespace stormproof::explorer
