// Steps the machines of one kind, with Boost.MSM; or, if there is a deliberate mistake in their
// table (fsm/table_mutation.hpp), with the interpreter of the mutated one. Whoever runs machines
// runs them through here: the simulator, the explorer, the monitors that follow a run, the replay
// of captures, and the stateful tests.
//
// A machine that reads nothing but truth values has few different steps. Each of them is taken once
// and remembered: from then on it costs a look into a table of a few hundred bytes, and a correct
// table costs no more than a mutated one.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include <boost/pfr.hpp>

#include "fsm/flyweight.hpp"
#include "fsm/row_table.hpp"

namespace stormproof::fsm {

namespace detail {
/// Whether all fields of a struct are truth values.
template <class Struct, std::size_t... I>
constexpr bool all_are_bool(std::index_sequence<I...>) {
  return (std::same_as<boost::pfr::tuple_element_t<I, Struct>, bool> && ...);
}
}  // namespace detail

/// A machine with few different steps: every state and event with some truth values.
template <class Machine>
concept IsFinite = boost::pfr::tuple_size_v<typename Machine::Io::template Input<Plain>>
<= 4 && detail::all_are_bool<typename Machine::Io::template Input<Plain>>(
            std::make_index_sequence<
                boost::pfr::tuple_size_v<typename Machine::Io::template Input<Plain>>>{});

template <class Machine>
class Stepper {
 public:
  using Input = typename Flyweight<Machine>::Input;
  using Output = typename Flyweight<Machine>::Output;

  static constexpr StateId initial = Flyweight<Machine>::initial;

  /// Mutations of other machines' tables may be among them.
  explicit Stepper(std::span<const TableMutation> mutations = {}) {
    const bool concerned = std::ranges::any_of(mutations, [](const TableMutation& mutation) {
      return mutation.machine == name_of<Machine>();
    });
    if (concerned) mutated_ = std::make_unique<const TableInterpreter<Machine>>(mutations);
  }

  /// One step of a machine in `state`, which becomes the state after it. `row` receives the row
  /// that fired: `no_row` if none did.
  template <class Event>
  Output step(StateId& state, const Input& input, RowId& row) {
    if constexpr (IsFinite<Machine>) {
      Step& step = steps_[place<Event>(state, input)];
      if (!step.known) [[unlikely]] {
        step.after = state;
        step.output = take<Event>(step.after, input, step.row);
        step.known = true;
      }
      state = step.after;
      row = step.row;
      return step.output;
    } else {
      return take<Event>(state, input, row);
    }
  }
  template <class Event>
  Output step(StateId& state, const Input& input = {}) {
    RowId row = no_row;
    return step<Event>(state, input, row);
  }

 private:
  struct Step {
    Output output{};
    StateId after{};
    RowId row = no_row;
    bool known = false;
  };
  static constexpr std::size_t fields = boost::pfr::tuple_size_v<Input>;
  static constexpr std::size_t step_count() {
    if constexpr (!IsFinite<Machine>) return 0;
    return (Reflect<Machine>::Events::size * Reflect<Machine>::state_count) << fields;
  }

  template <class Event>
  static std::size_t place(StateId state, const Input& input) {
    constexpr std::size_t event = Reflect<Machine>::template event_id<Event>;
    std::size_t place = event * Reflect<Machine>::state_count + state;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((place = place << 1 | (boost::pfr::get<I>(input) ? 1U : 0U)), ...);
    }
    (std::make_index_sequence<fields>{});
    return place;
  }

  template <class Event>
  [[gnu::noinline]] Output take(StateId& state, const Input& input, RowId& row) {
    Output output{};
    if (mutated_ != nullptr) [[unlikely]] {
      constexpr std::uint8_t event = Reflect<Machine>::template event_id<Event>;
      const StepResult result = mutated_->step(state, event, input, output);
      state = result.state;
      row = result.row;
    } else {
      state = engine_.template step<Event>(state, input, output, row);
    }
    return output;
  }

  Flyweight<Machine> engine_;
  std::unique_ptr<const TableInterpreter<Machine>> mutated_;  // in place of MSM, if any
  std::array<Step, step_count()> steps_{};
};

}  // namespace stormproof::fsm
