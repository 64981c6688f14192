// What rules read and do, over the variables of the system.
#include "checker/engines/tables/derived_world.hpp"

#include "checker/engines/tables/machine_step.hpp"
#include "model/engine/program_things.hpp"

namespace stormproof::tables {

using fsm::program::Trigger;

std::string state_name(const fsm::program::Program& program, fsm::program::Tag part,
                       std::size_t state) {
  return std::string{program.things[part].name} + "=" +
         std::string{program.machine_of(part).states[state]};
}

DerivedWorld::Int DerivedWorld::with_others(const Expr& own) {
  const Expr one = z3::ite(own, Int{1}.expr(), Int{0}.expr());
  return Int{derivation().is(Unsound::others_never_ask) ? one : one + derivation().unknown_count()};
}

DerivedWorld::Value DerivedWorld::knob(const Thing& it) {
  const bool is_truth = it.kind == Thing::Kind::toggle;
  const auto value = [it, is_truth](const model::DdsProfile& dds) {
    const std::int64_t number = model::knob_value(it, dds).value_or(0);
    return is_truth ? Bool{number != 0}.expr() : Int{number}.expr();
  };
  // That of a deployment is no knob of the profile.
  if (!model::knob_value(it, derived_->dds)) return Int{derivation().unknown_count()};
  auto found = derived_->knobs.find(it.full_name);
  if (derived_->knob || found == derived_->knobs.end()) {
    const Expr made =
        derived_->knob ? derived_->knob({std::string{it.name}, value}) : value(derived_->dds);
    found = derived_->knobs.insert_or_assign(it.full_name, made).first;
  }
  return is_truth ? Value{Bool{found->second}} : Value{Int{found->second}};
}

DerivedWorld::Value DerivedWorld::read(Tag tag) {
  const Thing& it = thing(tag);
  switch (it.kind) {
    case Thing::Kind::toggle:
    case Thing::Kind::delay:
      return knob(it);
    case Thing::Kind::flag:
      return is_foreign(tag) ? unknown() : Bool{derivation().now(name(tag))};
    case Thing::Kind::number:
      if (is_foreign(tag) || !derivation().has(name(tag))) break;
      return Int{derivation().now(name(tag))};
    case Thing::Kind::descriptor_field:
      if (is_foreign(Owner{owner::descriptor_index})) return unknown();
      [[fallthrough]];
    case Thing::Kind::packet_field: {
      const auto said = packet_->find(name(tag));  // what it has no field for is not said
      return said == packet_->end() ? Bool{false} : Bool{said->second};
    }
    case Thing::Kind::answer:
      return unknown();
    default:
      if (tag == program().now && derived_->time != nullptr) return Int{derived_->time->now()};
      break;
  }
  return Int{derivation().unknown_count()};
}
DerivedWorld::Int DerivedWorld::pending(Tag tag) {
  if (is_foreign(tag)) return Int{derivation().unknown_count()};
  return Int{derivation().now(timer(tag).counter())};
}
DerivedWorld::Bool DerivedWorld::in(Tag part, fsm::StateId state) {
  if (is_foreign(part)) return unknown();
  return Bool{derivation().now(state_name(program(), part, state))};
}

void DerivedWorld::note(const Step& step) {
  if (!derived_->happens || foreign_ != 0 || step.what == fsm::program::Do::feed_each) return;
  derived_->happens(effect_id(scope_, step), path_);
}
DerivedWorld::Values DerivedWorld::feed_each(const Step& step) {
  DerivedWorld d = ours(owner::descriptor_index);
  const Values input = d.inputs(step);
  const Expr when = (path_ && d.evaluate_inner(step.value).truth().expr()).simplify();
  if (derived_->happens && d.foreign_ == 0) derived_->happens(effect_id(scope_, step), when);
  return d.take(step, when, input);
}
DerivedWorld::Values DerivedWorld::take(const Step& step, const Expr& when, const Values& input) {
  const fsm::program::Machine& machine = program().machine_of(step.target);
  const bool is_other = is_foreign(step.target);
  OneHot before;
  for (std::size_t k = 0; k < machine.states.size(); ++k) {
    before.push_back(is_other ? derivation().unknown()
                              : derivation().now(state_name(program(), step.target, k)));
  }
  const auto value_of = [&](fsm::program::Ref ref) {
    const Value value = evaluate_over(input, ref);
    return value.is_number() ? value.number().expr() : value.truth().expr();
  };
  const RecordedStep effect{
      machine, rows_of(machine, derived_->mistakes.tables), step.event, before, when, value_of};
  for (std::size_t k = 0; k < machine.states.size() && !is_other; ++k) {
    derivation().now(state_name(program(), step.target, k)) = effect.next[k];
  }
  Values outbox;
  for (const Expr& field : effect.outbox) {
    outbox.push_back(field.is_bool() ? Value{Bool{field}} : Value{Int{field}});
  }
  return outbox;
}

/// The machines of this place, of all descriptors, are new ones.
void DerivedWorld::renew(Tag part) {
  if (ours(owner::descriptor_index).is_foreign(part)) return;
  const fsm::program::Machine& machine = program().machine_of(part);
  for (std::size_t k = 0; k < machine.states.size(); ++k) {
    derivation().assign(state_name(program(), part, k), path_, Bool{k == machine.initial}.expr());
  }
}
void DerivedWorld::set(Tag tag, const Value& value) {
  if (is_foreign(tag)) return;
  if (thing(tag).kind == Thing::Kind::flag) {
    derivation().assign(name(tag), path_, value.truth().expr());
  } else if (derivation().has(name(tag))) {
    derivation().assign(name(tag), path_, value.number().expr());
  }
}
void DerivedWorld::after(Tag delay, Tag tag) {
  if (is_foreign(tag)) return;
  if (derived_->time == nullptr) return timer(tag).started(path_, {});
  timer(tag).started(path_, Int{derived_->time->now()} + read(delay).number());
}
void DerivedWorld::at(const Int& due, Tag tag) {
  if (!is_foreign(tag)) timer(tag).started(path_, due);
}
void DerivedWorld::cancel(Tag tag) {
  if (!is_foreign(tag)) timer(tag).cancelled(path_);
}
void DerivedWorld::emit(const Step& step) {
  if (is_foreign(step.target)) return;
  Says says;
  DerivedWorld d = ours(owner::descriptor_index);
  for (std::size_t k = 0; k < step.with.size(); ++k) {
    const Tag field = step.fields[k];
    if (thing(field).kind == Thing::Kind::packet_number) continue;
    const auto& given = step.with[k];
    const Value value = given.inner ? d.evaluate_inner(given.value) : d.evaluate(given.value);
    says.insert_or_assign(name(field), value.truth().expr());
  }
  packet(step.target).emitted(path_, says);
}
DerivedWorld::Says DerivedWorld::bitmap() {
  Says says;
  DerivedWorld d = ours(owner::descriptor_index);
  for (const auto& [field, term] : program().bitmap) {
    says.insert_or_assign(name(field), d.evaluate_inner(term).truth().expr());
  }
  return says;
}
void DerivedWorld::raise(Tag occasion) {
  const Expr yes = Bool{true}.expr();
  if (derived_->happens && !is_foreign(occasion)) {
    derivation().assign("raised " + name(occasion), path_, yes);
  }
  const std::string back = raised_back(name(occasion));
  const Owner other{static_cast<Foreign>(thing(occasion).owner.indices & ~owner::pair.indices)};
  if (is_reverse_ && !is_foreign(other) && derivation().has(back)) {
    derivation().assign(back, path_, yes);
  }
}

void DerivedWorld::arrives(Tag tag) {
  Says says = packet(tag).inputs();
  if (!is_foreign(tag)) {
    if (derived_->mistakes.live_bitmaps && tag == program().acknack) {
      packet(tag).arrives_as(says, bitmap());
    } else {
      packet(tag).arrives(says);
    }
    if (derived_->received) derived_->received(name(tag), says);
  }
  packet_ = std::move(says);
}
void DerivedWorld::trigger(const fsm::program::Rule& rule) {
  const bool is_other = is_foreign(rule.cause);
  const bool is_timed = derived_->time != nullptr && !is_other;
  switch (rule.trigger) {
    case Trigger::received:
      arrives(rule.cause);
      if (is_timed) derived_->time->arrived(name(rule.cause), *packet_);
      break;
    case Trigger::left:
      arrives(rule.cause);
      if (is_timed) derived_->time->left(name(rule.cause), *packet_);
      break;
    case Trigger::due:
      if (!is_other) timer(rule.cause).fires();
      break;
    case Trigger::happens:
      if (!derived_->happens || is_other || program().comes_from_outside(rule.cause)) break;
      derivation().require(derivation().now("raised " + name(rule.cause)));
      break;
  }
}

}  // namespace stormproof::tables
