// Steps the machines of one kind, with Boost.MSM; or, if there is a deliberate mistake in their
// table (fsm/table_mutation.hpp), with the interpreter of the mutated one. A correct table costs no
// more than the test for it. Whoever runs machines runs them through here: the simulator, the
// explorer, the replay of captures, and the stateful tests.
#pragma once

#include <algorithm>
#include <memory>
#include <span>

#include "fsm/flyweight.hpp"
#include "fsm/row_table.hpp"

namespace stormproof::fsm {

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
  template <class Event>
  Output step(StateId& state, const Input& input = {}) {
    RowId row = no_row;
    return step<Event>(state, input, row);
  }

 private:
  Flyweight<Machine> engine_;
  std::unique_ptr<const TableInterpreter<Machine>> mutated_;  // in place of MSM, if any
};

}  // namespace stormproof::fsm
