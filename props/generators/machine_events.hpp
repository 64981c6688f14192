// Random event sequences for single machines: which event, with which input. They shrink towards
// fewer events and inputs of zeros. A header of templates, because every machine has inputs of its
// own; include it in one source file per machine.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string_view>
#include <vector>

#include <boost/pfr.hpp>
#include <rapidcheck.h>

#include "fsm/adaptive_period.hpp"
#include "fsm/flyweight.hpp"
#include "props/generators/dice.hpp"

namespace stormproof::props {

/// One event of `Machine`, by its number in `fsm::Reflect<Machine>::Events`.
template <class Machine>
struct MachineEvent {
  std::uint8_t event = 0;
  typename fsm::Flyweight<Machine>::Input input{};
};

namespace detail {

/// Times that meet each other, numbers of readers, and now and then something large.
inline std::int64_t draw_number(Dice& dice) {
  return dice.among(
      {0, 0, 1, 1, 2, 3, 5, 10, dice.between(0, 100), dice.magnitude(1, 10'000'000'000)});
}
inline void draw_field(Dice& dice, bool& field) { field = dice.chance(50); }
inline void draw_field(Dice& dice, std::int64_t& field) { field = draw_number(dice); }
/// A cycle as the writer has them: somebody was contacted, no more have responded, T_min ≤ T_max,
/// 0 < ε ≤ 1.
inline void draw_field(Dice& dice, fsm::AdaptiveCycle<fsm::Plain>& cycle) {
  cycle.start = draw_number(dice);
  cycle.contacted = dice.between(1, 6);
  cycle.responded = dice.between(0, cycle.contacted);
  cycle.min_period = 1 + draw_number(dice);
  cycle.max_period = cycle.min_period * dice.among({1, 2, 10});
  cycle.period = dice.between(cycle.min_period, cycle.max_period);
  cycle.epsilon_num = dice.among({1, 1, 1, 2});
  cycle.epsilon_den = dice.among({2, 3, 20, 20, 1'000});
}

/// One field back to its default or, if it is a number, halved. A cycle stays: its parts depend on
/// each other.
template <class Input>
std::vector<Input> simpler_inputs(const Input& input) {
  std::vector<Input> list;
  const Input plain{};
  constexpr std::size_t count = boost::pfr::tuple_size_v<Input>;
  for (std::size_t changed = 0; changed < count; ++changed) {
    Input simpler = input;
    Input halved = input;
    bool differs = false;
    bool can_be_halved = false;
    boost::pfr::for_each_field(simpler, [&](auto& field, auto place) {
      if (place != changed) return;
      const auto& target = boost::pfr::get<decltype(place)::value>(plain);
      if constexpr (std::is_arithmetic_v<std::remove_reference_t<decltype(field)>>) {
        differs = field != target;
        if constexpr (!std::is_same_v<std::remove_reference_t<decltype(field)>, bool>) {
          can_be_halved = field / 2 > target;
          boost::pfr::get<decltype(place)::value>(halved) = field / 2;
        }
        field = target;
      }
    });
    if (differs) list.push_back(simpler);
    if (can_be_halved) list.push_back(halved);
  }
  return list;
}

inline void show_field(std::ostream& out, bool field) { out << (field ? "true" : "false"); }
inline void show_field(std::ostream& out, std::int64_t field) { out << field; }
inline void show_field(std::ostream& out, const fsm::AdaptiveCycle<fsm::Plain>& cycle) {
  out << boost::pfr::io_fields(cycle);
}

}  // namespace detail

/// Sequences of any events with any inputs, as long as RapidCheck's size.
template <class Machine>
[[nodiscard]] rc::Gen<std::vector<MachineEvent<Machine>>> machine_events() {
  using One = MachineEvent<Machine>;
  const rc::Gen<One> one = [](rc::Random random, int) {
    Dice dice{random.next()};
    One event;
    constexpr auto count = static_cast<std::int64_t>(fsm::Reflect<Machine>::Events::size);
    event.event = static_cast<std::uint8_t>(dice.between(0, count - 1));
    boost::pfr::for_each_field(event.input,
                               [&dice](auto& field) { detail::draw_field(dice, field); });
    return rc::shrinkable::shrinkRecur(event, [](const One& given) {
      std::vector<One> simpler;
      for (const auto& input : detail::simpler_inputs(given.input)) {
        simpler.push_back({given.event, input});
      }
      return rc::seq::fromContainer(simpler);
    });
  };
  return rc::gen::container<std::vector<One>>(one);
}

/// Calls `use.template operator()<Event>(input)` with the type of the event.
template <class Machine, class Use>
void dispatch(const MachineEvent<Machine>& event, const Use& use) {
  using Info = fsm::Reflect<Machine>;
  [&]<class... Events>(fsm::TypeList<Events...>) {
    ((event.event == Info::template event_id<Events> ? use.template operator()<Events>(event.input)
                                                     : void()),
     ...);
  }(typename Info::Events{});
}

/// The state after the event; `output` receives what the machine asks for.
template <class Machine>
fsm::StateId step(fsm::Flyweight<Machine>& machine, fsm::StateId state,
                  const MachineEvent<Machine>& event,
                  typename fsm::Flyweight<Machine>::Output& output) {
  fsm::StateId after = state;
  dispatch(event, [&]<class Event>(const auto& input) {
    after = machine.template step<Event>(state, input, output);
  });
  return after;
}

/// `AckNackReceived(true, false, false)`: the event and the fields of its input.
template <class Machine>
void showValue(const MachineEvent<Machine>& event, std::ostream& out) {
  dispatch(event, [&]<class Event>(const auto& input) {
    out << fsm::name_of<Event>() << '(';
    std::string_view separator;
    boost::pfr::for_each_field(input, [&](const auto& field) {
      out << separator;
      detail::show_field(out, field);
      separator = ", ";
    });
    out << ')';
  });
}

}  // namespace stormproof::props
