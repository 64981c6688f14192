// Drives the machines of one kind during a run: steps the flyweight, stores the new state, and
// tells the probe which transition happened. Every state change of the simulator passes through
// here or through model/engine/relation_bits.hpp, and both pass through Boost.MSM, unless a
// deliberate mistake in the table is wanted: then the mutated table is interpreted.
#pragma once

#include <memory>
#include <type_traits>

#include "fsm/flyweight.hpp"
#include "model/engine/mutated_table.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model {

template <class Machine>
class Driver {
 public:
  using Input = typename fsm::Flyweight<Machine>::Input;
  using Output = typename fsm::Flyweight<Machine>::Output;

  Driver(const RunState& run, MachineRef::Kind kind)
      : mutated_{mutated_table<Machine>(run.mutation)}, kind_{kind} {}

  template <class Event>
  Output step(RunState& run, fsm::StateId& state, const Input& input, std::uint32_t subject) {
    Output output{};
    const fsm::StateId before = state;
    if (mutated_ != nullptr) [[unlikely]] {
      const auto result = mutated_->step(before, Info::template event_id<Event>, input, output);
      state = result.state;
      if (run.probe != nullptr && result.fired) tell<Event>(run, before, state, subject);
      return output;
    }
    state = engine_.template step<Event>(before, input, output);
    if (run.probe != nullptr && fires<Event>(before, input)) {
      tell<Event>(run, before, state, subject);
    }
    return output;
  }

 private:
  using Info = fsm::Reflect<Machine>;

  template <class Event>
  void tell(const RunState& run, fsm::StateId before, fsm::StateId after,
            std::uint32_t subject) const {
    run.probe->transition({fsm::name_of<Machine>(), kind_, subject}, fsm::name_of<Event>(),
                          Info::state_names[before], Info::state_names[after], 0, 0);
  }

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
    else if (state != Info::template id<typename Row::Source>)
      return false;
    else if constexpr (std::is_same_v<typename Row::Guard, fsm::none>)
      return true;
    else
      return Row::Guard::template test<fsm::Plain>(input);
  }

  fsm::Flyweight<Machine> engine_;
  std::unique_ptr<const fsm::TableInterpreter<Machine>> mutated_;  // in place of MSM, if any
  MachineRef::Kind kind_;
};

}  // namespace stormproof::model
