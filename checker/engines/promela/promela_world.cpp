// What becomes of flags, timers, packets and machines: variables, and statements about them.
#include "checker/engines/promela/promela_world.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/core.h>

#include "model/engine/program_things.hpp"

namespace stormproof::promela {

using fsm::program::Thing;
using fsm::program::Trigger;
namespace owner = fsm::composition::owner;

std::string variable_name(const Thing& thing) {
  std::string text{thing.name};
  if (text.size() == 1) text[0] = static_cast<char>(std::tolower(text[0]));
  return text;
}
bool is_of_descriptors(const Thing& thing) {
  return (thing.owner.indices & owner::descriptor_index) != 0;
}
bool leaves_later(const fsm::program::Program& program, fsm::program::Tag packet) {
  const fsm::program::Rule* const rule = program.rule_for(Trigger::left, packet);
  return rule != nullptr && rule->group == fsm::program::Rule::Group::exchange;
}

void PromelaWorld::declare(Tag part) {
  const TableMacros macros = table(part);
  const std::string count =
      is_of_descriptors(part) ? fmt::format("[{}]", script_->descriptors()) : std::string{};
  script_->define(macros.states());
  script_->declare(fmt::format("byte {}{} = {};\n", variable(part), count, macros.initial()));
}

PromelaWorld::Value PromelaWorld::read(Tag tag) {
  switch (thing(tag).kind) {
    case Thing::Kind::toggle:
      return Truth{model::knob_value(thing(tag), *dds_).value_or(0) != 0};
    case Thing::Kind::delay: {
      const auto delay = model::knob_value(thing(tag), *dds_);
      return delay ? Number{*delay} : Number::unknown();
    }
    case Thing::Kind::flag:
      return flag(tag);
    case Thing::Kind::descriptor_field:
      return field(tag, true);
    case Thing::Kind::packet_field:
      return field(tag, false);
    case Thing::Kind::answer:
      return Truth{false};
    default:
      return Number::unknown();
  }
}
Number PromelaWorld::pending(Tag timer) {
  const std::string name = variable(timer);
  return script_->is_found("due " + name) ? script_->number(name) : Number{0};
}
Truth PromelaWorld::in(Tag part, fsm::StateId state_) {
  declare(part);
  return script_->equals(state(part), table(part).state(state_));
}
Truth PromelaWorld::is_in(const Lanes& set) const {
  return set.of.empty() ? Truth{false} : set.of[static_cast<std::size_t>(descriptor_)];
}

Truth PromelaWorld::flag(Tag tag) {
  const std::string name = variable(tag);
  if (!script_->is_found("set " + name)) return false;
  return is_of_descriptors(tag) ? script_->bit(name, descriptor_) : script_->truth(name);
}
Truth PromelaWorld::field(Tag tag, bool bitmap) const {
  const std::string name = variable_of(packet_, variable(tag));
  if (!script_->is_said(name)) return false;
  return bitmap ? script_->bit(name, descriptor_) : script_->truth(name);
}
void PromelaWorld::assign(Tag flag, const Truth& may_hold, const Expression& value) {
  const std::string name = variable(flag);
  if (!may_hold.is(false)) script_->find("set " + name);
  if (!script_->is_found("set " + name)) return;
  script_->declare((is_of_descriptors(flag) ? "byte " : "bool ") + name + ";\n");
  script_->assign(name, value);
}
void PromelaWorld::set(Tag tag, const Value& value) {
  if (thing(tag).kind != Thing::Kind::flag) return;
  const Truth to = value.truth();
  if (!is_of_descriptors(tag)) return assign(tag, to, to.expression());
  Lanes all = set_of([&](PromelaWorld& d) { return d.flag(tag); });
  all.of[static_cast<std::size_t>(descriptor_)] = to;
  assign(tag, to, all.bitmap().expression());
}

void PromelaWorld::start(Tag timer) {
  const std::string name = variable(timer);
  const bool counted = thing(timer).counted;
  script_->find("due " + name);
  script_->declare((counted ? "byte " : "bool ") + name + ";  /* pending */\n");
  if (counted) {
    script_->write(fmt::format("assert({} < 255)", name));  // a byte can count it
    script_->assign(name, (script_->number(name) + 1).expression());
  } else {
    script_->assign(name, Truth{true}.expression());
  }
}
void PromelaWorld::cancel(Tag timer) {
  const std::string name = variable(timer);
  if (script_->is_found("due " + name)) script_->assign(name, Number{0}.expression());
}

void PromelaWorld::emit(const Step& step) {
  const std::string packet = variable(step.target);
  script_->find("sent " + packet);
  for (const Tag tag : thing(step.target).fields) {
    if (thing(tag).kind == Thing::Kind::packet_number) continue;
    const Number value = said(step, tag);
    const std::string name = variable_of(packet, variable(tag));
    script_->find_said(name, value);
    if (script_->is_kept(name)) script_->assign(name, value.expression());
  }
  script_->send(Store{packet, leaves_later(program(), step.target)}.name());
}
Number PromelaWorld::said(const Step& step, Tag field) {
  const auto place = std::ranges::find(step.fields, field);
  if (place == step.fields.end()) return {};
  const auto& given = step.with[static_cast<std::size_t>(place - step.fields.begin())];
  if (thing(field).kind == Thing::Kind::packet_field) {
    return Number::of(given.inner ? evaluate_inner(given.value).truth()
                                  : evaluate(given.value).truth());
  }
  if (given.inner) return set_of(term(given.value)).bitmap();
  const Truth all = evaluate(given.value).truth();
  return set_of([&](PromelaWorld&) { return all; }).bitmap();
}
void PromelaWorld::raise(Tag occasion) {
  const fsm::program::Rule* const rule = program().rule_for(Trigger::happens, occasion);
  if (rule != nullptr) run(rule->body);
}

std::string PromelaWorld::state(Tag part) const {
  return is_of_descriptors(part) ? fmt::format("{}[{}]", variable(part), descriptor_)
                                 : variable(part);
}
TableMacros PromelaWorld::cleared(const Step& step) {
  declare(step.target);
  TableMacros macros = table(step.target);
  for (std::size_t k = 0; k < macros.fields(); ++k) {
    if (!macros.asks(step.event, k)) continue;
    script_->declare("hidden byte " + macros.outbox(k) + ";\n");
    script_->assign(macros.outbox(k), Number{0}.expression());
  }
  script_->define(macros.macro(step.event));
  return macros;
}
void PromelaWorld::take(const TableMacros& macros, const Step& step, const Values& input) {
  const Tag part = step.target;
  std::string call = fmt::format("{}({}, {}", macros.name(step.event), state(part),
                                 is_of_descriptors(part) ? descriptor_ : 0);
  for (const fsm::program::Ref test : macros.tests(step.event)) {
    call += ", " + script_->say(evaluate_over(input, test).truth().expression());
  }
  script_->write(call + ")");
  script_->changed(state(part));
  for (std::size_t k = 0; k < macros.fields(); ++k) {
    if (macros.asks(step.event, k)) script_->changed(macros.outbox(k));
  }
}
PromelaWorld::Values PromelaWorld::feed(const Step& step) {
  const TableMacros macros = cleared(step);
  take(macros, step, inputs(step));
  Values outbox(macros.fields());
  for (std::size_t k = 0; k < outbox.size(); ++k) {
    if (!macros.asks(step.event, k)) continue;
    const std::string name = macros.outbox(k);
    outbox[k] =
        is_of_descriptors(step.target) ? script_->bit(name, descriptor_) : script_->truth(name);
  }
  return outbox;
}
PromelaWorld::Values PromelaWorld::feed_each(const Step& step) {
  const TableMacros macros = cleared(step);
  each([&](PromelaWorld& d) {
    const Values input = d.inputs(step);
    d.when(d.evaluate_inner(step.value).truth(), [&] { d.take(macros, step, input); });
  });
  Values outbox(macros.fields());
  for (std::size_t k = 0; k < outbox.size(); ++k) {
    if (!macros.asks(step.event, k)) continue;
    const std::string name = macros.outbox(k);
    Lanes lanes;
    each([&](PromelaWorld& d) { lanes.of.push_back(script_->bit(name, d.descriptor_)); });
    outbox[k] = lanes;
  }
  return outbox;
}
void PromelaWorld::renew(Tag part) {
  declare(part);
  const auto anew = [&](PromelaWorld& place) {
    script_->assign(place.state(part), Expression{table(part).initial()});
  };
  is_of_descriptors(part) ? each(anew) : anew(*this);
}

}  // namespace stormproof::promela
