// Effects on machines, state, timers and packets.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "checker/engines/explorer/specialise.hpp"

namespace stormproof::explorer {

using fsm::program::Do;
using fsm::program::no_term;
using fsm::program::no_thing;
using fsm::program::Thing;

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
  put_on(step.target, std::move(made));
  if (machine.events[step.event] == "AckNackReceived") ask(step);
  if (announces_ && thing(step.target).name == "Reader") hear(step);
}
/// A writer that does not look at each descriptor takes an ACKNACK as a whole.
void Specialiser::ask(const fsm::program::Step& step) {
  const fsm::program::Machine& machine = program_.machine_of(step.target);
  const auto take = std::ranges::find(machine.outputs, "take", &fsm::program::Machine::Field::name);
  if (take == machine.outputs.end()) return;
  const auto k = static_cast<Register>(take - machine.outputs.begin());
  put({.act = Act::when,
       .value = add({.op = Op::let, .reg = first_[step.reg] + k}),
       .body = {{.act = Act::ask}}});
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
  if (const auto number = host_.keeps(it.name)) {
    return put_on(step.target, {.act = Act::set_host, .value = term(step.value), .reg = *number});
  }
  Step made{.tag = step.target, .value = term(step.value)};
  made.act = it.kind == Thing::Kind::number ? Act::set_number
             : is_of_descriptors(it)        ? Act::set_member
                                            : Act::set_truth;
  // Doubling without end, the explored world would never come back to a state.
  if (it.name == "LastDelay") made.most = knob(program_.find("InitialDelay")) << last_doubling;
  put_on(step.target, std::move(made));
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
  const Ref wait = delay();
  put_on(step.target, {.act = Act::schedule,
                       .event = *event,
                       .owner = timer.owner,
                       .tag = timer.counted ? step.target : no_thing,
                       .value = wait});
}

/// Packets of control-only relations are not explored: only a mistake gets to a lookup of types,
/// which no profile that is explored has.
void Specialiser::emit(const fsm::program::Step& step) {
  const auto what = what_of_packet(program_, step.target);
  if (!what && thing(step.target).owner == fsm::composition::owner::control_relation) {
    return put({.act = Act::overflow});
  }
  if (!what) throw std::logic_error{"a packet that is not explored"};
  Step made{.act = Act::emit, .event = *what};
  for (std::size_t k = 0; k < step.with.size(); ++k) {
    const SlotField& field = slot_field(thing(step.fields[k]));
    made.says.push_back({field.as, field.flag, term(step.with[k].value)});
  }
  put_on(step.target, std::move(made));
}

}  // namespace stormproof::explorer
