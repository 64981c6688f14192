// Steps one machine of the explored world: through Boost.MSM, as the simulator does, or through the
// interpreter of its reflected table if `stormproof mutate` wants a mistake in that table.
#pragma once

#include <algorithm>
#include <optional>

#include "fsm/flyweight.hpp"
#include "fsm/row_table.hpp"

namespace stormproof::explorer {

template <class Machine>
class Stepper {
 public:
  using Input = typename fsm::Flyweight<Machine>::Input;
  using Output = typename fsm::Flyweight<Machine>::Output;

  explicit Stepper(std::span<const fsm::TableMutation> mutations) {
    const bool concerned = std::ranges::any_of(mutations, [](const fsm::TableMutation& mutation) {
      return mutation.machine == fsm::name_of<Machine>();
    });
    if (concerned) mutated_.emplace(mutations);
  }

  /// One step of a machine in `state`, which becomes the state after it.
  template <class Event>
  Output step(fsm::StateId& state, const Input& input) {
    Output output{};
    if (mutated_) {
      constexpr std::uint8_t event = fsm::Reflect<Machine>::template event_id<Event>;
      state = mutated_->step(state, event, input, output).state;
    } else {
      state = engine_.template step<Event>(state, input, output);
    }
    return output;
  }

 private:
  fsm::Flyweight<Machine> engine_;
  std::optional<fsm::TableInterpreter<Machine>> mutated_;
};

}  // namespace stormproof::explorer
