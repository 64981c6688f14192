// The flyweight engine: one Boost.MSM machine object serves any number of machines of its kind. A
// machine is stored as its state number alone (one byte, or three bits in
// model/engine/relation_bits.hpp); a step puts that number into the object, lets MSM process the
// event, and reads the new number back. So every transition of the simulator goes through
// `back::state_machine`, at a few nanoseconds and without a machine in memory.
//
// MSM's back end takes long to compile. That of the machines in this folder is compiled once, in
// machines.cpp; who has a machine of his own includes fsm/msm.hpp where it runs.
#pragma once

#include "fsm/reflect.hpp"

namespace stormproof::fsm {

template <class Machine>
class Flyweight {
 public:
  using Input = typename Machine::Io::template Input<Plain>;
  using Output = typename Machine::Io::template Output<Plain>;

  static constexpr StateId initial = Reflect<Machine>::template id<typename Machine::initial_state>;

  /// Processes `Event` in state `state`; returns the state after it. `output` receives what the
  /// actions ask for, `row` which row fired: `no_row` if none did.
  template <class Event>
  StateId step(StateId state, const Input& input, Output& output, RowId& row) {
    return process(state, Reflect<Machine>::template event_id<Event>, input, output, row);
  }
  template <class Event>
  StateId step(StateId state, const Input& input, Output& output) {
    RowId row = no_row;
    return step<Event>(state, input, output, row);
  }

 private:
  static StateId process(StateId state, std::uint8_t event, const Input& input, Output& output,
                         RowId& row);  // fsm/msm.hpp
};

}  // namespace stormproof::fsm
