// Drives the machines of one kind during a run: steps the flyweight, stores the new state, and
// tells the probe which transition happened. Every state change of the simulator passes through
// here or through model/engine/relation_bits.hpp, and both pass through Boost.MSM.
#pragma once

#include <type_traits>

#include "fsm/flyweight.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model {

template <class Machine>
class Driver {
 public:
  using Input = typename fsm::Flyweight<Machine>::Input;
  using Output = typename fsm::Flyweight<Machine>::Output;

  explicit Driver(MachineRef::Kind kind) : kind_{kind} {}

  template <class Event>
  Output step(RunState& run, fsm::StateId& state, const Input& input, std::uint32_t subject) {
    Output output{};
    const fsm::StateId before = state;
    state = engine_.template step<Event>(before, input, output);
    if (run.probe != nullptr && fires<Event>(before, input)) {
      const auto& names = fsm::Reflect<Machine>::state_names;
      run.probe->transition({fsm::name_of<Machine>(), kind_, subject}, fsm::name_of<Event>(),
                            names[before], names[state], 0, 0);
    }
    return output;
  }

 private:
  /// Whether the table has a row for `Event` in this state whose guard holds. MSM does not tell a
  /// row that leads back to its state from no row at all.
  template <class Event>
  static bool fires(fsm::StateId state, const Input& input) {
    return [&]<class... Rows>(fsm::TypeList<Rows...>) {
      return (row_fires<Rows, Event>(state, input) || ...);
    }(typename fsm::Reflect<Machine>::Rows{});
  }
  template <class Row, class Event>
  static bool row_fires(fsm::StateId state, const Input& input) {
    if constexpr (!std::is_same_v<typename Row::Evt, Event>)
      return false;
    else if (state != fsm::Reflect<Machine>::template id<typename Row::Source>)
      return false;
    else if constexpr (std::is_same_v<typename Row::Guard, fsm::none>)
      return true;
    else
      return Row::Guard::template test<fsm::Plain>(input);
  }

  fsm::Flyweight<Machine> engine_;
  MachineRef::Kind kind_;
};

}  // namespace stormproof::model
