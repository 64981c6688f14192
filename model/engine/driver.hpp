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
      : machines_{table_mutations(run)},
        kind_{kind},
        hearer_{run.who_hears(report_of({{fsm::name_of<Machine>(), kind}, {}, {}, {}}))} {}

  template <class Event>
  [[gnu::always_inline]] Output step(fsm::StateId& state, const Input& input,
                                     std::uint32_t subject) {
    const fsm::StateId before = state;
    fsm::RowId row = fsm::no_row;
    const Output output = machines_.template step<Event>(state, input, row);
    if (hearer_ != nullptr && row != fsm::no_row) tell<Event>(before, state, subject);
    return output;
  }

 private:
  template <class Event>
  [[gnu::noinline]] void tell(fsm::StateId before, fsm::StateId after, std::uint32_t subject) {
    using Info = fsm::Reflect<Machine>;
    hearer_->transition({.machine = {fsm::name_of<Machine>(), kind_, subject},
                         .event = fsm::name_of<Event>(),
                         .before = Info::state_names[before],
                         .after = Info::state_names[after]});
  }

  fsm::Stepper<Machine> machines_;
  const MachineRef::Kind kind_;
  Probe* const hearer_;  // of its transitions, or null
};

}  // namespace stormproof::model
