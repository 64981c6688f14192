// Machines as Boost.MSM compiles them: its back end processes the events of the flyweight engine
// (fsm/flyweight.hpp), and its numbers of states must be those of reflection.
#pragma once

#include <boost/msm/back/metafunctions.hpp>
#include <boost/msm/back/state_machine.hpp>

#include "fsm/flyweight.hpp"

namespace stormproof::fsm {

template <class Machine>
using BackEnd = boost::msm::back::state_machine<Machine>;

/// Whether MSM numbers the states of the machine as reflection does.
template <class Machine>
inline constexpr bool has_numbers_of_msm = []<class... States>(TypeList<States...>) {
  using Stt = typename BackEnd<Machine>::stt;
  return ((Reflect<Machine>::template id<States> ==
           boost::msm::back::get_state_id<Stt, States>::value) &&
          ...);
}(typename Reflect<Machine>::States{});

template <class Machine>
StateId Flyweight<Machine>::process(StateId state, std::uint8_t event, const Input& input,
                                    Output& output, RowId& row) {
  static_assert(has_numbers_of_msm<Machine>, "state numbers differ from those of MSM");
  thread_local BackEnd<Machine> machine;
  // MSM offers the current state for reading only; the object itself is ours and not const.
  int* current = const_cast<int*>(machine.current_state());
  *current = state;
  const auto process_as = [&]<class Event>() {
    const Event one{{input, output}};
    machine.process_event(one);
    row = one.row;
    return true;
  };
  [&]<class... Events>(TypeList<Events...>) {
    static_cast<void>(((event == Reflect<Machine>::template event_id<Events> &&
                        process_as.template operator()<Events>()) ||
                       ...));
  }(typename Reflect<Machine>::Events{});
  return static_cast<StateId>(*current);
}

}  // namespace stormproof::fsm
