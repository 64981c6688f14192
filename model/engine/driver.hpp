// Drives the machines of one kind during a run: steps them, stores the new state, and tells the
// probe which row fired. Every state change of the simulator passes through here or through
// model/engine/relation_bits.hpp.
#pragma once

#include <span>

#include "fsm/stepper.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model {

/// The mistakes in the tables of this run.
[[nodiscard]] inline std::span<const fsm::TableMutation> table_mutations(const RunState& run) {
  if (run.mutation == nullptr) return {};
  return run.mutation->tables;
}

template <class Machine>
class Driver {
 public:
  using Input = typename fsm::Stepper<Machine>::Input;
  using Output = typename fsm::Stepper<Machine>::Output;

  Driver(const RunState& run, MachineRef::Kind kind)
      : run_{run},
        machines_{table_mutations(run)},
        kind_{kind},
        report_{kind == MachineRef::Kind::channel ? Report::channel_transition
                                                  : Report::transition} {}

  template <class Event>
  Output step(fsm::StateId& state, const Input& input, std::uint32_t subject) {
    using Info = fsm::Reflect<Machine>;
    const fsm::StateId before = state;
    fsm::RowId row = fsm::no_row;
    const Output output = machines_.template step<Event>(state, input, row);
    if (run_.who_hears(report_) != nullptr && row != fsm::no_row) {
      run_.probe->transition({fsm::name_of<Machine>(), kind_, subject}, fsm::name_of<Event>(),
                             Info::state_names[before], Info::state_names[state], 0, 0);
    }
    return output;
  }

 private:
  const RunState& run_;
  fsm::Stepper<Machine> machines_;
  MachineRef::Kind kind_;
  Report report_;
};

}  // namespace stormproof::model
